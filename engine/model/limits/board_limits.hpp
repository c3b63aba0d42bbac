#pragma once
// Limits of the published board. layout/object_image.hpp checks whether objects fit.
//
// Source: Sakagawa et al., section 5: one FPGA at 40 MHz, 20 objects, 15 views per rendering cycle, at most 120
// images of 512x512 and 12 reference planes of at most 1024 cells a side per object, Y, U, V and alpha uncompressed
// with U and V at half width and height, 1 GByte of memory for objects, RS maps and the double-buffered
// reconstructed-image buffer.

#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <limits>

namespace rs::engine {

// Kind of objects that a board holds.
enum class BoardKind {
    raw_images,    // Y, U, V and alpha in 2 bits; an RS map
    coded_images,  // images of profile `board`, stored compressed; an RS map
    any_object,    // either kind of images, alpha in 8 bits, with or without a shape map: the parallel board
};

inline constexpr int kMaxBands = 384;  // bands of a shape map: cells per column in cell_march of the parallel board

struct BoardLimits {
    int objects = 20;
    int views_per_cycle = 15;
    int images_per_object = 120;
    int image_side_px = 512;
    int planes = 12;
    int map_side = 1024;
    int image_buffer_side_px = 512;  // the largest reconstructed image, R, G, B and alpha, in two buffers
    std::uint64_t memory_bytes = std::uint64_t{1} << 30;
    BoardKind kind = BoardKind::raw_images;
    int shape_bands = std::numeric_limits<int>::max();  // bands of a shape map
};

// Fails with the limit that the object exceeds, its value, and the remedy. Does not check memory.
Status within_limits(const RaySpaceObject& object, const BoardLimits& limits);

// The double-buffered image buffer: two cycles of the largest images.
std::uint64_t image_buffer_bytes(const BoardLimits& limits);

}  // namespace rs::engine
