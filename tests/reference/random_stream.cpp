#include "tests/reference/random_stream.hpp"

#include "rayspace/codec/stream/coded_chunks.hpp"
#include "tests/reference/random_code.hpp"

#include <algorithm>
#include <random>

namespace rs::reference {
namespace {

std::vector<std::uint8_t> random_tile(Profile profile, Random& random) {
    // The longest tile of board records has 6 + 16 * 26 = 422 bytes.
    const int longest = profile == Profile::kBoard ? 500 : 2500;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(random.whole(0, random.one_in(4) ? 40 : longest)));
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random.whole(0, 255));
    // An initial value as large as the range is a corner case of the decoder.
    if (random.one_in(8)) std::fill_n(bytes.begin(), std::min<std::size_t>(bytes.size(), 2), std::uint8_t{255});
    if (random.one_in(32)) std::fill(bytes.begin(), bytes.end(), std::uint8_t{255});
    return bytes;
}

std::vector<std::uint8_t> random_pict(Profile profile, int tiles, const std::vector<int>& lower_views, bool is_tame,
                                      Random& random) {
    const bool is_board = profile == Profile::kBoard;
    std::vector<std::uint8_t> pict = {1};
    put(pict, is_board ? 0 : is_tame ? random.whole(20, 54) : random.whole(0, 63));
    std::vector<int> references = lower_views;
    for (std::size_t i = references.size(); i > 1; --i) {
        std::swap(references[i - 1], references[static_cast<std::size_t>(random.whole(0, static_cast<int>(i) - 1))]);
    }
    const int wanted = random.one_in(is_board ? 3 : 6) ? random.whole(0, 1) : 2;
    references.resize(std::min(references.size(), static_cast<std::size_t>(wanted)));
    references.resize(2, kNoView);
    for (const int reference : references) put16(pict, reference);
    const int farthest = is_board ? 0 : random.one_in(4) ? 1023 : 30;
    for (int i = 0; i < 4; ++i) put16(pict, random.one_in(16) ? farthest : random.whole(-farthest, farthest));
    put16(pict, 0);

    const std::size_t present_at = pict.size();
    pict.resize(present_at + static_cast<std::size_t>(ceil_div(tiles, 8)));
    std::vector<std::uint8_t> all;
    for (int t = 0; t < tiles; ++t) {
        if (random.one_in(8)) continue;
        std::uint8_t& byte = pict[present_at + static_cast<std::size_t>(t / 8)];
        byte = static_cast<std::uint8_t>(byte | (1 << t % 8));
        const std::vector<std::uint8_t> tile = random_tile(profile, random);
        const int size = static_cast<int>(tile.size());
        if (size >= 128) put(pict, 128 + size % 128);
        put(pict, size >= 128 ? size / 128 : size);
        all.insert(all.end(), tile.begin(), tile.end());
    }
    pict.insert(pict.end(), all.begin(), all.end());
    return pict;
}

}  // namespace

Stream random_stream(std::uint64_t seed, Profile profile) {
    Random random(seed);
    Stream stream;
    stream.width = random.whole(1, 96);
    stream.height = random.whole(1, 96);
    // The longest vectors are rare, so that not all point out of the image.
    if (random.one_in(12)) {
        stream.width = random.whole(300, 420);
        stream.height = random.whole(1, 32);
        if (random.one_in(2)) std::swap(stream.width, stream.height);
    }
    const bool is_tame = !random.one_in(4);
    std::vector<int> levels(static_cast<std::size_t>(random.whole(2, 5)));
    for (std::size_t v = 0; v < levels.size(); ++v) levels[v] = std::min(static_cast<int>(v), random.whole(1, 3));
    std::shuffle(levels.begin(), levels.end(), std::mt19937_64(seed));
    stream.code = profile == Profile::kBoard ? random_board_code(levels, is_tame, random)
                                             : random_dense_code(levels, is_tame, random);
    const int tiles = ceil_div(stream.width, 1 << stream.code[1]) * ceil_div(stream.height, 1 << stream.code[2]);
    for (const int level : levels) {
        std::vector<int> lower;
        for (std::size_t v = 0; v < levels.size(); ++v) {
            if (levels[v] < level) lower.push_back(static_cast<int>(v));
        }
        stream.picts.push_back(random_pict(profile, tiles, lower, is_tame, random));
    }
    return stream;
}

std::string parse_stream(const Stream& stream, codec::CodedImages& coded) {
    const Status status =
        codec::parse_code(as_payload(stream.code), stream.picts.size(), stream.width, stream.height, coded);
    if (!status.ok()) return status.error().message;
    for (std::size_t v = 0; v < stream.picts.size(); ++v) {
        const Status image = codec::parse_coded_image(as_payload(stream.picts[v]), v, coded);
        if (!image.ok()) return image.error().message;
    }
    return "";
}

}  // namespace rs::reference
