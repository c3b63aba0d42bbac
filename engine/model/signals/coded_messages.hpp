#pragma once
// What travels in the FIFOs of block decompression. Hop 0 is the image that answers a view column, hop 1 the one that
// a block of it is predicted from, and so on; an image is at most three hops away from one without references.

#include "engine/model/signals/messages.hpp"
#include "rayspace/codec/code/board_code.hpp"

#include <array>

namespace rs::engine::model {

inline constexpr int kHops = 4;

// Rows of one column of a block of 8x8 samples that are needed.
struct BlockAsk {
    static constexpr int kBits = 4 + 1 + 1 + 7 + 9 + 6 + 8;
    int view = 0;
    bool first = false;  // of a view column: nothing is known of the tile
    bool down = true;    // the rows are needed from the top to the bottom
    int image = 0;
    int column = 0;     // of the image
    int block_row = 0;  // rows 8 * block_row ..
    unsigned rows = 0;  // bit r: row 8 * block_row + r
    [[nodiscard]] int block() const { return ((column >> 3) & 3) * 4 + (block_row & 3); }  // of its tile
};

// Tile finder: the table's word has been requested, or the tile is that of the request before.
struct FoundTile {
    static constexpr int kBits = BlockAsk::kBits + 1 + 1;
    BlockAsk ask;
    bool same = false;
    bool high = false;  // half of the word
};

// Tile reader: the tile's first word has been requested, or it is that of the request before, or there is no tile.
struct AskedTile {
    enum class Kind { same, nothing, read };
    static constexpr int kBits = BlockAsk::kBits + 2 + 27;
    BlockAsk ask;
    Kind kind = Kind::same;
    WordAddress address = 0;
};

// Record reader: the words of the record have been requested.
struct AskedRecord {
    static constexpr int kBits = BlockAsk::kBits + 3 + 1 + 2 * 7 + 2 + 3;
    BlockAsk ask;
    int class_number = 0;
    bool predicted_image = false;  // which classes
    std::array<int, 2> references{};
    int lane = 0;   // first byte in the first word: 0, 2, 4, 6
    int words = 0;  // 0 .. 4
};

// Motion: the record with its fields in their places.
struct BlockRecord {
    static constexpr int kBits = 6 + 1 + 8 + 7 + 3 + 8 * (3 + 2 + 4 * 4 + 4);
    int block_row = 0;
    bool empty = false;  // class 0
    codec::RecordClass of;
    int motion_y = 0;          // of a predicted one
    int reference_column = 0;  // its low 3 bits: column of the block that it is predicted from
    std::array<std::uint8_t, 3> flat{};
    std::array<std::uint8_t, codec::kMaxBlockStages> block{};
    std::array<std::array<std::uint8_t, 4>, codec::kMaxQuarterStages> quarter{};  // [stage][quarter of the block]
    std::array<std::uint8_t, 4> alpha{};
};

// Which codebook entries a pixel takes at one hop, and its place in them.
struct HopLookup {
    static constexpr int kBits = 1 + 2 + 3 + 8 * (codec::kMaxBlockStages + codec::kMaxQuarterStages) + 2 * 3;
    bool predicted = false;
    int block_stages = 0;
    int quarter_stages = 0;
    std::array<std::uint8_t, codec::kMaxBlockStages> block{};
    std::array<std::uint8_t, codec::kMaxQuarterStages> quarter{};
    int x = 0, y = 0;  // of the block
};

// A pixel on its way along the hops. In front of hop h it carries h look-ups.
struct CodedPixel {
    enum class Alpha { none, full, book };
    static constexpr int kHeadBits = 4 + 1 + 1 + 1 + 9 + 3;
    static constexpr int kColourBits = 3 * 8 + 2 + 8;
    static constexpr int bits(int hop) { return kHeadBits + (hop > 0 ? kColourBits + hop * HopLookup::kBits : 0); }
    int view = 0;
    bool shows = false;
    bool begins = false;   // the next hop's record is another one than that of the pixel before
    bool pending = false;  // a record of the next hop is needed
    int row = 0;           // of the next hop's image
    int column = 0;        // of its block, 0 .. 7
    std::array<std::uint8_t, 3> flat{};
    Alpha alpha = Alpha::none;
    std::uint8_t alpha_entry = 0;
    int hops = 0;
    std::array<HopLookup, kHops> hop;
};

inline std::string text(const BlockAsk& m) {
    return "view " + std::to_string(m.view) + " image " + std::to_string(m.image) + " column " +
           std::to_string(m.column) + " block row " + std::to_string(m.block_row);
}
inline std::string text(const FoundTile& m) {
    return text(m.ask) + (m.same ? " same tile" : "");
}
inline std::string text(const AskedTile& m) {
    constexpr const char* kKinds[] = {" same tile", " no tile", " tile"};
    return text(m.ask) + kKinds[static_cast<int>(m.kind)];
}
inline std::string text(const AskedRecord& m) {
    return text(m.ask) + " class " + std::to_string(m.class_number) + ", words " + std::to_string(m.words);
}
inline std::string text(const BlockRecord& m) {
    return "block row " + std::to_string(m.block_row) + (m.empty ? " empty" : m.of.predicted ? " predicted" : " flat");
}
inline std::string text(const CodedPixel& m) {
    return "view " + std::to_string(m.view) + (m.shows ? " row " + std::to_string(m.row) : " -") +
           (m.pending ? " pending" : "");
}

}  // namespace rs::engine::model
