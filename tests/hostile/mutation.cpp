#include "tests/hostile/mutation.hpp"

#include "rayspace/base/zstd_frame.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace rs::test {

namespace {

constexpr std::array<std::uint64_t, 16> kEnds = {0,
                                                 1,
                                                 2,
                                                 0x7F,
                                                 0x80,
                                                 0xFF,
                                                 0x7FFF,
                                                 0x8000,
                                                 0xFFFF,
                                                 0x7FFFFFFF,
                                                 0x80000000,
                                                 0xFFFFFFFF,
                                                 0x100000000,
                                                 0x7FFFFFFFFFFFFFFF,
                                                 0x8000000000000000,
                                                 0xFFFFFFFFFFFFFFFF};

constexpr std::array<std::string_view, 26> kStrange = {
    "-1",   "0",         "1e38",       "-1e308",      "1e-320",
    "nan",  "inf",       "4294967296", "-2147483649", "99999999999999999999",
    "\"\"", "null",      "true",       "{",           "}",
    "[",    "]",         "\"",         "\n",          "\x1b[2J",
    "..",   "/dev/full", "\\u0000",    "%n%s",        "1/1/1",
    "-0.0"};

std::ptrdiff_t at(std::size_t i) {
    return static_cast<std::ptrdiff_t>(i);
}

constexpr std::array kMagic = {std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD}};

// Mutates the content of the first Zstandard frame of the bytes; false if there is none.
bool mutate_compressed(std::vector<std::byte>& bytes, Random& random) {
    const auto frame = std::search(bytes.begin(), bytes.end(), kMagic.begin(), kMagic.end());
    if (frame == bytes.end()) return false;
    const std::vector<std::byte> rest(frame, bytes.end());
    const auto size = read_zstd_content_size(rest);
    if (!size || *size > (std::uint64_t{1} << 24)) return false;
    const auto content = decompress_zstd(rest, *size, "it");
    if (!content) return false;
    std::vector<std::byte> inside(content->size());
    std::memcpy(inside.data(), content->data(), inside.size());
    const std::size_t before = inside.size();
    mutate_bytes(inside, random);
    if (below(random, 4) != 0) inside.resize(before);  // the size stated in the chunk stays valid
    std::vector<std::uint8_t> numbers(inside.size());
    if (!inside.empty()) std::memcpy(numbers.data(), inside.data(), inside.size());
    const std::vector<std::byte> again = compress_zstd(numbers);
    bytes.erase(frame, bytes.end());
    bytes.insert(bytes.end(), again.begin(), again.end());
    return true;
}

// Splits into runs of letters and digits, runs of space, and single other characters.
std::vector<std::string> pieces_of(const std::string& text) {
    std::vector<std::string> pieces;
    const auto kind = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isspace(byte) != 0) return 0;
        return std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '+' || c == '_' ? 1 : 2;
    };
    for (const char c : text) {
        if (!pieces.empty() && kind(c) != 2 && kind(pieces.back().back()) == kind(c)) {
            pieces.back() += c;
        } else {
            pieces.emplace_back(1, c);
        }
    }
    return pieces;
}

}  // namespace

std::size_t below(Random& random, std::size_t count) {
    return static_cast<std::size_t>(random() % count);
}

