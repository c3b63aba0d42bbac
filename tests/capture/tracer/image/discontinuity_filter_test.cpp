// Denoising filter: noise reduction, preservation of edges, convergence as samples are added.

#include "capture/tracer/image/discontinuity_filter.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>

namespace rs::capture::test {
namespace {

constexpr int kSide = 96;

// A wall at z = 0 at distance 10 with guides from `surface`; each sample is `light` times its colour, times a random
// number between 0 and 2 if noisy.
struct Wall {
    std::function<Guide(int x, int y)> surface;
    std::function<float(int x, int y)> light;
    bool noisy = true;
};

Guide plain(int x, int y) {
    return {{0.01F * static_cast<float>(x), 0.01F * static_cast<float>(y), 0}, {0, 0, 1}, glm::vec3(0.5F), 10};
}

Accumulation samples_of(const Wall& wall, int count) {
    rs::test::Random random(5);
    Accumulation result;
    result.sum = Image<RgbaF>(kSide, kSide);
    result.guides = Image<GuideSum>(kSide, kSide);
    for (int pass = 0; pass < count; ++pass) {
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                RadianceSample sample;
                sample.hit = sample.has_guide = true;
                sample.guide = wall.surface(x, y);
                const auto noise = static_cast<float>(wall.noisy ? random.real(0, 2) : 1);
                sample.radiance = wall.light(x, y) * noise * sample.guide.colour;
                result.add(x, y, sample);
            }
        }
    }
    result.samples = count;
    return result;
}

// RMS difference from the expected value.
double rms_error(const Image<RgbaF>& image, const Wall& wall) {
    double squares = 0;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double d = static_cast<double>(image(x, y).g - wall.light(x, y) * wall.surface(x, y).colour.g);
            squares += d * d;
        }
    }
    return std::sqrt(squares / (kSide * kSide));
}

float even(int /*x*/, int /*y*/) {
    return 1.0F;
}

TEST(DiscontinuityFilter, TakesNoiseFromEvenSurfaces) {
    const Wall wall{plain, even};
    for (const int count : {1, 2, 8}) {
        const Accumulation samples = samples_of(wall, count);
        EXPECT_LT(rms_error(filtered_mean(samples), wall), 0.1 * rms_error(samples.mean(), wall)) << count;
    }
}

TEST(DiscontinuityFilter, KeepsEdgesOfPlacesNormalsAndColours) {
    const auto right = [](int x) { return x >= kSide / 2; };
    const auto light = [&](int x, int /*y*/) { return right(x) ? 1.0F : 0.6F; };
    const auto surface = [&](const std::function<void(Guide&)>& change) {
        return [=](int x, int y) {
            Guide guide = plain(x, y);
            if (right(x)) change(guide);
            return guide;
        };
    };
    for (const auto& change : std::vector<std::function<void(Guide&)>>{
             [](Guide& guide) { guide.position.z = 0.7F; },
             [](Guide& guide) {
                 guide.normal = {0.8F, 0, 0.6F};
             },
             [](Guide& guide) {
                 guide.colour = {0.9F, 0.2F, 0.1F};
             },
         }) {
        const Wall wall{surface(change), light};
        const Accumulation samples = samples_of(wall, 2);
        EXPECT_LT(rms_error(filtered_mean(samples), wall), 0.15 * rms_error(samples.mean(), wall));
    }
}

TEST(DiscontinuityFilter, KeepsTexturesAndShadowsWithoutNoise) {
    const Wall wall{[](int x, int y) {
                        Guide guide = plain(x, y);
                        guide.colour *= (x / 3 + y / 3) % 2 == 0 ? 1.0F : 0.9F;
                        return guide;
                    },
                    [](int x, int y) { return x + 2 * y > kSide ? 1.0F : 0.8F; }, false};
    EXPECT_LT(rms_error(filtered_mean(samples_of(wall, 4)), wall), 1e-5);
}

TEST(DiscontinuityFilter, GoesToTheMeanAsSamplesAreAdded) {
    const Wall wall{plain, [](int x, int /*y*/) { return x % 9 == 0 ? 1.3F : 1.0F; }};
    double before = 1;
    for (const int count : {4, 64, 1024}) {
        const double error = rms_error(filtered_mean(samples_of(wall, count)), wall);
        EXPECT_LT(error, count == 1024 ? 0.5 * before : before) << count;
        before = error;
    }
    // Pattern of interleaved groups of virtual lights.
    const Wall pattern{plain, [](int x, int y) { return x % 4 == 1 && y % 4 == 2 ? 1.3F : 1.0F; }, false};
    EXPECT_LT(rms_error(filtered_mean(samples_of(pattern, 4)), pattern), 1e-5);
}

