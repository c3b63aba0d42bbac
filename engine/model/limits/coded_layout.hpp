#pragma once
// Layout of images of profile `board` in board memory. The driver unpacks an object into it on loading; the readers
// need only additions and two products of few bits:
//
//     tile table  32 bits a tile, two to a word, low half first; entry of (image p, tile column i, tile row j) at
//                 (p * tile_columns + i) * table_pitch + j, table_pitch: the tile rows, rounded up to an even number.
//                 An entry is the word address of the tile; all ones: the tile is empty.
//     tile        word 0: the 16 classes of its blocks (48 bits) | reference a (8 bits) | reference b (8): images,
//                 255 without; with one reference both are equal. Then the records, as in the file (encode/FORMAT.md,
//                 "Board tiles"), followed by zeros where the file's bytes end early and up to a whole word.
//     codebooks   as the frame of CODE expands, eight bytes to a word
//
// The tiles of an image are consecutive, column by column.

#include "rayspace/codec/board/board_profile.hpp"
#include "rayspace/codec/code/coded_images.hpp"

#include <cstdint>

namespace rs::engine::model {

inline constexpr std::uint32_t kNoTile = 0xFFFFFFFF;
inline constexpr int kNoReferenceByte = 255;

// Class of block `block` of a tile; 3 bits per block.
constexpr int block_class(std::uint64_t tile_classes, int block) {
    return static_cast<int>((tile_classes >> (3 * block)) & 7U);
}

// Bytes of the records of blocks 0 .. `block` - 1: a tree of adders in hardware.
template <class Classes>
int record_offset(std::uint64_t tile_classes, int block, const Classes& classes) {
    int bytes = 0;
    for (int b = 0; b < block; ++b) {
        const int number = block_class(tile_classes, b);
        bytes += number == 0 ? 0 : classes[static_cast<std::size_t>(number)].bytes();
    }
    return bytes;
}

constexpr int tile_table_pitch(int tile_rows) {
    return (tile_rows + 1) / 2 * 2;
}

inline std::uint64_t tile_table_words(const codec::CodedImages& coded) {
    return coded.images.size() * static_cast<std::uint64_t>(coded.tile_columns()) *
           static_cast<std::uint64_t>(tile_table_pitch(coded.tile_rows()) / 2);
}

// Words of a tile; 0 for an empty tile.
inline int tile_words(const codec::CodedImages& coded, const codec::CodedImage& image, std::size_t tile) {
    if (!image.tiles[tile].present) return 0;
    const std::uint64_t classes = codec::board_tile_classes(image.tile_bytes(tile));
    if (classes == 0) return 0;
    const auto& sizes = coded.board.classes[image.head.references() > 0 ? 1 : 0];
    return 1 + (record_offset(classes, codec::kBoardTileBlocks, sizes) + 7) / 8;
}

// Words of the tiles of all images with references (`predicted`) or without.
inline std::uint64_t image_words(const codec::CodedImages& coded, bool predicted) {
    std::uint64_t words = 0;
    for (const codec::CodedImage& image : coded.images) {
        if ((image.head.references() > 0) != predicted) continue;
        for (std::size_t t = 0; t < image.tiles.size(); ++t) {
            words += static_cast<std::uint64_t>(tile_words(coded, image, t));
        }
    }
    return words;
}

inline std::uint64_t book_words(const codec::BoardCode& code) {
    std::uint64_t bytes = code.alpha.size();
    for (const codec::Books& books : code.books) {
        for (const codec::Book& book : books.block) bytes += book.size();
        for (const codec::Book& book : books.quarter) bytes += book.size();
    }
    return bytes / 8;
}

}  // namespace rs::engine::model
