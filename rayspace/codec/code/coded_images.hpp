#pragma once
// The images of an object as its file holds them: a part that all share, and per image a head and tiles. A tile can
// be decoded without the others of its image; encode/FORMAT.md, section "Coded images".

#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/code/dense_code.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::codec {

enum class Profile : std::uint8_t {
    kDense = 1,  // best rate; entropy-coded tiles
    kBoard = 2,  // records of fixed sizes and look-ups, for hardware
};
constexpr const char* name_of(Profile profile) {
    return profile == Profile::kBoard ? "board" : "dense";
}

// Where a tile's bytes stand among its image's. A tile that is not present shows nothing.
struct TileSpan {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    bool present = false;
};

struct CodedImage {
    ImageHead head;
    std::vector<TileSpan> tiles;   // row by row; empty where the image is not loaded
    std::vector<std::byte> bytes;  // of all tiles

    [[nodiscard]] bool loaded() const { return !tiles.empty(); }
    [[nodiscard]] std::span<const std::byte> tile_bytes(std::size_t tile) const {
        return std::span(bytes).subspan(tiles[tile].begin, tiles[tile].size);
    }
};

struct CodedImages {
    Profile profile = Profile::kDense;
    int width = 0;  // of the images
    int height = 0;
    int tile_width_log2 = 5;   // kMinTileLog2 .. kMaxTileLog2
    int tile_height_log2 = 5;  // the same
    DenseCode dense;           // one of the two, by `profile`
    BoardCode board;
    std::vector<std::uint8_t> levels;  // [view]: progressive level, 0 .. 3; an image is predicted from lower ones
    std::vector<CodedImage> images;    // [view]

    [[nodiscard]] int coded_width() const { return (width + kMacroblock - 1) / kMacroblock * kMacroblock; }
    [[nodiscard]] int coded_height() const { return (height + kMacroblock - 1) / kMacroblock * kMacroblock; }
    [[nodiscard]] int tile_width() const { return 1 << tile_width_log2; }
    [[nodiscard]] int tile_height() const { return 1 << tile_height_log2; }
    [[nodiscard]] int tile_columns() const { return (width + tile_width() - 1) >> tile_width_log2; }
    [[nodiscard]] int tile_rows() const { return (height + tile_height() - 1) >> tile_height_log2; }
};

}  // namespace rs::codec
