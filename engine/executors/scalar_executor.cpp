#include "engine/executors/entries.hpp"

#include "engine/core/definition/reconstruct.hpp"
#include "rayspace/codec/stream/decode_image.hpp"

#include <map>

namespace rs::engine {
namespace {

class ScalarExecutor final : public Executor {
public:
    [[nodiscard]] const ExecutorTraits& traits() const override { return traits_; }

    Result<std::optional<int>> load(const RaySpaceObject& object) override {
        RaySpaceObject& loaded = loaded_[next_slot_] = object;
        if (loaded.coded) codec::decode_images(loaded);
        return std::optional<int>(next_slot_++);
    }

    Status evict(int slot) override {
        loaded_.erase(slot);
        return {};
    }

    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override {
        std::vector<ExecutedView> drawn;
        for (const SlotView& view : views) {
            const auto found = loaded_.find(view.slot);
            if (found == loaded_.end()) return no_object_in(view.slot);
            const ViewRegisters& r = view.registers;
            drawn.push_back({Image<Rgba8>(r.width, r.height), Image<std::int32_t>(r.width, r.height)});
            reconstruct_scalar(found->second, r, drawn.back().image.view(), drawn.back().depth_q20.view());
        }
        return drawn;
    }

private:
    ExecutorTraits traits_{.name = "scalar"};
    std::map<int, RaySpaceObject> loaded_;
    int next_slot_ = 0;
};

}  // namespace

ExecutorEntry scalar_entry() {
    return {"scalar", "", [](const std::string&) -> Result<std::unique_ptr<Executor>> {
                return std::unique_ptr<Executor>(std::make_unique<ScalarExecutor>());
            }};
}

}  // namespace rs::engine
