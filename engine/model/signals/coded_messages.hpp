#pragma once
// Messages in the FIFOs of block decompression. Hop 0 is the image that shows a view column, hop 1 the image that a
// block of it is predicted from, and so on; an image is at most three hops away from an image without references.

#include "engine/model/signals/messages.hpp"
#include "rayspace/codec/code/board_code.hpp"

#include <array>

namespace rs::engine::model {

inline constexpr int kHops = 4;

// Request for rows of one column of a block of 8x8 samples.
struct BlockRequest {
    static constexpr int kBits = 4 + 1 + 1 + 7 + 9 + 6 + 8;
    int view = 0;
    bool first = false;  // first request of a view column: the previous tile is invalid
    bool down = true;    // the rows are needed from the top to the bottom
    int image = 0;
    int column = 0;     // of the image
    int block_row = 0;  // rows 8 * block_row ..
    unsigned rows = 0;  // bit r: row 8 * block_row + r
    [[nodiscard]] int block() const {
        return ((column >> 3) & 3) * 4 + (block_row & 3);
    }  // index of the block in its tile
};

// Tile finder output: the word of the tile table is requested, or the tile equals that of the previous request.
struct FoundTile {
    static constexpr int kBits = BlockRequest::kBits + 1 + 1;
    BlockRequest request;
    bool same = false;
    bool high = false;  // the entry is the high half of the word
};

// Tile reader output: the first word of the tile is requested, the tile equals that of the previous request, or there
// is no tile.
struct RequestedTile {
    enum class Kind { same, nothing, read };
    static constexpr int kBits = BlockRequest::kBits + 2 + 27;
    BlockRequest request;
    Kind kind = Kind::same;
    WordAddress address = 0;
};

// Record reader output: the words of the record are requested.
struct RequestedRecord {
    static constexpr int kBits = BlockRequest::kBits + 3 + 1 + 2 * 7 + 2 + 3;
    BlockRequest request;
    int class_number = 0;
    bool predicted_image = false;  // selects the classes of predicted images
    std::array<int, 2> references{};
    int lane = 0;   // first byte in the first word: 0, 2, 4, 6
    int words = 0;  // 0 .. 4
};

// Block motion output: the record, split into its fields.
struct BlockRecord {
    static constexpr int kBits = 6 + 1 + 8 + 7 + 3 + 8 * (3 + 2 + 4 * 4 + 4);
    int block_row = 0;
    bool empty = false;  // class 0
    codec::RecordClass record_class;
    int motion_y = 0;          // predicted records only
    int reference_column = 0;  // low 3 bits: column in the block that the record is predicted from
    std::array<std::uint8_t, 3> flat{};
    std::array<std::uint8_t, codec::kMaxBlockStages> block{};
    std::array<std::array<std::uint8_t, 4>, codec::kMaxQuarterStages> quarter{};  // [stage][quarter of the block]
    std::array<std::uint8_t, 4> alpha{};
};

// Codebook entries of a pixel at one hop, and its position in the block.
struct HopLookup {
    static constexpr int kBits = 1 + 2 + 3 + 8 * (codec::kMaxBlockStages + codec::kMaxQuarterStages) + 2 * 3;
    bool predicted = false;
    int block_stages = 0;
    int quarter_stages = 0;
    std::array<std::uint8_t, codec::kMaxBlockStages> block{};
    std::array<std::uint8_t, codec::kMaxQuarterStages> quarter{};
    int x = 0, y = 0;  // of the block
};

// A pixel on its way through the hops. Before hop h it has h look-ups.
struct CodedPixel {
    enum class Alpha { none, full, book };
    static constexpr int kHeadBits = 4 + 1 + 1 + 1 + 9 + 3;
    static constexpr int kColourBits = 3 * 8 + 2 + 8;
    static constexpr int bits(int hop) { return kHeadBits + (hop > 0 ? kColourBits + hop * HopLookup::kBits : 0); }
    int view = 0;
    bool shows = false;
    bool begins = false;   // the next hop's record differs from that of the previous pixel
    bool pending = false;  // a record of the next hop is needed
    int row = 0;           // of the next hop's image
    int column = 0;        // of its block, 0 .. 7
    std::array<std::uint8_t, 3> flat{};
    Alpha alpha = Alpha::none;
    std::uint8_t alpha_entry = 0;
    int hops = 0;
    std::array<HopLookup, kHops> hop;
};

inline std::string text(const BlockRequest& m) {
    return "view " + std::to_string(m.view) + " image " + std::to_string(m.image) + " column " +
           std::to_string(m.column) + " block row " + std::to_string(m.block_row);
}
inline std::string text(const FoundTile& m) {
    return text(m.request) + (m.same ? " same tile" : "");
}
inline std::string text(const RequestedTile& m) {
    constexpr const char* kKinds[] = {" same tile", " no tile", " tile"};
    return text(m.request) + kKinds[static_cast<int>(m.kind)];
}
inline std::string text(const RequestedRecord& m) {
    return text(m.request) + " class " + std::to_string(m.class_number) + ", words " + std::to_string(m.words);
}
inline std::string text(const BlockRecord& m) {
    return "block row " + std::to_string(m.block_row) +
           (m.empty                    ? " empty"
            : m.record_class.predicted ? " predicted"
                                       : " flat");
}
inline std::string text(const CodedPixel& m) {
    return "view " + std::to_string(m.view) + (m.shows ? " row " + std::to_string(m.row) : " -") +
           (m.pending ? " pending" : "");
}

}  // namespace rs::engine::model