void mutate_bytes(std::vector<std::byte>& bytes, Random& random) {
    if (bytes.empty()) bytes.push_back(std::byte{0});
    // Prefer heads, which contain the sizes and counts.
    const auto place = [&] {
        return below(random, below(random, 2) == 0 ? std::min<std::size_t>(bytes.size(), 96) : bytes.size());
    };
    switch (below(random, 6)) {
        case 0:
            for (std::size_t n = 1 + below(random, 4); n > 0; --n) {
                bytes[place()] ^= static_cast<std::byte>(1U << below(random, 8));
            }
            break;
        case 1: {
            const std::size_t width = std::size_t{1} << below(random, 4);
            const std::uint64_t number = kEnds[below(random, kEnds.size())] + below(random, 3) - 1;
            const std::size_t first = place();
            for (std::size_t i = 0; i < width && first + i < bytes.size(); ++i) {
                bytes[first + i] = static_cast<std::byte>(number >> (8 * i));
            }
            break;
        }
        case 2:
            bytes.resize(place() + 1);
            break;
        case 3: {
            const std::size_t from = place(), to = place();
            const std::size_t count = std::min({1 + below(random, 64), bytes.size() - from, bytes.size() - to});
            const std::vector<std::byte> piece(bytes.begin() + at(from), bytes.begin() + at(from + count));
            std::copy(piece.begin(), piece.end(), bytes.begin() + at(to));
            break;
        }
        case 4: {
            const std::size_t first = place();
            const std::size_t end = std::min(bytes.size(), first + 1 + below(random, 64));
            const std::vector<std::byte> piece(bytes.begin() + at(first), bytes.begin() + at(end));
            if (below(random, 2) == 0) {
                bytes.insert(bytes.begin() + at(first), piece.begin(), piece.end());
            } else if (piece.size() < bytes.size()) {
                bytes.erase(bytes.begin() + at(first), bytes.begin() + at(end));
            }
            break;
        }
        default:
            for (std::size_t i = place(), n = below(random, 200); n > 0 && i < bytes.size(); ++i, --n) {
                bytes[i] = static_cast<std::byte>(random());
            }
    }
}

void mutate_chunks(std::vector<fuzz::SoupChunk>& chunks, Random& random) {
    for (std::size_t n = 1 + below(random, 3); n > 0 && !chunks.empty(); --n) {
        const std::size_t one = below(random, chunks.size());
        const std::size_t other = below(random, chunks.size());
        switch (below(random, 12)) {
            case 0:
                chunks.erase(chunks.begin() + at(one));
                break;
            case 1:
                std::swap(chunks[one].payload, chunks[other].payload);
                break;
            case 2:
                std::swap(chunks[one], chunks[other]);
                break;
            case 3:
                chunks.push_back(chunks[one]);
                chunks.back().index = static_cast<std::uint32_t>(kEnds[below(random, 12)]);
                break;
            case 4:
                chunks[one].name = chunks[other].name;
                break;
            case 5:
            case 6:
            case 7:
                if (mutate_compressed(chunks[one].payload, random)) break;
                [[fallthrough]];
            default:
                mutate_bytes(chunks[one].payload, random);
        }
    }
}

std::string mutate_text(const std::string& text, Random& random) {
    std::vector<std::string> pieces = pieces_of(text);
    for (std::size_t n = 1 + below(random, 3); n > 0 && !pieces.empty(); --n) {
        std::size_t one = below(random, pieces.size());
        const bool wants_number = below(random, 2) == 0;
        for (int look = 0;
             wants_number && look < 50 && std::isdigit(static_cast<unsigned char>(pieces[one].back())) == 0; ++look) {
            one = below(random, pieces.size());
        }
        const std::size_t count = std::min(1 + below(random, 30), pieces.size() - one);
        switch (below(random, 7)) {
            case 0:
            case 1:
            case 2:
                pieces[one] = kStrange[below(random, kStrange.size())];
                break;
            case 3:
                pieces.erase(pieces.begin() + at(one), pieces.begin() + at(one + count));
                break;
            case 4: {
                const std::vector<std::string> piece(pieces.begin() + at(one), pieces.begin() + at(one + count));
                const std::size_t to = below(random, pieces.size());
                pieces.insert(pieces.begin() + at(to), piece.begin(), piece.end());
                break;
            }
            case 5:
                std::swap(pieces[one], pieces[below(random, pieces.size())]);
                break;
            default: {
                std::string deep;
                for (int i = 0; i < 2000; ++i) deep += below(random, 50) == 0 ? "{\"a\":" : "[";
                pieces[one] = deep;
            }
        }
    }
    std::string changed;
    for (const std::string& piece : pieces) changed += piece;
    if (below(random, 8) == 0) changed.resize(below(random, changed.size() + 1));
    return changed;
}

}  // namespace rs::test
