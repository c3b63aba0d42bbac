#include "rayspace/image/premultiplied_sampling.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rs {
namespace {

TEST(PremultipliedImage, SamplesAreThoseOfThePlainFunction) {
    std::minstd_rand random(11);
    std::uniform_int_distribution<int> code(0, 255);
    const auto any = [&] { return static_cast<std::uint8_t>(code(random)); };
    // Opaque everywhere; except for a rim; between two slopes, with transparent rows below.
    for (const int bare : {0, 1, 2}) {
        Image<Rgba8> image(23, 17);
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                const bool is_rim = x < 5 || y < 3 || x > 18 || y > 12;
                const bool is_bare =
                    bare == 1 ? is_rim : bare == 2 && (x > 2 * y - 4 || x < 18 - 2 * y || (y > 9 && y < 15));
                const std::uint8_t alpha = any() < 100 ? 255 : any();
                image(x, y) = {any(), any(), any(), is_bare ? std::uint8_t{0} : alpha};
            }
        }
        const PremultipliedImage ready(image);
        std::uniform_real_distribution<double> across(-6, 29), down(-6, 23);
        for (int i = 0; i < 20'000; ++i) {
            const double x = across(random), y = down(random);
            ASSERT_EQ(ready.sample(x, y), sample_premultiplied(image, x, y)) << x << ", " << y;
        }
        EXPECT_EQ(ready.sample(1e9, -1e9), Rgba8{});
    }
}

TEST(SampleLinear, IsTheSameColourWithoutRounding) {
    std::minstd_rand random(12);
    std::uniform_int_distribution<int> code(0, 255);
    const auto any = [&] { return static_cast<std::uint8_t>(code(random)); };
    Image<Rgba8> image(15, 11);
    for (Rgba8& pixel : image.pixels()) pixel = {any(), any(), any(), any()};
    std::uniform_real_distribution<double> across(-3, 18), down(-3, 14);
    for (int i = 0; i < 5'000; ++i) {
        const double x = across(random), y = down(random);
        const Rgba8 code8 = sample_premultiplied(image, x, y);
        const RgbaF linear = sample_linear(image, x, y);
        ASSERT_NEAR(linear.a, code8.a / 255.0F, 0.6 / 255);
        ASSERT_TRUE(linear.r >= 0 && linear.g >= 0 && linear.b >= 0);
        if (code8.a == 0) continue;
        ASSERT_NEAR(srgb8_from_linear(linear.g / linear.a), code8.g, 1);
        ASSERT_LE(linear.r, linear.a * 1.0001F);
    }
}

TEST(PremultipliedImage, OfNothingIsNothing) {
    EXPECT_EQ(PremultipliedImage(Image<Rgba8>(4, 4)).sample(2, 2), Rgba8{});
    EXPECT_EQ(PremultipliedImage(Image<Rgba8>()).sample(0, 0), Rgba8{});
}

}  // namespace
}  // namespace rs
