#pragma once
// Coded images of an object as stored in its file: shared data, and for each image a head and tiles. Each tile can be
// decoded without the other tiles of its image; encode/FORMAT.md, section "Coded images".

#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/code/dense_code.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::codec {

enum class Profile : std::uint8_t {
    kDense = 1,  // entropy-coded tiles, for the best compression
    kBoard = 2,  // fixed-size records and table look-ups, for hardware
};
constexpr const char* name_of(Profile profile) {
    return profile == Profile::kBoard ? "board" : "dense";
}

/// Range of a tile's bytes within its image. A tile that is not present is transparent.
struct TileSpan {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    bool present = false;
};

struct CodedImage {
    ImageHead head;
    std::vector<TileSpan> tiles;   // row by row; empty if the image is not loaded
    std::vector<std::byte> bytes;  // all tiles

    [[nodiscard]] bool loaded() const { return !tiles.empty(); }
    [[nodiscard]] std::span<const std::byte> tile_bytes(std::size_t tile) const {
        return std::span(bytes).subspan(tiles[tile].begin, tiles[tile].size);
    }
};

struct CodedImages {
    Profile profile = Profile::kDense;
    int width = 0;  // px, of the images
    int height = 0;
    int tile_width_log2 = 5;   // kMinTileLog2 .. kMaxTileLog2
    int tile_height_log2 = 5;  // kMinTileLog2 .. kMaxTileLog2
    DenseCode dense;           // `profile` selects `dense` or `board`
    BoardCode board;
    std::vector<std::uint8_t> levels;  // [view]: progressive level, 0 .. 3; references have lower levels
    std::vector<CodedImage> images;    // [view]

    [[nodiscard]] int coded_width() const { return (width + kMacroblock - 1) / kMacroblock * kMacroblock; }
    [[nodiscard]] int coded_height() const { return (height + kMacroblock - 1) / kMacroblock * kMacroblock; }
    [[nodiscard]] int tile_width() const { return 1 << tile_width_log2; }
    [[nodiscard]] int tile_height() const { return 1 << tile_height_log2; }
    [[nodiscard]] int tile_columns() const { return (width + tile_width() - 1) >> tile_width_log2; }
    [[nodiscard]] int tile_rows() const { return (height + tile_height() - 1) >> tile_height_log2; }
};

}  // namespace rs::codec
