#include "compositor/scene/light/prefiltered_reflections.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rs::compositor {
namespace {

constexpr unsigned kLobeSamples = 32;

glm::vec3 rgb_of(const RgbaF& p) {
    return {p.r, p.g, p.b};
}

RgbaF texel_of(const glm::vec3& c) {
    return {c.r, c.g, c.b, 1};
}

Image<RgbaF> halved(const Image<RgbaF>& from) {
    Image<RgbaF> half(from.width() / 2, from.height() / 2);
    for (int y = 0; y < half.height(); ++y) {
        for (int x = 0; x < half.width(); ++x) {
            half(x, y) = texel_of(0.25F * (rgb_of(from(2 * x, 2 * y)) + rgb_of(from(2 * x + 1, 2 * y)) +
                                           rgb_of(from(2 * x, 2 * y + 1)) + rgb_of(from(2 * x + 1, 2 * y + 1))));
        }
    }
    return half;
}

glm::vec3 look_up(const Image<RgbaF>& map, const glm::vec3& direction) {
    return radiance_in_map(map, {0.5F + std::atan2(direction.x, -direction.z) / (2 * kPiF),
                                 std::acos(std::clamp(direction.y, -1.0F, 1.0F)) / kPiF});
}

struct LobeSample {
    glm::vec3 direction;  // about +z
    float weight;         // its cosine; the sum over the lobe is 1
    std::size_t level;  // of the box-filtered source whose pixels are about as large as the sample's share of the lobe
};

// Second coordinate of the Hammersley points (van der Corput sequence).
float radical_inverse(std::uint32_t bits) {
    float value = 0;
    for (float digit = 0.5F; bits != 0; bits >>= 1, digit *= 0.5F) value += (bits & 1U) != 0 ? digit : 0;
    return value;
}

// Importance samples of GGX with the normal as view direction, filtered (J. Krivanek and M. Colbert, Real-time Shading
// with Filtered Importance Sampling, 2008).
std::vector<LobeSample> lobe_samples(float roughness, std::size_t levels) {
    const float alpha2 = std::pow(roughness, 4.0F);
    const float pixel = 4 * kPiF / (kReflectionWidth * kReflectionHeight);  // mean solid angle, sr
    std::vector<LobeSample> samples;
    float sum = 0;
    for (std::uint32_t i = 0; i < kLobeSamples; ++i) {
        const float u = (static_cast<float>(i) + 0.5F) / kLobeSamples;
        const float facet2 = (1 - u) / (1 + (alpha2 - 1) * u);  // squared cosine of the facet's normal
        const float cosine = 2 * facet2 - 1;
        if (!(cosine > 0)) continue;
        const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0F));
        const float turn = 2 * kPiF * radical_inverse(i);
        const float slope = facet2 * (alpha2 - 1) + 1;
        const float density = alpha2 / (kPiF * slope * slope) / 4;  // of the reflected direction, per steradian
        const float share = 1 / (kLobeSamples * density);
        const float level = std::clamp(0.5F * std::log2(share / pixel) + 0.5F, 0.0F, static_cast<float>(levels - 1));
        samples.push_back({{sine * std::cos(turn), sine * std::sin(turn), cosine},
                           cosine,
                           static_cast<std::size_t>(std::lround(level))});
        sum += cosine;
    }
    for (LobeSample& sample : samples) sample.weight /= sum;
    return samples;
}

Image<RgbaF> filtered(const std::vector<Image<RgbaF>>& source, const std::vector<LobeSample>& lobe, glm::ivec2 size) {
    Image<RgbaF> level(size.x, size.y);
    for_each_index(size.y, 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < size.x; ++x) {
            const Frame frame(direction_in_map(glm::vec2(x, y) + 0.5F, size));
            glm::vec3 sum(0);
            for (const LobeSample& sample : lobe) {
                sum += sample.weight * look_up(source[sample.level], frame.to_world(sample.direction));
            }
            level(x, y) = texel_of(sum);
        }
    });
    return level;
}

}  // namespace

glm::vec3 direction_in_map(const glm::vec2& position, const glm::ivec2& size) {
    const float azimuth = 2 * kPiF * (position.x / static_cast<float>(size.x) - 0.5F);  // from -Z towards +X
    const float polar = kPiF * position.y / static_cast<float>(size.y);
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

glm::vec3 radiance_in_map(const Image<RgbaF>& map, const glm::vec2& uv) {
    const float x = (uv.x - std::floor(uv.x)) * static_cast<float>(map.width()) - 0.5F;
    const float y =
        std::clamp(uv.y * static_cast<float>(map.height()) - 0.5F, 0.0F, static_cast<float>(map.height() - 1));
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(y);
    const float fx = x - std::floor(x), fy = y - static_cast<float>(top);
    const int x0 = (left + map.width()) % map.width(), x1 = (left + 1) % map.width();
    const int y1 = std::min(top + 1, map.height() - 1);
    return glm::mix(glm::mix(rgb_of(map(x0, top)), rgb_of(map(x1, top)), fx),
                    glm::mix(rgb_of(map(x0, y1)), rgb_of(map(x1, y1)), fx), fy);
}

std::vector<Image<RgbaF>> prefilter_reflections(Image<RgbaF> radiance) {
    RS_CHECK(radiance.width() == kReflectionWidth && radiance.height() == kReflectionHeight);
    std::vector<Image<RgbaF>> source;
    source.push_back(std::move(radiance));
    while (source.size() < kReflectionLevels) source.push_back(halved(source.back()));
    std::vector<Image<RgbaF>> levels;
    for (int i = 1; i < kReflectionLevels; ++i) {
        const auto lobe = lobe_samples(static_cast<float>(i) / (kReflectionLevels - 1), source.size());
        levels.push_back(filtered(source, lobe, {kReflectionWidth >> i, kReflectionHeight >> i}));
    }
    levels.insert(levels.begin(), std::move(source.front()));
    return levels;
}

}  // namespace rs::compositor
