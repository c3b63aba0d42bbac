#include "encode/codec/board/board_alpha.hpp"

#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <algorithm>
#include <cstddef>

namespace rs::encode {
namespace {

constexpr int kAlphaSamples = 16;
constexpr std::size_t kTrainingQuarters = 40000;

void alpha_vector(const SourceImage& source, int alpha_bits, int x, int y, const WeightedVectors::Place& out) {
    for (int i = 0; i < kAlphaSamples; ++i) {
        const int level = source.alpha(x + i % 4, y + i / 4);
        out.values[i] = static_cast<std::int16_t>(codec::alpha_of_level(level, alpha_bits) - 128);
        out.weights[i] = 1;
    }
}

bool is_mixed(const SourceImage& source, int x, int y) {
    const int first = source.alpha(x, y);
    for (int i = 1; i < kAlphaSamples; ++i) {
        if (source.alpha(x + i % 4, y + i / 4) != first) return true;
    }
    return false;
}

template <class Work>
void for_mixed_quarters(const std::vector<SourceImage>& sources, const Work& work) {
    for (const SourceImage& source : sources) {
        for (int y = 0; y < source.alpha.height(); y += 4) {
            for (int x = 0; x < source.alpha.width(); x += 4) {
                if (is_mixed(source, x, y)) work(source, x, y);
            }
        }
    }
}

}  // namespace

unsigned AlphaCodebook::nearest(const SourceImage& source, int x, int y) const {
    std::int16_t values[kAlphaSamples];
    std::int16_t weights[kAlphaSamples];
    alpha_vector(source, alpha_bits, x, y, {values, weights});
    return static_cast<unsigned>(find_nearest_entry(book, values, weights).index);
}

AlphaCodebook train_alpha(const std::vector<SourceImage>& sources, int alpha_bits) {
    std::size_t count = 0;
    for_mixed_quarters(sources, [&](const SourceImage&, int, int) { ++count; });
    const std::size_t stride = std::max<std::size_t>(1, (count + kTrainingQuarters - 1) / kTrainingQuarters);
    WeightedVectors vectors;
    vectors.dimensions = kAlphaSamples;
    std::size_t number = 0;
    for_mixed_quarters(sources, [&](const SourceImage& source, int x, int y) {
        if (number++ % stride == 0) alpha_vector(source, alpha_bits, x, y, vectors.add());
    });
    AlphaCodebook alpha;
    alpha.alpha_bits = alpha_bits;
    alpha.book = train_codebook(vectors, codec::kBookEntries);
    alpha.samples.resize(alpha.book.entries.size());
    for (std::size_t i = 0; i < alpha.samples.size(); ++i) {
        int sample = std::clamp(alpha.book.entries[i] + 128, 0, 255);
        if (i < 2 * kAlphaSamples) sample = i < kAlphaSamples ? 255 : 0;
        sample = codec::alpha_of_level(codec::level_of_alpha(sample, alpha_bits), alpha_bits);
        alpha.samples[i] = static_cast<std::uint8_t>(sample);
        alpha.book.entries[i] = static_cast<std::int16_t>(sample - 128);
    }
    return alpha;
}

}  // namespace rs::encode
