#include "tests/reference/decoder/reference_board_code.hpp"

#include "tests/reference/decoder/reference_bytes.hpp"

#include <algorithm>

namespace rs::reference {
namespace {

constexpr std::size_t kClassBytes = 2 * 7;
constexpr std::size_t kEntries = 256;

// "The byte of a class"
std::string read_class(std::uint8_t byte, bool may_be_predicted, BoardClass& read) {
    read.is_predicted = (byte & 1) != 0;
    read.has_alpha = (byte & 2) != 0;
    read.block_stages = (byte >> 2) & 3;
    read.quarter_stages = byte >> 4;
    if (read.block_stages > 2) return "more block stages than 2";
    if (read.quarter_stages > 4) return "more quarter stages than 4";
    if (read.is_predicted && !may_be_predicted) return "a predicted class for images without references";
    return "";
}

}  // namespace

std::string read_board_code(std::span<const std::uint8_t> payload, BoardCode& code) {
    if (payload.size() < kClassBytes) return "CODE is shorter than its classes";
    std::array<int, 2> block_stages = {0, 0};  // [is_predicted]
    std::array<int, 2> quarter_stages = {0, 0};
    bool has_alpha = false;
    for (std::size_t i = 0; i < kClassBytes; ++i) {
        BoardClass& read = code.classes[i / 7][1 + i % 7];
        std::string error = read_class(payload[i], i >= 7, read);
        if (!error.empty()) return error;
        const std::size_t kind = read.is_predicted ? 1 : 0;
        block_stages[kind] = std::max(block_stages[kind], read.block_stages);
        quarter_stages[kind] = std::max(quarter_stages[kind], read.quarter_stages);
        has_alpha = has_alpha || read.has_alpha;
    }

    std::size_t size = has_alpha ? kEntries * 16 : 0;
    for (std::size_t kind = 0; kind < 2; ++kind) {
        size += kEntries * static_cast<std::size_t>(96 * block_stages[kind] + 48 * quarter_stages[kind]);
    }
    std::vector<std::uint8_t> books;
    if (std::string error = expand(payload.subspan(kClassBytes), size, books); !error.empty()) return error;

    auto at = books.cbegin();
    const auto next_book = [&](int bytes_of_entry) {
        const auto begin = at;
        at += static_cast<std::ptrdiff_t>(kEntries) * bytes_of_entry;
        return Codebook(begin, at);
    };
    for (std::size_t kind = 0; kind < 2; ++kind) {
        for (int i = 0; i < block_stages[kind]; ++i) code.block_books[kind].push_back(next_book(96));
        for (int i = 0; i < quarter_stages[kind]; ++i) code.quarter_books[kind].push_back(next_book(48));
    }
    if (has_alpha) code.alpha_book = next_book(16);
    return "";
}

}  // namespace rs::reference
