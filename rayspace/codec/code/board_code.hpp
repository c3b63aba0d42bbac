#pragma once
// What all board images of an object share (chunk CODE): classes of records and codebooks. A record of fixed size
// describes a block of 8x8 pixels; its samples are a prediction plus entries of codebooks, added up. encode/FORMAT.md,
// section "Board tiles".

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::codec {

inline constexpr int kBoardTileLog2 = 5;     // tiles of 32x32: 16 blocks
inline constexpr int kBoardClasses = 8;      // of blocks; class 0 is empty
inline constexpr int kBookEntries = 256;     // an index is a byte
inline constexpr int kMaxBlockStages = 2;    // codebooks of whole blocks that a record may use
inline constexpr int kMaxQuarterStages = 4;  // of quarters of blocks, 4x4

// What a record of one class holds.
struct RecordClass {
    bool predicted = false;  // from another image; else from a flat colour
    bool alpha = false;      // states which samples are covered; else all are
    int block_stages = 0;    // 0 .. kMaxBlockStages
    int quarter_stages = 0;  // 0 .. kMaxQuarterStages
    bool operator==(const RecordClass&) const = default;

    // Even, so that records begin at even places.
    [[nodiscard]] int bytes() const {
        return ((predicted ? 2 : 3) + block_stages + 4 * quarter_stages + (alpha ? 4 : 0) + 1) / 2 * 2;
    }
};

// Entry e of a book stands at [e * dimensions]. Of a whole block: 64 differences of Y, row by row, then 16 of U and 16
// of V, each for 2x2 pixels. Of a quarter: 16 of Y, 16 of U, 16 of V.
inline constexpr int kBlockDimensions = 64 + 16 + 16;
inline constexpr int kQuarterDimensions = 3 * 16;
using Book = std::vector<std::int8_t>;

struct Books {
    std::array<Book, kMaxBlockStages> block;      // kBookEntries * kBlockDimensions, or empty where no class uses it
    std::array<Book, kMaxQuarterStages> quarter;  // kBookEntries * kQuarterDimensions, likewise
    bool operator==(const Books&) const = default;
};

struct BoardCode {
    // [images without references, with][class]; the first has no predicted classes, class 0 is not used.
    std::array<std::array<RecordClass, kBoardClasses>, 2> classes;
    std::array<Books, 2> books;       // [of flat blocks, of predicted ones]
    std::vector<std::uint8_t> alpha;  // kBookEntries * 16 samples of alpha, of a quarter each; empty where not used
};

}  // namespace rs::codec
