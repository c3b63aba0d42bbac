#include "capture/calibration/points/patch_equations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>

namespace rs::capture {
namespace {

// An image of smooth noise on a disc.
CalibrationImage noisy_disc(int width, int height, unsigned seed) {
    std::minstd_rand random(seed);
    std::uniform_int_distribution<int> grey(40, 220);
    CalibrationImage image{Image<std::uint8_t>(width, height), Image<std::uint8_t>(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.grey(x, y) = static_cast<std::uint8_t>(grey(random));
            const bool inside = std::hypot(x - 0.5 * width, y - 0.5 * height) < 0.45 * height;
            image.alpha(x, y) = inside ? 255 : 0;
        }
    }
    return image;
}

// Reference implementation of PatchImage, pixel by pixel.
struct PlainImage {
    Image<double> smooth;
    Image<std::uint8_t> alpha;

    explicit PlainImage(const CalibrationImage& image)
        : smooth(image.grey.width(), image.grey.height()), alpha(image.alpha) {
        constexpr std::array<double, 5> kKernel{0.03, 0.235, 0.47, 0.235, 0.03};
        for (int y = 0; y < smooth.height(); ++y) {
            for (int x = 0; x < smooth.width(); ++x) {
                for (int dy = -2; dy <= 2; ++dy) {
                    for (int dx = -2; dx <= 2; ++dx) {
                        smooth(x, y) += kKernel[static_cast<std::size_t>(dx + 2)] *
                                        kKernel[static_cast<std::size_t>(dy + 2)] *
                                        image.grey(std::clamp(x + dx, 0, smooth.width() - 1),
                                                   std::clamp(y + dy, 0, smooth.height() - 1));
                    }
                }
            }
        }
    }
    [[nodiscard]] bool is_inside(const glm::dvec2& p) const {
        const int column = static_cast<int>(std::floor(p.x)), row = static_cast<int>(std::floor(p.y));
        return column >= 2 && row >= 2 && column < alpha.width() - 2 && row < alpha.height() - 2 &&
               alpha(column, row) > 250;
    }
    [[nodiscard]] double sample(double x, double y) const {
        const int left = static_cast<int>(std::floor(x - 0.5)), top = static_cast<int>(std::floor(y - 0.5));
        const double u = x - 0.5 - left, v = y - 0.5 - top;
        return (1 - v) * ((1 - u) * smooth(left, top) + u * smooth(left + 1, top)) +
               v * ((1 - u) * smooth(left, top + 1) + u * smooth(left + 1, top + 1));
    }
};

Warp some_warp(glm::dvec2 centre) {
    Warp warp;
    warp.centre = centre;
    warp.matrix = {{1.05, 0.03}, {-0.08, 0.93}};
    warp.bent = {glm::dvec2(0.004, -0.002), glm::dvec2(0.001, 0.003), glm::dvec2(-0.002, 0.001)};
    warp.deeper = {0.31, -0.12};
    return warp;
}

glm::dvec2 place(const Warp& warp, int i, int j) {
    return warp.centre + warp.matrix * glm::dvec2(i, j) + warp.bent[0] * (0.5 * i * i) + warp.bent[1] * (0.5 * j * j) +
           warp.bent[2] * static_cast<double>(i * j);
}

TEST(PatchImage, ShowsWhatPlainSamplingShows) {
    const CalibrationImage image = noisy_disc(90, 70, 3);
    const PatchImage fast(image);
    const PlainImage plain(image);
    int counted = 0, left_out = 0;
    for (const glm::dvec2 centre : {glm::dvec2(45.3, 35.8), glm::dvec2(30.02, 22.97), glm::dvec2(72.5, 40)}) {
        const Warp warp = some_warp(centre);
        EXPECT_EQ(fast.is_solid(centre), plain.is_inside(centre));
        for (int j = -kPatchHalf_px; j <= kPatchHalf_px; ++j) {
            const SeenRow row = fast.row(warp, j);
            for (int i = -kPatchHalf_px; i <= kPatchHalf_px; ++i) {
                const auto c = static_cast<std::size_t>(i + kPatchHalf_px);
                const glm::dvec2 p = place(warp, i, j);
                ASSERT_EQ(row.counts[c] > 0, plain.is_inside(p)) << i << ", " << j;
                ++(row.counts[c] > 0 ? counted : left_out);
                if (row.counts[c] == 0) continue;
                EXPECT_NEAR(row.value[c], plain.sample(p.x, p.y), 0.01);
                EXPECT_NEAR(row.slope_x[c], 0.5 * (plain.sample(p.x + 1, p.y) - plain.sample(p.x - 1, p.y)), 0.01);
                EXPECT_NEAR(row.slope_y[c], 0.5 * (plain.sample(p.x, p.y + 1) - plain.sample(p.x, p.y - 1)), 0.01);
            }
            EXPECT_EQ(row.counts[kPatchColumns - 1], 0);
        }
    }
    EXPECT_GT(counted, 300);
    EXPECT_GT(left_out, 30);
}

TEST(PatchImage, NothingIsSolidWhereThereIsNoObject) {
    CalibrationImage image = noisy_disc(40, 30, 3);
    std::fill(image.alpha.pixels().begin(), image.alpha.pixels().end(), std::uint8_t{250});
    const PatchImage fast(image);
    EXPECT_FALSE(fast.is_solid({20, 15}));
    EXPECT_EQ(fast.row(some_warp({20, 15}), 0).counts, PatchRow{});
    EXPECT_FALSE(PatchImage(noisy_disc(40, 30, 3)).is_solid({1e9, -1e9}));
}

// Reference implementation, pixel by pixel.
PatchEquations plain_patch_equations(std::span<const SeenRow> seen, std::span<const PatchRow> texture,
                                     std::span<const PatchRow> weight, float less, const glm::dvec2& deeper,
                                     bool curvature_is_known) {
    PatchEquations sums;
    for (std::size_t row = 0; row < seen.size(); ++row) {
        const int j = static_cast<int>(row) - kPatchHalf_px;
        for (std::size_t c = 0; c + 1 < kPatchColumns; ++c) {
            const int i = static_cast<int>(c) - kPatchHalf_px;
            const double sx = static_cast<double>(seen[row].slope_x[c]), sy = static_cast<double>(seen[row].slope_y[c]);
            const double when_deeper = sx * deeper.x + sy * deeper.y;
            const double t = static_cast<double>(texture[row][c]), w = static_cast<double>(weight[row][c]);
            const double rest = static_cast<double>(seen[row].value[c] - less) - t;
            PatchEquations::Vector slope;
            slope << -sx, -sy, -sx * i, -sx * j, -sy * i, -sy * j, t, 1, i, j, -0.5 * when_deeper * i * i,
                -0.5 * when_deeper * j * j, -when_deeper * i * j;
            if (curvature_is_known) slope.tail<3>().setZero();
            sums.normal += w * slope * slope.transpose();
            sums.right_side += w * rest * slope;
            sums.squares += w * rest * rest;
            sums.texture += w * t * t;
            sums.weights += w;
        }
    }
    return sums;
}

class PatchEquationsTest : public testing::TestWithParam<bool> {};

TEST_P(PatchEquationsTest, AreThoseOfAllPixels) {
    const bool curvature_is_known = GetParam();
    const PatchImage image(noisy_disc(90, 70, 5));
    const Warp warp = some_warp({58.2, 37.1});
    std::minstd_rand random(7);
    std::uniform_real_distribution<float> number(-30, 30), share(0, 1);
    std::array<SeenRow, kPatchSide_px> seen;
    std::array<PatchRow, kPatchSide_px> texture{}, weight{};
    constexpr float kLess = 131;
    PatchSums sums(curvature_is_known);
    for (std::size_t row = 0; row < kPatchSide_px; ++row) {
        const int j = static_cast<int>(row) - kPatchHalf_px;
        seen[row] = image.row(warp, j);
        for (std::size_t c = 0; c + 1 < kPatchColumns; ++c) {
            texture[row][c] = number(random);
            weight[row][c] = share(random) * seen[row].counts[c];
        }
        sums.add(j, seen[row], texture[row], weight[row], kLess);
    }
    const PatchEquations fast = sums.equations(warp.deeper);
    const PatchEquations plain = plain_patch_equations(seen, texture, weight, kLess, warp.deeper, curvature_is_known);
    for (int k = 0; k < kPatchUnknowns; ++k) {
        for (int l = 0; l < kPatchUnknowns; ++l) {
            // Relative to the lengths of the derivatives.
            const double size = std::sqrt(plain.normal(k, k) * plain.normal(l, l));
            EXPECT_NEAR(fast.normal(k, l), plain.normal(k, l), 1e-5 * size) << k << ", " << l;
        }
        EXPECT_NEAR(fast.right_side[k], plain.right_side[k], 1e-5 * std::sqrt(plain.normal(k, k) * plain.squares)) << k;
    }
    EXPECT_NEAR(fast.squares, plain.squares, 1e-5 * plain.squares);
    EXPECT_NEAR(fast.texture, plain.texture, 1e-5 * plain.texture);
    EXPECT_NEAR(fast.weights, plain.weights, 1e-5 * plain.weights);
    EXPECT_GT(plain.weights, 20);
}

INSTANTIATE_TEST_SUITE_P(KnownCurvatureAndNot, PatchEquationsTest, testing::Bool());

}  // namespace
}  // namespace rs::capture
