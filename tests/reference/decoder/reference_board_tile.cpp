#include "tests/reference/decoder/reference_board_tile.hpp"

#include "tests/reference/decoder/reference_samples.hpp"

#include <algorithm>

namespace rs::reference {
namespace {

int signed_value(const Codebook& book, int at) {
    const int value = book.at(static_cast<std::size_t>(at));
    return value < 128 ? value : value - 256;
}

// The quarter of sample (x, y) of a block, and the sample's index in it.
int quarter_of(int x, int y) {
    return 2 * (y / 4) + x / 4;
}
int place_in_quarter(int x, int y) {
    return 4 * (y % 4) + x % 4;
}

}  // namespace

BoardTileDecoder::BoardTileDecoder(const Code& code, std::array<const DecodedImage*, 2> references, int t, Bytes bytes,
                                   DecodedImage& image)
    : code_(code.board), references_(references), bytes_(bytes), image_(image) {
    const int columns = ceil_div(image.width, 32);
    tile_x_ = 32 * (t % columns);
    tile_y_ = 32 * (t / columns);
}

void BoardTileDecoder::decode() {
    std::uint64_t classes = 0;
    for (int i = 0; i < 6; ++i) classes += static_cast<std::uint64_t>(next_byte()) << (8 * i);
    for (int b = 0; b < 16; ++b) {
        const std::size_t number = (classes >> (3 * b)) & 7;
        if (number == 0) continue;  // the image's samples are those of empty blocks
        show(read_record(b, code_.classes[references_[0] != nullptr ? 1 : 0][number]));
    }
}

// "Bytes behind the tile's end count as 0."
int BoardTileDecoder::next_byte() {
    const std::size_t at = position_++;
    return at < bytes_.size() ? bytes_[at] : 0;
}

std::array<int, 4> BoardTileDecoder::next_quarters() {
    std::array<int, 4> quarters{};
    for (int& index : quarters) index = next_byte();
    return quarters;
}

BoardTileDecoder::Record BoardTileDecoder::read_record(int b, const BoardClass& kind) {
    Record record;
    record.x = tile_x_ + 8 * (b / 4);
    record.y = tile_y_ + 8 * (b % 4);
    record.kind = kind;
    const std::size_t begin = position_;
    if (kind.is_predicted) {
        const int low = next_byte();
        const int motion = low + 256 * next_byte();
        record.motion = {((motion >> 7) & 255) - 128, (motion & 127) - 64};
        record.reference = references_[(motion >> 15) == 1 && references_[1] != nullptr ? 1 : 0];
    } else {
        for (int& value : record.flat) value = next_byte();
    }
    for (int i = 0; i < kind.block_stages; ++i) record.block_index.push_back(next_byte());
    for (int i = 0; i < kind.quarter_stages; ++i) record.quarter_index.push_back(next_quarters());
    if (kind.has_alpha) record.alpha_index = next_quarters();
    if ((position_ - begin) % 2 == 1) next_byte();
    return record;
}

void BoardTileDecoder::show(const Record& record) {
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            if (record.x + x >= image_.width || record.y + y >= image_.height) continue;
            for (int plane = 0; plane < 3; ++plane) {
                sample(image_, plane, record.x + x, record.y + y) =
                    static_cast<std::uint8_t>(std::clamp(colour(record, plane, x, y), 0, 255));
            }
            sample(image_, 3, record.x + x, record.y + y) = static_cast<std::uint8_t>(alpha(record, x, y));
        }
    }
}

// The colour of sample (x, y) of the block, before clamping.
int BoardTileDecoder::colour(const Record& record, int plane, int x, int y) const {
    int sum = record.kind.is_predicted ? nearest_sample(*record.reference, plane, record.x + x + record.motion.x,
                                                        record.y + y + record.motion.y)
                                       : record.flat[static_cast<std::size_t>(plane)];
    const std::size_t kind = record.kind.is_predicted ? 1 : 0;
    // "8x8 differences of Y, row by row, then 4x4 of U and 4x4 of V, each for 2x2 samples"
    const int place = plane == 0 ? 8 * y + x : 64 + 16 * (plane - 1) + 4 * (y / 2) + x / 2;
    for (std::size_t i = 0; i < record.block_index.size(); ++i) {
        sum += signed_value(code_.block_books[kind].at(i), 96 * record.block_index[i] + place);
    }
    // "4x4 differences of Y, 4x4 of U, 4x4 of V"
    const std::size_t quarter = static_cast<std::size_t>(quarter_of(x, y));
    for (std::size_t i = 0; i < record.quarter_index.size(); ++i) {
        sum += signed_value(code_.quarter_books[kind].at(i),
                            48 * record.quarter_index[i][quarter] + 16 * plane + place_in_quarter(x, y));
    }
    return sum;
}

int BoardTileDecoder::alpha(const Record& record, int x, int y) const {
    if (!record.kind.has_alpha) return 255;
    const int index = record.alpha_index[static_cast<std::size_t>(quarter_of(x, y))];
    return code_.alpha_book.at(static_cast<std::size_t>(16 * index + place_in_quarter(x, y)));
}

}  // namespace rs::reference
