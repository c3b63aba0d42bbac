#include "compositor/scene/light/environment_irradiance.hpp"

#include "capture/tracer/light/environment_map.hpp"
#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace rs::compositor {
namespace {

glm::vec3 map_direction(double azimuth, double polar) {
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

// A different lobe per channel.
EnvironmentLight smooth_sky(int width, float turn_rad) {
    Image<RgbaF> pixels(width, width / 2);
    for (int y = 0; y < pixels.height(); ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 d = map_direction(2 * kPi * (x + 0.5) / width - kPi, kPi * (y + 0.5) / pixels.height());
            pixels(x, y) = {std::exp(d.x + 0.3F * d.y), std::exp(d.y - 0.5F * d.z), 1 + d.x * d.z, 1};
        }
    }
    return {std::make_shared<const Image<RgbaF>>(std::move(pixels)), 0.5F, turn_rad, false};
}

TEST(IrradianceHarmonics, AgreeWithTheIntegralOfSmoothSkies) {
    for (const float turn_rad : {0.0F, 0.8F, -2.5F}) {
        const EnvironmentLight sky = smooth_sky(128, turn_rad);
        const capture::IrradianceMap exact(capture::EnvironmentMap({*sky.pixels, sky.scale, sky.turn_rad}));
        const IrradianceHarmonics harmonics = project_irradiance(sky);
        for (int row = 0; row <= 8; ++row) {
            for (int column = 0; column < 16; ++column) {
                const glm::vec3 n = map_direction(2 * kPi * column / 16, kPi * row / 8);
                const glm::vec3 expected = exact.at(n) / static_cast<float>(kPi);
                const glm::vec3 found = harmonics.at(n);
                for (int channel = 0; channel < 3; ++channel) {
                    EXPECT_NEAR(found[channel], expected[channel], 0.03F * expected[channel])
                        << turn_rad << " " << row << " " << column << " " << channel;
                }
            }
        }
    }
}

TEST(IrradianceHarmonics, OfAnEvenSkyAreItsRadiance) {
    const EnvironmentLight sky{std::make_shared<const Image<RgbaF>>(4, 2, RgbaF{1, 2, 4, 1}), 0.5F, 0.3F, false};
    const IrradianceHarmonics harmonics = project_irradiance(sky);
    for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(0.6F, 0, -0.8F)}) {
        EXPECT_LT(glm::distance(harmonics.at(n), glm::vec3(0.5F, 1, 2)), 1e-5F);
    }
}

TEST(IrradianceHarmonics, OfOneDirectionAreNotNegative) {
    Image<RgbaF> pixels(64, 32, RgbaF{0, 0, 0, 1});
    for (int x = 0; x < 64; ++x) pixels(x, 0) = {100, 100, 100, 1};
    const IrradianceHarmonics harmonics =
        project_irradiance({std::make_shared<const Image<RgbaF>>(std::move(pixels)), 1, 0, false});
    EXPECT_GT(harmonics.at({0, 1, 0}).r, 0.1F);
    EXPECT_EQ(harmonics.at(glm::normalize(glm::vec3(0.8F, -0.6F, 0))).r, 0);
}

TEST(EnvironmentIrradiance, FollowsMapScaleAndRotation) {
    EnvironmentIrradiance irradiance;
    EXPECT_FALSE(irradiance.of(std::nullopt));
    EnvironmentLight sky = smooth_sky(32, 0);
    for (int change = 0; change < 3; ++change) {
        if (change == 1) sky.scale = 3;
        if (change == 1) sky.turn_rad = 1;
        if (change == 2) sky.pixels = smooth_sky(16, 0).pixels;
        const auto found = irradiance.of(sky);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->factors, project_irradiance(sky).factors) << change;
    }
}

}  // namespace
}  // namespace rs::compositor
