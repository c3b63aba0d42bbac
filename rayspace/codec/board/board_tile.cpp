#include "rayspace/codec/board/board_profile.hpp"

#include <algorithm>
#include <cstring>

namespace rs::codec {
namespace {

using Samples = std::array<std::array<int, 64>, 3>;  // Y, U, V of a block, row by row

unsigned byte_at(std::span<const std::byte> bytes, std::size_t place) {
    return place < bytes.size() ? static_cast<unsigned>(bytes[place]) : 0;
}

void add_block(const Book& book, unsigned index, Samples& samples) {
    if (book.empty()) return;
    const std::int8_t* const entry = book.data() + static_cast<std::size_t>(index) * kBlockDimensions;
    for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t pair = i / 16 * 4 + i % 8 / 2;
        samples[0][i] += entry[i];
        samples[1][i] += entry[64 + pair];
        samples[2][i] += entry[80 + pair];
    }
}

// Quarter 0 is the upper left one, 1 the upper right, 2 the lower left.
constexpr std::size_t first_of_quarter(std::size_t quarter) {
    return quarter / 2 * 32 + quarter % 2 * 4;
}

void add_quarter(const Book& book, unsigned index, std::size_t quarter, Samples& samples) {
    if (book.empty()) return;
    const std::int8_t* const entry = book.data() + static_cast<std::size_t>(index) * kQuarterDimensions;
    for (std::size_t plane = 0; plane < 3; ++plane) {
        int* const first = samples[plane].data() + first_of_quarter(quarter);
        for (std::size_t i = 0; i < 16; ++i) first[i / 4 * 8 + i % 4] += entry[16 * plane + i];
    }
}

void predict(const ConstPlaneViews& reference, int x, int y, Samples& samples) {
    for (std::size_t plane = 0; plane < 3; ++plane) {
        const ConstImageView<std::uint8_t>& from = reference[plane];
        for (int row = 0; row < kBoardBlock; ++row) {
            const std::uint8_t* const line = from.row(std::clamp(y + row, 0, from.height() - 1));
            for (int column = 0; column < kBoardBlock; ++column) {
                samples[plane][static_cast<std::size_t>(8 * row + column)] =
                    line[std::clamp(x + column, 0, from.width() - 1)];
            }
        }
    }
}

void clear_block(int x, int y, const PlaneViews& out) {
    clear_tile({x, y, kBoardBlock, kBoardBlock}, out);
}

// Record of the block at (x, y) of the image.
struct BlockRecord {
    const RecordClass& record_class;
    std::span<const std::byte> bytes;
    int x = 0;
    int y = 0;
};

void decode_block(const BoardCode& code, const CodedTile& tile, const BlockRecord& record, const PlaneViews& out) {
    const auto& [record_class, bytes, x, y] = record;
    Samples samples;
    std::size_t next = 0;
    if (record_class.predicted) {
        BoardMotion motion = board_motion(static_cast<std::uint16_t>(byte_at(bytes, 0) | (byte_at(bytes, 1) << 8U)));
        if (tile.head.references() < 2) motion.reference = 0;
        const ConstPlaneViews& from = tile.references[static_cast<std::size_t>(motion.reference)];
        const int left = x + motion.x;
        const int top = y + motion.y;
        if (tile.listener != nullptr) {
            const int right_end = out[0].width() - 1;
            const int bottom_end = out[0].height() - 1;
            tile.listener->need(motion.reference, std::clamp(left, 0, right_end), std::clamp(top, 0, bottom_end),
                                std::clamp(left + kBoardBlock - 1, 0, right_end) + 1,
                                std::clamp(top + kBoardBlock - 1, 0, bottom_end) + 1);
        }
        predict(from, left, top, samples);
        next = 2;
    } else {
        for (auto& plane : samples) plane.fill(static_cast<int>(byte_at(bytes, next++)));
    }
    const Books& books = code.books[record_class.predicted ? 1 : 0];
    for (std::size_t stage = 0; stage < static_cast<std::size_t>(record_class.block_stages); ++stage) {
        add_block(books.block[stage], byte_at(bytes, next++), samples);
    }
    for (std::size_t stage = 0; stage < static_cast<std::size_t>(record_class.quarter_stages); ++stage) {
        for (std::size_t q = 0; q < 4; ++q) add_quarter(books.quarter[stage], byte_at(bytes, next++), q, samples);
    }
    for (std::size_t plane = 0; plane < 3; ++plane) {
        for (int row = 0; row < kBoardBlock; ++row) {
            std::uint8_t* const line = out[plane].row(y + row) + x;
            for (int column = 0; column < kBoardBlock; ++column) {
                line[column] = static_cast<std::uint8_t>(
                    std::clamp(samples[plane][static_cast<std::size_t>(8 * row + column)], 0, 255));
            }
        }
    }
    for (int row = 0; row < kBoardBlock; ++row) std::memset(out[3].row(y + row) + x, 255, kBoardBlock);
    if (!record_class.alpha || code.alpha.empty()) return;
    for (int q = 0; q < 4; ++q) {
        const std::uint8_t* const entry = code.alpha.data() + std::size_t{16} * byte_at(bytes, next++);
        for (int row = 0; row < 4; ++row)
            std::memcpy(out[3].row(y + q / 2 * 4 + row) + x + q % 2 * 4, entry + 4 * row, 4);
    }
}

}  // namespace

std::uint64_t board_tile_classes(std::span<const std::byte> bytes) {
    std::uint64_t classes = 0;
    for (std::size_t i = 0; i < kBoardTileHeadBytes; ++i) classes |= std::uint64_t{byte_at(bytes, i)} << (8 * i);
    return classes;
}

BoardMotion board_motion(std::uint16_t word) {
    return {word >> 15, ((word >> 7) & 255) - 128, (word & 127) - 64};
}

std::uint16_t board_motion_word(const BoardMotion& motion) {
    return static_cast<std::uint16_t>((motion.reference << 15) | ((motion.x + 128) << 7) | (motion.y + 64));
}

void decode_board_tile(const BoardCode& code, const CodedTile& tile, const PlaneViews& out) {
    const std::span<const std::byte> bytes = tile.bytes;
    const TileRect& place = tile.place;
    const auto& classes = code.classes[tile.head.references() > 0 ? 1 : 0];
    const std::uint64_t tile_classes = board_tile_classes(bytes);
    std::size_t next = kBoardTileHeadBytes;
    for (int block = 0; block < kBoardTileBlocks; ++block) {
        const int x = block / 4 * kBoardBlock;
        const int y = block % 4 * kBoardBlock;
        const auto number = static_cast<std::size_t>((tile_classes >> (3 * block)) & 7U);
        const auto size = number == 0 ? std::size_t{0} : static_cast<std::size_t>(classes[number].bytes());
        const std::size_t begin = std::min(next, bytes.size());
        next += size;
        if (x >= place.width || y >= place.height) continue;
        if (number == 0) {
            clear_block(place.left + x, place.top + y, out);
        } else {
            decode_block(code, tile,
                         {.record_class = classes[number],
                          .bytes = bytes.subspan(begin, std::min(size, bytes.size() - begin)),
                          .x = place.left + x,
                          .y = place.top + y},
                         out);
        }
    }
}

}  // namespace rs::codec
