#include "rayspace/codec/board/board_profile.hpp"

#include "rayspace/base/zstd_frame.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace rs::codec {
namespace {

constexpr unsigned kPredictedBit = 1;
constexpr unsigned kAlphaBit = 2;
constexpr const char* kBooksName = "its codebooks";

std::uint8_t byte_of(const RecordClass& c) {
    return static_cast<std::uint8_t>((c.predicted ? kPredictedBit : 0U) | (c.alpha ? kAlphaBit : 0U) |
                                     (static_cast<unsigned>(c.block_stages) << 2U) |
                                     (static_cast<unsigned>(c.quarter_stages) << 4U));
}

RecordClass class_of(unsigned byte) {
    return {(byte & kPredictedBit) != 0, (byte & kAlphaBit) != 0, static_cast<int>((byte >> 2U) & 3U),
            static_cast<int>((byte >> 4U) & 15U)};
}

template <class Work>
void for_classes(const BoardCode& code, const Work& work) {
    for (const auto& table : code.classes) {
        for (std::size_t c = 1; c < table.size(); ++c) work(table[c]);
    }
}

// Visits all codebooks in file order, with the size required by the classes.
template <class Code, class Work>  // work(book, bytes)
void for_books(Code& code, const Work& work) {
    for (std::size_t kind = 0; kind < code.books.size(); ++kind) {
        const StageCounts used = stage_counts(code, kind);
        for (std::size_t s = 0; s < static_cast<std::size_t>(used.block); ++s) {
            work(code.books[kind].block[s], std::size_t{kBookEntries} * kBlockDimensions);
        }
        for (std::size_t s = 0; s < static_cast<std::size_t>(used.quarter); ++s) {
            work(code.books[kind].quarter[s], std::size_t{kBookEntries} * kQuarterDimensions);
        }
    }
    if (uses_alpha(code)) work(code.alpha, std::size_t{kBookEntries} * 16);
}

}  // namespace

StageCounts stage_counts(const BoardCode& code, std::size_t kind) {
    StageCounts used;
    for_classes(code, [&](const RecordClass& c) {
        if (c.predicted != (kind == 1)) return;
        used.block = std::max(used.block, c.block_stages);
        used.quarter = std::max(used.quarter, c.quarter_stages);
    });
    return used;
}

bool uses_alpha(const BoardCode& code) {
    bool any = false;
    for_classes(code, [&](const RecordClass& c) { any = any || c.alpha; });
    return any;
}

void put_board_code(const BoardCode& code, ByteWriter& out) {
    for_classes(code, [&](const RecordClass& c) { out.put(byte_of(c)); });
    std::vector<std::uint8_t> bytes;
    for_books(code, [&](const auto& book, std::size_t) {
        for (const auto number : book) bytes.push_back(static_cast<std::uint8_t>(number));
    });
    out.put(compress_zstd(bytes));
}

Status take_board_code(ByteReader& in, BoardCode& code) {
    for (std::size_t table = 0; table < code.classes.size(); ++table) {
        for (std::size_t c = 1; c < kBoardClasses; ++c) {
            const auto byte = in.get<std::uint8_t>();
            const RecordClass read = class_of(byte);
            if (read.block_stages > kMaxBlockStages || read.quarter_stages > kMaxQuarterStages ||
                (table == 0 && read.predicted)) {
                return Error{"describes class " + std::to_string(c) + " of records as " + std::to_string(byte) +
                             ", which it cannot be"};
            }
            code.classes[table][c] = read;
        }
    }
    if (!in.ok()) return Error{"is too short"};
    std::size_t size = 0;
    for_books(code, [&](const auto&, std::size_t bytes) { size += bytes; });
    RS_ASSIGN_OR_RETURN(const std::vector<std::uint8_t> bytes, decompress_zstd(in.take(in.left()), size, kBooksName));
    code.books = {};
    code.alpha.clear();
    auto next = bytes.begin();
    for_books(code, [&](auto& book, std::size_t book_bytes) {
        book.resize(book_bytes);
        for (auto& number : book) number = static_cast<typename std::decay_t<decltype(book)>::value_type>(*next++);
    });
    return {};
}

}  // namespace rs::codec
