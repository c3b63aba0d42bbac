#include "engine/core/fast/core_executor.hpp"

#include <utility>

namespace rs::engine {

int CoreExecutor::add(std::shared_ptr<const Renderer> renderer) {
    renderers_.emplace(next_slot_, std::move(renderer));
    return next_slot_++;
}

Result<std::optional<int>> CoreExecutor::load(const RaySpaceObject& object) {
    RS_ASSIGN_OR_RETURN(Renderer renderer, Renderer::create(object));
    return std::optional<int>(add(std::make_shared<const Renderer>(std::move(renderer))));
}

Status CoreExecutor::evict(int slot) {
    renderers_.erase(slot);
    return {};
}

Result<std::vector<ExecutedView>> CoreExecutor::render(const std::vector<SlotView>& views) {
    std::vector<ExecutedView> drawn;
    for (const SlotView& wanted : views) {
        const ViewRegisters& registers = wanted.registers;
        const auto found = renderers_.find(wanted.slot);
        if (found == renderers_.end()) return no_object_in(wanted.slot);
        ExecutedView& view = drawn.emplace_back();
        view.image = Image<Rgba8>(registers.width, registers.height);
        if (wanted.depth) view.depth_q20 = Image<std::int32_t>(registers.width, registers.height);
        found->second->render(registers, view.image, view.depth_q20);
    }
    return drawn;
}

}  // namespace rs::engine
