#include "tests/reference/random_stream.hpp"

#include "rayspace/codec/coded_chunks.hpp"
#include "tests/reference/reference_chunks.hpp"
#include "tests/reference/reference_contexts.hpp"

#include <algorithm>
#include <random>

namespace rs::reference {
namespace {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
    bool one_in(int n) { return whole(1, n) == 1; }

private:
    std::mt19937_64 engine_;
};

void put(std::vector<std::uint8_t>& bytes, int value) {
    bytes.push_back(static_cast<std::uint8_t>(value));
}

void put16(std::vector<std::uint8_t>& bytes, int value) {
    put(bytes, value & 255);
    put(bytes, (value >> 8) & 255);
}

// Under even probabilities most of a tile is empty or without coefficients, its bytes are spent on alpha, and levels
// drive samples to 0 or 255. A tame stream has less of all these.
int tame_probability(int context, Random& random) {
    if (context < kSplit) return context % 2 == 0 ? random.whole(5, 60) : random.whole(150, 250);
    if (context >= kCoded && context < kLastClass) return random.whole(5, 120);
    if (context >= kNonZero && context < kAboveOne) return random.whole(120, 240);
    if (context >= kAboveOne && context < kAlphaZero) return random.whole(200, 255);
    return random.whole(1, 255);
}

std::vector<std::uint8_t> random_code(const std::vector<int>& levels, bool is_tame, Random& random) {
    std::vector<std::uint8_t> code = {1};
    for (int i = 0; i < 2; ++i) put(code, random.whole(4, 6));
    put(code, random.whole(1, 4));
    for (int i = 0; i < 2; ++i) put(code, is_tame ? random.whole(-4, 4) : random.whole(-31, 31));
    put16(code, 0);
    for (const int level : levels) put(code, level);
    const std::size_t listed_at = code.size();
    code.resize(listed_at + 181);
    for (int context = 0; context < kContexts; ++context) {
        if (!is_tame && random.one_in(8)) continue;
        std::uint8_t& byte = code[listed_at + static_cast<std::size_t>(context / 8)];
        byte = static_cast<std::uint8_t>(byte | (1 << context % 8));
        put(code, is_tame ? tame_probability(context, random) : random.whole(1, 255));
    }
    return code;
}

std::vector<std::uint8_t> random_tile(Random& random) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(random.whole(0, random.one_in(4) ? 40 : 2500)));
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.whole(0, 255));
    // A value that begins as large as the range is the decoder's corner.
    if (random.one_in(8)) std::fill_n(bytes.begin(), std::min<std::size_t>(bytes.size(), 2), std::uint8_t{255});
    if (random.one_in(32)) std::fill(bytes.begin(), bytes.end(), std::uint8_t{255});
    return bytes;
}

std::vector<std::uint8_t> random_pict(int tiles, const std::vector<int>& lower_views, bool is_tame, Random& random) {
    std::vector<std::uint8_t> pict = {1};
    put(pict, is_tame ? random.whole(20, 54) : random.whole(0, 63));
    std::vector<int> references = lower_views;
    for (std::size_t i = references.size(); i > 1; --i) {
        std::swap(references[i - 1], references[static_cast<std::size_t>(random.whole(0, static_cast<int>(i) - 1))]);
    }
    const int wanted = random.one_in(6) ? random.whole(0, 1) : 2;
    references.resize(std::min(references.size(), static_cast<std::size_t>(wanted)));
    references.resize(2, kNoView);
    for (const int reference : references) put16(pict, reference);
    const int farthest = random.one_in(4) ? 1023 : 30;
    for (int i = 0; i < 4; ++i) put16(pict, random.one_in(16) ? farthest : random.whole(-farthest, farthest));
    put16(pict, 0);

    const std::size_t present_at = pict.size();
    pict.resize(present_at + static_cast<std::size_t>(ceil_div(tiles, 8)));
    std::vector<std::uint8_t> all;
    for (int t = 0; t < tiles; ++t) {
        if (random.one_in(8)) continue;
        std::uint8_t& byte = pict[present_at + static_cast<std::size_t>(t / 8)];
        byte = static_cast<std::uint8_t>(byte | (1 << t % 8));
        const std::vector<std::uint8_t> tile = random_tile(random);
        const int size = static_cast<int>(tile.size());
        if (size >= 128) put(pict, 128 + size % 128);
        put(pict, size >= 128 ? size / 128 : size);
        all.insert(all.end(), tile.begin(), tile.end());
    }
    pict.insert(pict.end(), all.begin(), all.end());
    return pict;
}

}  // namespace

Stream random_stream(std::uint64_t seed) {
    Random random(seed);
    Stream stream;
    stream.width = random.whole(1, 96);
    stream.height = random.whole(1, 96);
    // The longest vectors matter only where they do not always lead out of the picture.
    if (random.one_in(12)) {
        stream.width = random.whole(300, 420);
        stream.height = random.whole(1, 32);
        if (random.one_in(2)) std::swap(stream.width, stream.height);
    }
    const bool is_tame = !random.one_in(4);
    std::vector<int> levels(static_cast<std::size_t>(random.whole(2, 5)));
    for (std::size_t v = 0; v < levels.size(); ++v) levels[v] = std::min(static_cast<int>(v), random.whole(1, 3));
    std::shuffle(levels.begin(), levels.end(), std::mt19937_64(seed));
    stream.code = random_code(levels, is_tame, random);
    const int tiles = ceil_div(stream.width, 1 << stream.code[1]) * ceil_div(stream.height, 1 << stream.code[2]);
    for (const int level : levels) {
        std::vector<int> lower;
        for (std::size_t v = 0; v < levels.size(); ++v) {
            if (levels[v] < level) lower.push_back(static_cast<int>(v));
        }
        stream.picts.push_back(random_pict(tiles, lower, is_tame, random));
    }
    return stream;
}

std::string parse_stream(const Stream& stream, codec::CodedPictures& coded) {
    const Status status =
        codec::parse_code(as_payload(stream.code), stream.picts.size(), stream.width, stream.height, coded);
    if (!status.ok()) return status.error().message;
    for (std::size_t v = 0; v < stream.picts.size(); ++v) {
        const Status picture = codec::parse_coded_picture(as_payload(stream.picts[v]), v, coded);
        if (!picture.ok()) return picture.error().message;
    }
    return "";
}

}  // namespace rs::reference
