#pragma once
// An object as it lies on the board's disk and in its memory: pictures column by column, alpha in 2 bits, the RS map a
// byte per cell, cameras and lines in records (the layouts stand in picture_scan.hpp and line_reader.hpp).

#include "engine/model/blocks/memory/disk_controller.hpp"
#include "engine/model/layout/memory_map.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <vector>

namespace rs::engine::model {

inline constexpr int kAlphaBits = 2;

// The numbers of its RS map.
void set_map_registers(const RaySpaceObject& object, ObjectRegisters& registers);

// Fails where pictures are not there as Y, U and V at half size, and alpha.
Status has_raw_pictures(const RaySpaceObject& object);

struct ObjectImage {
    ObjectRegisters registers;
    std::vector<MemorySegment> segments;
};

// How boards of one kind hold objects. Pure; thread-safe.
class ObjectLayout {
public:
    ObjectLayout() = default;
    ObjectLayout(const ObjectLayout&) = delete;
    ObjectLayout& operator=(const ObjectLayout&) = delete;
    virtual ~ObjectLayout() = default;

    // Fails where a board cannot hold or draw the object, with the reason and the remedy: a limit of fits_board, a
    // shape map, pictures that are not loaded, or not of its kind.
    [[nodiscard]] virtual Status drawable(const RaySpaceObject& object, const BoardLimits& limits) const = 0;
    // The object that is really drawn. Bit equality is with this one.
    [[nodiscard]] virtual RaySpaceObject as_drawn(RaySpaceObject object) const { return object; }
    // Of a drawable object: words per region that it takes, and what stands in them.
    [[nodiscard]] virtual std::array<std::uint64_t, kObjectRegions> words(const RaySpaceObject& object) const = 0;
    [[nodiscard]] virtual ObjectImage image(const RaySpaceObject& object, const Placement& placement) const = 0;
};
const ObjectLayout& layout_of(BoardKind kind);

// Alpha rounded to 2 bits, as boards of BoardKind::raw_pictures hold it.
RaySpaceObject with_board_alpha(RaySpaceObject object);

}  // namespace rs::engine::model