TEST(DiscontinuityFilter, LeavesWhatHasNoSurfaceAndImagesWithoutGuides) {
    Accumulation samples = samples_of({plain, even}, 3);
    for (int x = 20; x < 40; ++x) {
        samples.guides(x, 50) = {};
        samples.sum(x, 50) = {30, 60, 90, 3};
    }
    const Image<RgbaF> filtered = filtered_mean(samples), mean = samples.mean();
    for (int x = 20; x < 40; ++x) ASSERT_EQ(filtered(x, 50), mean(x, 50));
    EXPECT_NEAR(filtered(30, 49).g, 0.5F, 0.05F);
    samples.guides = {};
    const Image<RgbaF> unguided = filtered_mean(samples);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) ASSERT_EQ(unguided(x, y), mean(x, y));
    }
}

TEST(DiscontinuityFilter, TakesImagesOfAnySizeAndSamplesThatAreNoNumbers) {
    const Accumulation all = samples_of({plain, even}, 3);
    const Image<RgbaF> narrow = filtered_mean(all.crop({20, 30, 27, 31}));
    EXPECT_EQ(narrow.width(), 7);
    EXPECT_EQ(narrow.height(), 1);
    for (const RgbaF& p : narrow.pixels()) EXPECT_NEAR(p.g, 0.5F, 0.35F);
    Accumulation broken = all;
    broken.sum(40, 40).g = std::nanf("");
    broken.guides(40, 40).squares = std::nanf("");
    const Image<RgbaF> filtered = filtered_mean(broken);
    EXPECT_TRUE(std::isnan(filtered(40, 40).g));
    for (int x = 30; x < 50; ++x) EXPECT_NEAR(filtered(x, 41).g, 0.5F, 0.1F);
    // A part has the same result as in the whole image.
    const Image<RgbaF> whole = filtered_mean(all), part = filtered_mean(all, {60, 50, 90, 200});
    for (int y = 50; y < kSide; ++y) {
        for (int x = 60; x < 90; ++x) ASSERT_EQ(whole(x, y), part(x, y));
    }
}

TEST(DiscontinuityFilter, LooksNoFartherThanItSaysAndNeedsNoThreads) {
    const Accumulation samples = samples_of({plain, even}, 2);
    Accumulation changed = samples;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < 10; ++x) {
            changed.sum(x, y).g *= 7;
            changed.guides(x, y).squares *= 20;
        }
    }
    const Image<RgbaF> of_all = filtered_mean(samples);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Image<RgbaF> of_changed = filtered_mean(changed);
    EXPECT_NE(of_all(10, 40), of_changed(10, 40));
    for (int y = 0; y < kSide; ++y) {
        for (int x = 10 + kFilterRadius_px; x < kSide; ++x) ASSERT_EQ(of_all(x, y), of_changed(x, y)) << x << " " << y;
    }
}

// Large images are filtered in strips without seams: each part is bit-identical to filtering it separately.
TEST(DiscontinuityFilter, TakesLargeImagesAStripAtATime) {
    constexpr int kWidth = 1200, kHeight = 1000;
    rs::test::Random random(9);
    Accumulation large;
    large.sum = Image<RgbaF>(kWidth, kHeight);
    large.guides = Image<GuideSum>(kWidth, kHeight);
    large.samples = 1;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            large.add(x, y, {glm::vec3(static_cast<float>(random.real(0, 1))), true, true, plain(x, y)});
        }
    }
    const Image<RgbaF> whole = filtered_mean(large);
    for (const PixelRectangle& part : {PixelRectangle{300, 840, 420, 920}, PixelRectangle{1100, 0, 1200, 1000}}) {
        const Image<RgbaF> alone = filtered_mean(large, part);
        for (int y = part.y0; y < part.y1; ++y) {
            for (int x = part.x0; x < part.x1; ++x) ASSERT_EQ(alone(x, y), whole(x, y)) << x << " " << y;
        }
    }
}

}  // namespace
}  // namespace rs::capture::test
