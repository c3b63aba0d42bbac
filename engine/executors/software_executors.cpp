#include "engine/executors/software_executors.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/codec/stream/decode_picture.hpp"

#include <map>
#include <type_traits>

namespace rs::engine {
namespace {

struct Definition {
    static constexpr const char* kName = "scalar";
    static Result<RaySpaceObject> prepared(RaySpaceObject object) {
        if (object.coded) codec::decode_pictures(object);
        return object;
    }
    static void render(const RaySpaceObject& object, const ViewRegisters& registers, ExecutedView& out) {
        reconstruct_scalar(object, registers, out.picture.view(), out.depth_q20.view());
    }
};

struct Core {
    static constexpr const char* kName = "core";
    static Result<Renderer> prepared(RaySpaceObject object) { return Renderer::create(std::move(object)); }
    static void render(const Renderer& renderer, const ViewRegisters& registers, ExecutedView& out) {
        renderer.render(registers, out.picture.view(), out.depth_q20.view());
    }
};

template <class Way>
class SoftwareExecutor final : public Executor {
public:
    [[nodiscard]] const ExecutorTraits& traits() const override { return traits_; }

    Result<std::optional<int>> load(const RaySpaceObject& object) override {
        auto prepared = Way::prepared(object);
        if (!prepared) return prepared.error();
        loaded_.emplace(next_slot_, std::move(*prepared));
        return std::optional<int>(next_slot_++);
    }

    Status evict(int slot) override {
        loaded_.erase(slot);
        return {};
    }

    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override {
        std::vector<ExecutedView> drawn;
        for (const auto& [slot, registers] : views) {
            const auto found = loaded_.find(slot);
            if (found == loaded_.end()) return Error{"slot " + std::to_string(slot) + " holds no object"};
            drawn.push_back({Image<Rgba8>(registers.width, registers.height),
                             Image<std::int32_t>(registers.width, registers.height)});
            Way::render(found->second, registers, drawn.back());
        }
        return drawn;
    }

private:
    using Prepared = std::remove_cvref_t<decltype(*Way::prepared(RaySpaceObject()))>;
    ExecutorTraits traits_{.name = Way::kName};
    std::map<int, Prepared> loaded_;
    int next_slot_ = 0;
};

}  // namespace

std::unique_ptr<Executor> make_scalar_executor() {
    return std::make_unique<SoftwareExecutor<Definition>>();
}

std::unique_ptr<Executor> make_core_executor() {
    return std::make_unique<SoftwareExecutor<Core>>();
}

}  // namespace rs::engine
