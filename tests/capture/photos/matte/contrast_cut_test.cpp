// The graph cut against all labellings of small pictures.

#include "capture/photos/matte/contrast_cut.hpp"

#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/matte/object_mask.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rs::capture {
namespace {

// What a labelling costs: each pixel that goes against its preference, and each pair of neighbours that is parted where
// at least one of them is undecided.
double cost_of(const Image<std::uint8_t>& object, const Image<Rgba8>& photo, const Image<float>& preference,
               const CutOptions& options) {
    const auto undecided = [&](int x, int y) { return std::abs(preference(x, y)) < kDecided; };
    double cost = 0;
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            const double own = static_cast<double>(preference(x, y));
            if (undecided(x, y) && (own > 0) != (object(x, y) != 0)) cost += std::abs(own);
            for (int v = y - 1; v <= y + 1; ++v) {
                for (int u = x - 1; u <= x + 1; ++u) {
                    const bool is_later = v > y || (v == y && u > x);
                    if (!is_later || u < 0 || u >= photo.width() || v >= photo.height()) continue;
                    if (object(x, y) == object(u, v) || (!undecided(x, y) && !undecided(u, v))) continue;
                    const auto lab = [&](int a, int b) { return lab_from_linear(linear_rgb(photo(a, b))); };
                    const double contrast =
                        static_cast<double>(delta_e(lab(x, y), lab(u, v)) / options.contrast_delta_e);
                    const double parting = static_cast<double>(options.floor) +
                                           static_cast<double>(options.smoothness) * std::exp(-contrast * contrast / 2);
                    cost += parting / std::hypot(u - x, v - y);
                }
            }
        }
    }
    return cost;
}

TEST(ContrastCut, NoLabellingCostsLess) {
    constexpr std::uint64_t kSeed = 12;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    for (int trial = 0; trial < 60; ++trial) {
        constexpr int kWidth = 5;
        constexpr int kHeight = 4;
        Image<Rgba8> photo(kWidth, kHeight);
        Image<float> preference(kWidth, kHeight);
        std::vector<std::pair<int, int>> open;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                // Two colours with noise, so that some neighbours are alike.
                const int base = random() % 2 == 0 ? 90 : 140;
                const auto code = [&] { return static_cast<std::uint8_t>(base + static_cast<int>(random() % 12)); };
                photo(x, y) = {code(), code(), code(), 255};
                const bool is_open = open.size() < 10 && random() % 2 == 0;
                const float side = random() % 2 == 0 ? 1.0F : -1.0F;
                preference(x, y) = side * (is_open ? static_cast<float>(random() % 390) / 100.0F + 0.01F : kDecided);
                if (is_open) open.emplace_back(x, y);
            }
        }
        const CutOptions options{.smoothness = static_cast<float>(1 + trial % 6)};
        const Image<std::uint8_t> cut = cut_by_contrast(lab_picture(photo), preference, options);
        Image<std::uint8_t> tried(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                tried(x, y) = preference(x, y) >= kDecided ? 255 : 0;
                if (std::abs(preference(x, y)) >= kDecided) {
                    EXPECT_EQ(cut(x, y), tried(x, y));
                }
            }
        }
        double least = std::numeric_limits<double>::infinity();
        for (unsigned labels = 0; labels < 1U << open.size(); ++labels) {
            for (std::size_t i = 0; i < open.size(); ++i) {
                tried(open[i].first, open[i].second) = (labels >> i & 1U) != 0 ? 255 : 0;
            }
            least = std::min(least, cost_of(tried, photo, preference, options));
        }
        EXPECT_NEAR(cost_of(cut, photo, preference, options), least, 1e-3) << "trial " << trial;
    }
}

TEST(ContrastCut, WithoutAnyDoubtTheSidesStay) {
    Image<float> preference(3, 1);
    for (int x = 0; x < 3; ++x) preference(x, 0) = x == 1 ? kDecided : -kDecided;
    const Image<std::uint8_t> cut = cut_by_contrast(Image<Lab>(3, 1), preference, {});
    EXPECT_EQ(cut(0, 0), 0);
    EXPECT_EQ(cut(1, 0), 255);
    EXPECT_EQ(cut(2, 0), 0);
}

// A body a little darker than what is around it, known in its middle and far outside, with noise; and a bar of one
// pixel that only its preference tells: the coarse pictures hardly know it.
TEST(ContrastCut, CoarseFirstFindsTheSame) {
    constexpr int kSide = 301, kBar_y = 40;
    std::mt19937 random(5);
    Image<Rgba8> photo(kSide, kSide);
    Image<float> preference(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double r = std::hypot(x - 151 + 20 * std::sin(0.05 * y), y - 160);
            const bool bar = y == kBar_y && x > 60 && x < 240;
            const auto code = static_cast<std::uint8_t>((r < 90 ? 190
                                                         : bar  ? 120
                                                                : 215) +
                                                        static_cast<int>(random() % 5));
            photo(x, y) = {code, code, code, 255};
            preference(x, y) = r < 30 ? kDecided : r > 130 && !bar ? -kDecided : bar ? 1.5F : 0.02F;
        }
    }
    const Image<Lab> looks = lab_picture(photo);
    const Image<std::uint8_t> whole = cut_by_contrast(looks, preference, {});
    for (const int from_px : {30000, 8000}) {  // one coarse picture, and two
        SCOPED_TRACE(from_px);
        EXPECT_EQ(whole, cut_coarse_first(looks, preference, {.coarse_from_px = from_px}));
    }
    EXPECT_EQ(whole(100, kBar_y), 255);
    EXPECT_EQ(whole(151, 235), 255);
    EXPECT_EQ(whole(151, 260), 0);
}

}  // namespace
}  // namespace rs::capture
