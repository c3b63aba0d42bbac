#pragma once
// Data shared by all board images of an object (chunk CODE): record classes and codebooks. A record of fixed size
// describes a block of 8x8 pixels, whose samples are the sum of a prediction and codebook entries. encode/FORMAT.md,
// section "Board tiles".

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::codec {

inline constexpr int kBoardTileLog2 = 5;     // tiles of 32x32: 16 blocks
inline constexpr int kBoardClasses = 8;      // classes of blocks; class 0 is empty
inline constexpr int kBookEntries = 256;     // an index is one byte
inline constexpr int kMaxBlockStages = 2;    // codebooks of whole blocks per record
inline constexpr int kMaxQuarterStages = 4;  // codebooks of 4x4 quarters per record

/// Contents of the records of one class.
struct RecordClass {
    bool predicted = false;  // from another image; else from a flat colour
    bool alpha = false;      // has an alpha pattern per quarter; else all samples are covered
    int block_stages = 0;    // 0 .. kMaxBlockStages
    int quarter_stages = 0;  // 0 .. kMaxQuarterStages
    bool operator==(const RecordClass&) const = default;

    /// Size of a record; even, so that records begin at even addresses.
    [[nodiscard]] int bytes() const {
        return ((predicted ? 2 : 3) + block_stages + 4 * quarter_stages + (alpha ? 4 : 0) + 1) / 2 * 2;
    }
};

/// Entry e of a book begins at [e * dimensions]. Block entries: 64 differences of Y, row by row, then 16 of U and 16 of
/// V, each for 2x2 pixels. Quarter entries: 16 of Y, 16 of U, 16 of V.
inline constexpr int kBlockDimensions = 64 + 16 + 16;
inline constexpr int kQuarterDimensions = 3 * 16;
using Book = std::vector<std::int8_t>;

struct Books {
    std::array<Book, kMaxBlockStages> block;      // kBookEntries * kBlockDimensions; empty if no class uses it
    std::array<Book, kMaxQuarterStages> quarter;  // kBookEntries * kQuarterDimensions; empty if no class uses it
    bool operator==(const Books&) const = default;
};

struct BoardCode {
    // [images without references, with][class]. Images without references have no predicted classes; class 0 is not
    // used.
    std::array<std::array<RecordClass, kBoardClasses>, 2> classes;
    std::array<Books, 2> books;       // [flat blocks, predicted blocks]
    std::vector<std::uint8_t> alpha;  // kBookEntries quarters of 16 alpha samples; empty if not used
};

}  // namespace rs::codec
