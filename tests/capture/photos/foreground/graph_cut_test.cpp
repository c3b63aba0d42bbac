// Compares the graph cut with all labellings of small images.

#include "capture/photos/foreground/graph_cut.hpp"

#include "capture/photos/intake/colour_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rs::capture {
namespace {

// Energy of a labelling: the scores of pixels labelled against them, and the cost of each label change between
// neighbours of which at least one is undecided.
double energy_of(const Image<std::uint8_t>& object, const Image<Rgba8>& photo, const Image<float>& score,
                 const ForegroundParameters::GraphCut& parameters) {
    const auto undecided = [&](int x, int y) { return std::abs(score(x, y)) < kCertainScore; };
    double cost = 0;
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            const double own = static_cast<double>(score(x, y));
            if (undecided(x, y) && (own > 0) != (object(x, y) != 0)) cost += std::abs(own);
            for (int v = y - 1; v <= y + 1; ++v) {
                for (int u = x - 1; u <= x + 1; ++u) {
                    const bool is_later = v > y || (v == y && u > x);
                    if (!is_later || u < 0 || u >= photo.width() || v >= photo.height()) continue;
                    if (object(x, y) == object(u, v) || (!undecided(x, y) && !undecided(u, v))) continue;
                    const auto lab = [&](int a, int b) { return lab_from_linear(linear_rgb(photo(a, b))); };
                    const double contrast =
                        static_cast<double>(delta_e(lab(x, y), lab(u, v)) / parameters.contrast_delta_e);
                    const double edge_cost =
                        static_cast<double>(parameters.min_edge_cost) +
                        static_cast<double>(parameters.smoothness) * std::exp(-contrast * contrast / 2);
                    cost += edge_cost / std::hypot(u - x, v - y);
                }
            }
        }
    }
    return cost;
}

TEST(GraphCut, NoLabellingHasLessEnergy) {
    constexpr std::uint64_t kSeed = 12;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    for (int trial = 0; trial < 60; ++trial) {
        constexpr int kWidth = 5;
        constexpr int kHeight = 4;
        Image<Rgba8> photo(kWidth, kHeight);
        Image<float> score(kWidth, kHeight);
        std::vector<std::pair<int, int>> undecided;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                // Two colours with noise, so that some neighbours are similar.
                const int base = random() % 2 == 0 ? 90 : 140;
                const auto code = [&] { return static_cast<std::uint8_t>(base + static_cast<int>(random() % 12)); };
                photo(x, y) = {code(), code(), code(), 255};
                const bool is_undecided = undecided.size() < 10 && random() % 2 == 0;
                const float side = random() % 2 == 0 ? 1.0F : -1.0F;
                score(x, y) =
                    side * (is_undecided ? static_cast<float>(random() % 390) / 100.0F + 0.01F : kCertainScore);
                if (is_undecided) undecided.emplace_back(x, y);
            }
        }
        const ForegroundParameters::GraphCut parameters{.smoothness = static_cast<float>(1 + trial % 6)};
        const Image<std::uint8_t> cut = graph_cut(lab_image(photo), score, parameters);
        Image<std::uint8_t> labels(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                labels(x, y) = score(x, y) >= kCertainScore ? 255 : 0;
                if (std::abs(score(x, y)) >= kCertainScore) {
                    EXPECT_EQ(cut(x, y), labels(x, y));
                }
            }
        }
        double min_energy = std::numeric_limits<double>::infinity();
        for (unsigned bits = 0; bits < 1U << undecided.size(); ++bits) {
            for (std::size_t i = 0; i < undecided.size(); ++i) {
                labels(undecided[i].first, undecided[i].second) = (bits >> i & 1U) != 0 ? 255 : 0;
            }
            min_energy = std::min(min_energy, energy_of(labels, photo, score, parameters));
        }
        EXPECT_NEAR(energy_of(cut, photo, score, parameters), min_energy, 1e-3) << "trial " << trial;
    }
}

TEST(GraphCut, DecidedPixelsKeepTheirLabels) {
    Image<float> score(3, 1);
    for (int x = 0; x < 3; ++x) score(x, 0) = x == 1 ? kCertainScore : -kCertainScore;
    const Image<std::uint8_t> cut = graph_cut(Image<Lab>(3, 1), score, {});
    EXPECT_EQ(cut(0, 0), 0);
    EXPECT_EQ(cut(1, 0), 255);
    EXPECT_EQ(cut(2, 0), 0);
}

// A noisy body slightly darker than its surroundings, decided in its middle and far outside, and a bar 1 px wide that
// is found by its score alone and nearly vanishes in the coarse levels.
TEST(GraphCut, CoarseToFineFindsTheSameLabels) {
    constexpr int kSide = 301, kBar_y = 40;
    std::mt19937 random(5);
    Image<Rgba8> photo(kSide, kSide);
    Image<float> score(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double r = std::hypot(x - 151 + 20 * std::sin(0.05 * y), y - 160);
            const bool bar = y == kBar_y && x > 60 && x < 240;
            const auto code = static_cast<std::uint8_t>((r < 90 ? 190
                                                         : bar  ? 120
                                                                : 215) +
                                                        static_cast<int>(random() % 5));
            photo(x, y) = {code, code, code, 255};
            score(x, y) = r < 30 ? kCertainScore : r > 130 && !bar ? -kCertainScore : bar ? 1.5F : 0.02F;
        }
    }
    const Image<Lab> lab = lab_image(photo);
    const Image<std::uint8_t> whole = graph_cut(lab, score, {});
    for (const int min_px : {30000, 8000}) {  // one coarse level, and two
        SCOPED_TRACE(min_px);
        EXPECT_EQ(whole, graph_cut_coarse_to_fine(lab, score, {.coarse_min_px = min_px}));
    }
    EXPECT_EQ(whole(100, kBar_y), 255);
    EXPECT_EQ(whole(151, 235), 255);
    EXPECT_EQ(whole(151, 260), 0);
}

}  // namespace
}  // namespace rs::capture
