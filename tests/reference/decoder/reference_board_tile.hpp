#pragma once
// FORMAT.md, "Board tiles": the records of a tile's blocks and their samples.

#include "tests/reference/decoder/reference_chunks.hpp"
#include "tests/reference/decoder/reference_decoder.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace rs::reference {

class BoardTileDecoder {
public:
    /// Parameters as in TileDecoder.
    BoardTileDecoder(const Code& code, std::array<const DecodedImage*, 2> references, int t, Bytes bytes,
                     DecodedImage& image);

    void decode();

private:
    // A record's fields; the block at (x, y) of the image.
    struct Record {
        int x = 0, y = 0;
        BoardClass kind;
        const DecodedImage* reference = nullptr;  // predicted records only
        Vector motion;                            // whole samples
        std::array<int, 3> flat = {0, 0, 0};
        std::vector<int> block_index;                   // [stage]
        std::vector<std::array<int, 4>> quarter_index;  // [stage][quarter]
        std::array<int, 4> alpha_index = {0, 0, 0, 0};  // [quarter]
    };

    int next_byte();
    std::array<int, 4> next_quarters();
    Record read_record(int b, const BoardClass& kind);
    void show(const Record& record);
    int colour(const Record& record, int plane, int x, int y) const;
    int alpha(const Record& record, int x, int y) const;

    const BoardCode& code_;
    std::array<const DecodedImage*, 2> references_;
    Bytes bytes_;
    DecodedImage& image_;
    std::size_t position_ = 0;
    int tile_x_ = 0, tile_y_ = 0;
};

}  // namespace rs::reference
