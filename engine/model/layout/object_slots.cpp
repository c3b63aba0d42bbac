#include "engine/model/layout/object_slots.hpp"

#include <algorithm>

namespace rs::engine::model {

ObjectSlots::ObjectSlots(const BoardConfig& config)
    : layout_(layout_of(config.limits.kind)),
      limits_(config.limits),
      map_(config.memory),
      slots_(static_cast<std::size_t>(config.limits.objects)) {}

Result<ObjectSlots::Taken> ObjectSlots::take(const RaySpaceObject& object) {
    RS_TRY(layout_.drawable(object, limits_));
    const auto free = std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.is_taken; });
    if (free == slots_.end()) {
        return Error{object.name + ": all " + std::to_string(slots_.size()) +
                     " object slots of the board are taken; evict an object first"};
    }
    RS_ASSIGN_OR_RETURN(const Placement placement, map_.allocate(layout_.words(object), object.name));
    *free = {true, placement};
    Taken taken{static_cast<int>(free - slots_.begin()), layout_.image(object, placement)};
    taken.image.registers.serial = ++loads_;
    return taken;
}

void ObjectSlots::release(int slot) {
    Slot& released = slots_[static_cast<std::size_t>(slot)];
    map_.release(released.placement);
    released = {};
}

bool ObjectSlots::is_taken(int slot) const {
    return slot >= 0 && slot < count() && slots_[static_cast<std::size_t>(slot)].is_taken;
}

}  // namespace rs::engine::model
