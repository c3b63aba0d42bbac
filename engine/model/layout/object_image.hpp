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

// Fails where the board cannot hold or draw the object, with the reason and the remedy: a limit of fits_board, a shape
// map, pictures that are not loaded, or not of the kind that the board holds (limits.coded_pictures).
Status drawable(const RaySpaceObject& object, const BoardLimits& limits);

// The object that the board really draws: alpha rounded to its 2 bits. Bit equality is with this one.
RaySpaceObject with_board_alpha(RaySpaceObject object);

// The object that a board with these limits really draws: with_board_alpha() where pictures are not compressed, else
// the object itself.
RaySpaceObject as_drawn_by_board(RaySpaceObject object, const BoardLimits& limits);

// Words per region that the object takes.
std::array<std::uint64_t, kObjectRegions> object_words(const RaySpaceObject& object, const BoardLimits& limits);

// The numbers of its RS map.
void set_map_registers(const RaySpaceObject& object, ObjectRegisters& registers);

// Fails where pictures are not there as Y, U and V at half size, and alpha.
Status has_raw_pictures(const RaySpaceObject& object);

struct ObjectImage {
    ObjectRegisters registers;
    std::vector<MemorySegment> segments;
};

// `object` is drawable. Alpha of pictures that are not compressed is rounded to 2 bits.
ObjectImage object_image(const RaySpaceObject& object, const Placement& placement, const BoardLimits& limits);

}  // namespace rs::engine::model
