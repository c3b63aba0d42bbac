#pragma once
// Object slots and object memory of a board, as its driver allocates them.

#include "engine/model/layout/memory_map.hpp"
#include "engine/model/layout/object_image.hpp"
#include "engine/model/signals/board_config.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <vector>

namespace rs::engine::model {

class ObjectSlots {
public:
    explicit ObjectSlots(const BoardConfig& config);

    struct Taken {
        int slot = 0;
        ObjectImage image;  // what to write into memory, and the registers of the slot
    };
    /// Takes a slot and memory. Fails if the board cannot render the object (drawable), or if slots or memory are full.
    Result<Taken> take(const RaySpaceObject& object);
    void release(int slot);

    [[nodiscard]] bool is_taken(int slot) const;
    [[nodiscard]] int count() const { return static_cast<int>(slots_.size()); }
    [[nodiscard]] const MemoryMap& memory_map() const { return map_; }

private:
    struct Slot {
        bool is_taken = false;
        Placement placement;
    };
    const ObjectLayout& layout_;
    const BoardLimits limits_;
    MemoryMap map_;
    std::vector<Slot> slots_;
    std::uint32_t loads_ = 0;  // gives the serial numbers of the objects
};

}  // namespace rs::engine::model
