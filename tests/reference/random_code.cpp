#include "tests/reference/random_code.hpp"

#include "tests/reference/decoder/reference_chunks.hpp"
#include "tests/reference/decoder/reference_contexts.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>

namespace rs::reference {
namespace {

// With even probabilities most of a tile is empty or without coefficients, its bytes are spent on alpha, and levels
// saturate samples at 0 or 255. A tame stream has fewer of all these.
int tame_probability(int context, Random& random) {
    if (context < kSplit) return context % 2 == 0 ? random.whole(5, 60) : random.whole(150, 250);
    if (context >= kCoded && context < kLastClass) return random.whole(5, 120);
    if (context >= kNonZero && context < kAboveOne) return random.whole(120, 240);
    if (context >= kAboveOne && context < kAlphaZero) return random.whole(200, 255);
    return random.whole(1, 255);
}

int random_class(bool may_be_predicted, bool has_stages, Random& random) {
    const int predicted = may_be_predicted && !random.one_in(3) ? 1 : 0;
    if (!has_stages) return predicted;
    const int alpha = random.one_in(2) ? 2 : 0;
    return predicted + alpha + 4 * random.whole(0, 2) + 16 * random.whole(0, 4);
}

// Number of codebooks of each kind used by the classes: "of flat records the block stages' ..., then the quarter
// stages'; likewise of predicted ones; then, if any class has alpha, that of alpha".
struct BookCounts {
    std::array<int, 2> block = {0, 0};  // [is predicted]
    std::array<int, 2> quarter = {0, 0};
    bool alpha = false;

    void use(int record) {
        const std::size_t kind = record & 1;
        block[kind] = std::max(block[kind], (record >> 2) & 3);
        quarter[kind] = std::max(quarter[kind], record >> 4);
        alpha = alpha || (record & 2) != 0;
    }
};

// Differences as bytes: small ones in a tame book, else any, with entries at the ends of the range. Entry e equals
// entry e mod `distinct`: with fewer than 256 the frame is much smaller than the book.
void put_book(std::vector<std::uint8_t>& books, int bytes_of_entry, int distinct, bool is_tame, Random& random) {
    const std::size_t begin = books.size();
    const int largest = is_tame ? random.whole(1, 12) : 127;
    for (int entry = 0; entry < distinct; ++entry) {
        const bool is_extreme = !is_tame && random.one_in(8);
        const int end = random.one_in(2) ? -128 : 127;
        for (int i = 0; i < bytes_of_entry; ++i) {
            put(books, is_extreme ? end : random.whole(-largest - 1, largest));
        }
    }
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>((256 - distinct) * bytes_of_entry); ++i) {
        books.push_back(std::uint8_t{books[i]});
    }
}

std::vector<std::uint8_t> frame_of(const std::vector<std::uint8_t>& books, Random& random) {
    if (books.empty()) return {};
    std::vector<std::uint8_t> frame(ZSTD_compressBound(books.size()));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), books.data(), books.size(), random.whole(-5, 5)));
    return frame;
}

}  // namespace

std::vector<std::uint8_t> random_dense_code(const std::vector<int>& levels, bool is_tame, Random& random) {
    std::vector<std::uint8_t> code = {1};
    for (int i = 0; i < 2; ++i) put(code, random.whole(4, 6));
    const int bits = random.whole(1, 6);
    const bool has_levels = random.one_in(3);
    put(code, has_levels ? 1 + bits % 4 : bits);
    for (int i = 0; i < 2; ++i) put(code, is_tame ? random.whole(-4, 4) : random.whole(-31, 31));
    const std::size_t alpha_coding = has_levels ? 0 : bits <= 2 ? 1 : 2;
    put(code, static_cast<int>(alpha_coding));
    put(code, random.one_in(2) ? 7 : random.whole(0, 7));
    for (const int level : levels) put(code, level);
    for (int i = 0; i < 24 && alpha_coding == 1 && code[3] == 1; ++i) put(code, random.whole(0, 127));
    const std::size_t listed_at = code.size();
    code.resize(listed_at + kListedBytes[alpha_coding]);
    for (int context = 0; context < kContexts[alpha_coding]; ++context) {
        if (!is_tame && random.one_in(8)) continue;
        std::uint8_t& byte = code[listed_at + static_cast<std::size_t>(context / 8)];
        byte = static_cast<std::uint8_t>(byte | (1 << context % 8));
        put(code, is_tame ? tame_probability(context, random) : random.whole(1, 255));
    }
    return code;
}

std::vector<std::uint8_t> random_board_code(const std::vector<int>& levels, bool is_tame, Random& random) {
    std::vector<std::uint8_t> code = {2, 5, 5, 0, 0, 0, 0, 0};
    for (const int level : levels) put(code, level);
    const bool has_stages = !random.one_in(16);
    BookCounts counts;
    for (int i = 0; i < 14; ++i) {
        const int record = random_class(i >= 7, has_stages, random);
        put(code, record);
        counts.use(record);
    }
    const int distinct = random.one_in(4) ? random.whole(1, 16) : 256;
    std::vector<std::uint8_t> books;
    for (std::size_t kind = 0; kind < 2; ++kind) {
        for (int i = 0; i < counts.block[kind]; ++i) put_book(books, 96, distinct, is_tame, random);
        for (int i = 0; i < counts.quarter[kind]; ++i) put_book(books, 48, distinct, is_tame, random);
    }
    if (counts.alpha) put_book(books, 16, distinct, false, random);
    const std::vector<std::uint8_t> frame = frame_of(books, random);
    code.insert(code.end(), frame.begin(), frame.end());
    return code;
}

}  // namespace rs::reference
