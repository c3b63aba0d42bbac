// Adds an executor to the library: "checked:NAME" renders every view with the executor NAME and with the scalar
// definition, and fails if a bit differs. A driver for hardware or a GPU derives from Executor in the same way; its
// data are the members of RaySpaceObject and ViewRegisters.
//
//     custom_executor OBJECT.rso VIEW.png [EXECUTOR]        such as checked:core

#include <rayspace/api/executor.hpp>
#include <rayspace/api/image.hpp>
#include <rayspace/api/object.hpp>
#include <rayspace/api/renderer.hpp>

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace api = rs::api;

class CheckedExecutor final : public api::Executor {
public:
    CheckedExecutor(std::unique_ptr<api::Executor> checked, std::unique_ptr<api::Executor> definition)
        : checked_(std::move(checked)), definition_(std::move(definition)), traits_(checked_->traits()) {
        traits_.name = "checked:" + traits_.name;
    }

    const api::ExecutorTraits& traits() const override { return traits_; }
    rs::Status supports(const api::RaySpaceObject& object) const override { return checked_->supports(object); }
    rs::Status can_render(const api::ViewRegisters& registers) const override {
        return checked_->can_render(registers);
    }
    api::RaySpaceObject as_rendered(api::RaySpaceObject object) const override {
        return checked_->as_rendered(std::move(object));
    }

    rs::Result<std::optional<int>> load(const api::RaySpaceObject& object) override {
        const auto slot = checked_->load(object);
        if (!slot || !slot->has_value()) return slot;
        const auto other = definition_->load(checked_->as_rendered(object));
        if (!other || !other->has_value()) {
            if (rs::Status evicted = checked_->evict(**slot); !evicted) return evicted.error();
            return other;
        }
        definition_slots_[**slot] = **other;
        return slot;
    }

    rs::Status evict(int slot) override {
        const auto found = definition_slots_.find(slot);
        if (found == definition_slots_.end()) return rs::engine::no_object_in(slot);
        if (rs::Status evicted = definition_->evict(found->second); !evicted) return evicted;
        definition_slots_.erase(found);
        return checked_->evict(slot);
    }

    rs::Result<std::vector<api::ExecutedView>> render(const std::vector<api::SlotView>& views) override {
        std::vector<api::SlotView> same = views;
        for (api::SlotView& view : same) {
            const auto found = definition_slots_.find(view.slot);
            if (found == definition_slots_.end()) return rs::engine::no_object_in(view.slot);
            view.slot = found->second;
        }
        auto rendered = checked_->render(views);
        if (!rendered) return rendered;
        const auto expected = definition_->render(same);
        if (!expected) return expected;
        for (std::size_t i = 0; i < views.size(); ++i) {
            if (!((*rendered)[i].image == (*expected)[i].image)) {
                return rs::Error{traits_.name + ": view " + std::to_string(i) + " is not that of the definition"};
            }
        }
        return rendered;
    }

private:
    std::unique_ptr<api::Executor> checked_;
    std::unique_ptr<api::Executor> definition_;
    api::ExecutorTraits traits_;
    std::map<int, int> definition_slots_;
};

rs::Status render(const std::string& object_file, const std::string& image_file, const std::string& executor_name) {
    api::ExecutorTable table;
    const api::ExecutorTable standard = table;
    const rs::Status added = table.add(
        {"checked", "NAME", [standard](const std::string& name) -> rs::Result<std::unique_ptr<api::Executor>> {
             RS_ASSIGN_OR_RETURN(auto checked, standard.create(name));
             RS_ASSIGN_OR_RETURN(auto definition, standard.create("scalar"));
             return std::unique_ptr<api::Executor>(
                 std::make_unique<CheckedExecutor>(std::move(checked), std::move(definition)));
         }});
    if (!added) return added;
    std::printf("executors: %s\n", table.names().c_str());

    RS_ASSIGN_OR_RETURN(auto executor, table.create(executor_name));
    RS_ASSIGN_OR_RETURN(const auto object, api::Object::open(object_file));
    RS_ASSIGN_OR_RETURN(const auto cameras, object.orbit(1));
    RS_ASSIGN_OR_RETURN(const auto renderer, api::Renderer::create(object, std::move(executor)));
    RS_ASSIGN_OR_RETURN(const auto view, renderer.render(cameras.front()));
    return api::write_png(image_file, view.image);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3 || argc > 4) {
        std::fprintf(stderr, "usage: custom_executor OBJECT.rso VIEW.png [EXECUTOR]\n");
        return 2;
    }
    const rs::Status status = render(argv[1], argv[2], argc > 3 ? argv[3] : "checked:core");
    if (!status) std::fprintf(stderr, "custom_executor: %s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
