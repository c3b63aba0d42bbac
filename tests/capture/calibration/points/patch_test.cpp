#include "capture/calibration/points/patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kTextureSide_px = 120;
constexpr double kTextureNoise = 2;  // grey values, one standard deviation

// Grey values of about 40..210 with detail in all directions.
double texture(const glm::dvec2& p) {
    return 125 + 40 * std::sin(0.75 * p.x + 0.35 * p.y) + 25 * std::sin(0.4 * p.y - 0.9 * p.x + 1) +
           20 * std::sin(0.85 * p.y + 0.1 * p.x + 2);
}

// View of the texture: p_in_image = matrix * (p_in_texture - middle) + middle + shift.
struct Look {
    glm::dmat2 matrix{1.0};
    glm::dvec2 shift{0.0};
    double gain = 1;
    double slope = 0;  // of the illumination, grey values per px to the right
    [[nodiscard]] glm::dvec2 seen(const glm::dvec2& p) const { return matrix * (p - middle()) + middle() + shift; }
    [[nodiscard]] glm::dvec2 shown(const glm::dvec2& p) const {
        return glm::inverse(matrix) * (p - middle() - shift) + middle();
    }
    static glm::dvec2 middle() { return glm::dvec2(kTextureSide_px / 2.0); }
};

template <class Grey>
PatchImage noisy_image(unsigned seed, const Grey& grey) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, kTextureNoise);
    CalibrationImage image{Image<std::uint8_t>(kTextureSide_px, kTextureSide_px),
                           Image<std::uint8_t>(kTextureSide_px, kTextureSide_px, 255)};
    for (int y = 0; y < kTextureSide_px; ++y) {
        for (int x = 0; x < kTextureSide_px; ++x) {
            const double value = grey(glm::dvec2(x + 0.5, y + 0.5)) + noise(random);
            image.grey(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
        }
    }
    return PatchImage(image);
}

PatchImage detect(const Look& look, unsigned seed) {
    return noisy_image(seed, [&](const glm::dvec2& p) {
        return look.gain * texture(look.shown(p)) + look.slope * (p.x - kTextureSide_px / 2.0);
    });
}

std::vector<glm::dvec2> places() {
    std::vector<glm::dvec2> all;
    for (const double y : {30.2, 45.7, 60.5, 75.1, 90.4}) {
        for (const double x : {30.9, 46.3, 59.5, 74.8, 89.6}) all.emplace_back(x, y);
    }
    return all;
}

TEST(Patch, AKnownWarpIsFoundToAFewHundredthsOfAPixel) {
    const PatchImage before = detect({}, 1);
    const Look look{glm::dmat2({0.93, 0.06}, {-0.08, 1.05}), {0.63, -0.41}, 0.8, 0.25};
    const PatchImage after = detect(look, 2);
    for (const bool curvature_is_known : {true, false}) {
        double squares = 0, worst_matrix = 0;
        for (const glm::dvec2& place : places()) {
            const std::optional<Patch> patch = extract_patch(before, place);
            ASSERT_TRUE(patch.has_value());
            Warp warp;  // predicted by a first bundle: a pixel and a half off, not rotated
            warp.centre = look.seen(place) + glm::dvec2(1.2, -0.9);
            warp.deeper = {0.4, 0.1};
            const std::optional<Alignment> found = align(after, *patch, warp, curvature_is_known);
            ASSERT_TRUE(found.has_value()) << place.x << " " << place.y;
            const glm::dvec2 off = found->seen.p - look.seen(place);
            squares += glm::dot(off, off) / static_cast<double>(2 * places().size());
            for (int k = 0; k < 2; ++k) {
                worst_matrix = std::max(worst_matrix, glm::length(found->matrix[k] - look.matrix[k]));
            }
        }
        EXPECT_LT(std::sqrt(squares), 0.03) << curvature_is_known;  // per coordinate
        EXPECT_LT(worst_matrix, 0.04) << curvature_is_known;
    }
}

TEST(Patch, NothingIsFoundWhereThereIsNoTexture) {
    const PatchImage plain = noisy_image(5, [](const glm::dvec2& p) { return 60 + 0.8 * p.x; });
    const PatchImage textured = detect({}, 6);
    for (const glm::dvec2& place : places()) {
        EXPECT_FALSE(extract_patch(plain, place).has_value());
        const std::optional<Patch> patch = extract_patch(textured, place);
        ASSERT_TRUE(patch.has_value());
        Warp warp;
        warp.centre = place;
        EXPECT_FALSE(align(plain, *patch, warp, true).has_value());
    }
}

TEST(Patch, NothingIsFoundThatIsNotWhereItIsExpected) {
    const PatchImage before = detect({}, 7), after = detect({}, 8);
    const PatchImage covered = noisy_image(9, [](const glm::dvec2& p) {  // by another texture
        return 50 + 0.6 * texture(p) + 45 * std::sin(0.5 * p.x - 0.9 * p.y);
    });
    for (const glm::dvec2& place : places()) {
        const std::optional<Patch> patch = extract_patch(before, place);
        ASSERT_TRUE(patch.has_value());
        Warp warp;
        warp.centre = place + glm::dvec2(3.4, 0);  // farther than the allowed movement
        const std::optional<Alignment> far = align(after, *patch, warp, true);
        EXPECT_TRUE(!far || glm::distance(far->seen.p, place) > 1);
        warp.centre = place;
        EXPECT_FALSE(align(covered, *patch, warp, true).has_value()) << place.x << " " << place.y;
    }
}

}  // namespace
}  // namespace rs::capture
