#pragma once
// What the published board holds, and whether an object fits: the front door of the hardware model.
//
// Source: Sakagawa et al., section 5: one FPGA at 40 MHz, 20 objects, 15 views per rendering cycle, at most 120
// pictures of 512x512 and 12 reference planes of at most 1024 cells a side per object, Y, U, V and alpha uncompressed
// with U and V at half width and height, 1 GByte of memory for objects, RS maps and the double-buffered
// reconstructed-image buffer.

#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::engine {

// What objects a board holds.
enum class BoardKind {
    raw_pictures,    // Y, U, V and alpha in 2 bits; an RS map
    coded_pictures,  // pictures of profile `board`, kept as they are; an RS map
    any_object,      // either kind of pictures, alpha in 8 bits, with a shape map or without: the parallel board
};

inline constexpr int kMostBands = 384;  // of a shape map: the parallel board's place for a column of cells

struct BoardLimits {
    int objects = 20;
    int views_per_cycle = 15;
    int pictures_per_object = 120;
    int picture_side_px = 512;
    int planes = 12;
    int map_side = 1024;
    int alpha_bits = 2;
    int image_buffer_side_px = 512;  // the largest reconstructed image, R, G, B and alpha, in two buffers
    std::uint64_t memory_bytes = std::uint64_t{1} << 30;
    BoardKind kind = BoardKind::raw_pictures;
    int shape_bands = kMostBands;  // of a shape map
    // The board has what unpacks pictures of profile `board`.
    [[nodiscard]] bool unpacks() const { return kind != BoardKind::raw_pictures; }
    [[nodiscard]] bool any_object() const { return kind == BoardKind::any_object; }
};

// Bytes of board memory that an object takes; planes of pictures and maps are stored without gaps.
struct BoardFootprint {
    std::uint64_t luma_bytes = 0;
    std::uint64_t chroma_bytes = 0;
    std::uint64_t alpha_bytes = 0;
    std::uint64_t map_bytes = 0;    // one byte per cell: at most 120 pictures and "none"
    std::uint64_t lines_bytes = 0;  // 16 bytes per view, 16 per view and plane
    // Of coded pictures (coded_layout.hpp), instead of luma, chroma and alpha.
    std::uint64_t tile_bytes = 0;
    std::uint64_t tile_table_bytes = 0;
    std::uint64_t book_bytes = 0;
    std::uint64_t shape_bytes = 0;  // cells of shape maps
    [[nodiscard]] std::uint64_t total_bytes() const {
        return luma_bytes + chroma_bytes + alpha_bytes + map_bytes + lines_bytes + tile_bytes + tile_table_bytes +
               book_bytes + shape_bytes;
    }
};

// Where `limits` ask for coded pictures and not for any object, `object` has them, all loaded.
BoardFootprint board_footprint(const RaySpaceObject& object, const BoardLimits& limits);

// Fails with the limit that the object exceeds, its value, and what to encode it with instead.
Status fits_board(const RaySpaceObject& object, const BoardLimits& limits);

// All objects together, with the image buffer for a full cycle of views.
Status fit_board_together(std::span<const RaySpaceObject> objects, const BoardLimits& limits);

// The double-buffered image buffer: two cycles of the largest images.
std::uint64_t image_buffer_bytes(const BoardLimits& limits);

}  // namespace rs::engine
