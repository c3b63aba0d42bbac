#include "capture/photos/background/turntable_disc.hpp"

#include "capture/photos/background/disc_inpainting.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rs::capture {
namespace {

constexpr int kImageWidth = 320;
constexpr int kImageHeight = 256;
constexpr Rgba8 kTable{120, 96, 80, 255};
constexpr double kTilt_rad = 0.4;
constexpr double kRadius = 0.36;
constexpr BackgroundParameters kDiscTestParameters{};

// Point of the disc's plane that a pixel shows, relative to the axis, for a camera of the nominal focal length at
// height 1 above it.
glm::dvec2 on_table(int x, int y) {
    const double f_px = 1.4 * kImageWidth;
    const glm::dvec3 up(0, -std::cos(kTilt_rad), -std::sin(kTilt_rad));
    const glm::dvec3 away(0, -std::sin(kTilt_rad), std::cos(kTilt_rad));
    const glm::dvec3 ray((x + 0.5 - 0.5 * kImageWidth) / f_px, (y + 0.5 - 0.5 * kImageHeight) / f_px, 1);
    const double reach = -1 / glm::dot(up, ray);
    constexpr double kAxis = 1.9;  // distance on the table
    return {reach * ray.x, reach * glm::dot(away, ray) - kAxis};
}

Rgba8 disc_colour(double radius) {
    const bool ring = std::abs(radius - 0.25) < 0.012 || std::abs(radius - 0.12) < 0.012;
    return ring ? Rgba8{110, 120, 130, 255} : Rgba8{190, 195, 200, 255};
}

Image<Rgba8> draw(bool disc) {
    Image<Rgba8> plate(kImageWidth, kImageHeight, kTable);
    for (int y = 0; disc && y < kImageHeight; ++y) {
        for (int x = 0; x < kImageWidth; ++x) {
            const double radius = glm::length(on_table(x, y));
            if (radius <= kRadius) plate(x, y) = disc_colour(radius);
        }
    }
    return plate;
}

// Silhouette of a tall object in the middle.
bool is_covered(int x, int y) {
    return std::abs(x - 160) < 45 && y < 166;
}

struct Scene {
    Image<Rgba8> plate;
    Image<std::uint8_t> known{kImageWidth, kImageHeight, 255};
    Image<std::uint8_t> object{kImageWidth, kImageHeight};
};

Scene scene(bool disc) {
    Scene result{draw(disc)};
    for (int y = 0; y < kImageHeight; ++y) {
        for (int x = 0; x < kImageWidth; ++x) {
            if (!is_covered(x, y)) continue;
            result.plate(x, y) = {0, 0, 0, 255};
            result.known(x, y) = 0;
            result.object(x, y) = 255;
        }
    }
    return result;
}

int difference(const Rgba8& a, const Rgba8& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

TEST(TurntableDisc, IsDetectedBehindAnObjectThatCoversItsFarSide) {
    const Scene drawn = scene(true);
    const auto disc = find_turntable_disc(drawn.plate, drawn.known, drawn.object, kDiscTestParameters.disc);
    ASSERT_TRUE(disc.has_value());
    EXPECT_NEAR(disc->tilt_rad, kTilt_rad, 0.03);
    EXPECT_NEAR(disc->roll_rad, 0, 0.02);
    EXPECT_NEAR(disc->centre_x, 0.5 * kImageWidth, 1.5);
    const glm::dvec2 foot = on_table(160, static_cast<int>(disc->centre_y));
    EXPECT_LT(glm::length(foot), 0.03);
}

TEST(TurntableDisc, IsNotDetectedOnAUniformTableOrInALine) {
    Scene drawn = scene(false);
    EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, drawn.object, kDiscTestParameters.disc).has_value());
    for (int y = 172; y < 175; ++y) {
        for (int x = 120; x < 200; ++x) drawn.plate(x, y) = {230, 230, 230, 255};
    }
    EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, drawn.object, kDiscTestParameters.disc).has_value());
}

// Like a circle through the foot of an object and its support: part of it has no edge to the table.
TEST(TurntableDisc, IsNotDetectedWherePartOfTheRimHasNoEdge) {
    for (const double from_rad : {-0.2, -0.9}) {
        Scene drawn = scene(true);
        for (int y = 0; y < kImageHeight; ++y) {
            for (int x = 0; x < kImageWidth; ++x) {
                const glm::dvec2 p = on_table(x, y);
                const double angle_rad = std::atan2(p.y, p.x);
                const bool runs_on = angle_rad > from_rad && angle_rad < from_rad + 1.1;
                const bool is_uniform = runs_on || glm::length(p) <= kRadius;  // no rings either
                if (is_uniform && !is_covered(x, y)) drawn.plate(x, y) = disc_colour(0);
            }
        }
        EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, drawn.object, kDiscTestParameters.disc).has_value())
            << from_rad;
    }
}

TEST(TurntableDisc, IsNotDetectedWithoutAnObjectOrAPlate) {
    const Scene drawn = scene(true);
    const Image<std::uint8_t> none(kImageWidth, kImageHeight);
    EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, none, kDiscTestParameters.disc).has_value());
    EXPECT_FALSE(find_turntable_disc(drawn.plate, none, drawn.object, kDiscTestParameters.disc).has_value());
}

TEST(DiscInpainting, FillsGapsAlongCircles) {
    Scene drawn = scene(true);
    const Image<Rgba8> truth = draw(true);
    const auto disc = find_turntable_disc(drawn.plate, drawn.known, drawn.object, kDiscTestParameters.disc);
    ASSERT_TRUE(disc.has_value());
    Image<Rgba8> by_rows = drawn.plate;
    Image<std::uint8_t> known_by_rows = drawn.known;
    inpaint_gaps(std::nullopt, by_rows, known_by_rows, kDiscTestParameters);
    inpaint_gaps(disc, drawn.plate, drawn.known, kDiscTestParameters);
    int covered = 0;
    int wrong = 0;
    int wrong_by_rows = 0;
    for (int y = 0; y < kImageHeight; ++y) {
        for (int x = 0; x < kImageWidth; ++x) {
            if (!is_covered(x, y) || glm::length(on_table(x, y)) > kRadius) {
                if (!is_covered(x, y)) {
                    ASSERT_EQ(difference(drawn.plate(x, y), truth(x, y)), 0) << "known pixels are unchanged";
                }
                continue;
            }
            ++covered;
            wrong += difference(drawn.plate(x, y), truth(x, y)) > 12 ? 1 : 0;
            wrong_by_rows += difference(by_rows(x, y), truth(x, y)) > 12 ? 1 : 0;
        }
    }
    ASSERT_GT(covered, 2000);
    EXPECT_LT(wrong, covered / 10);
    EXPECT_GT(wrong_by_rows, covered / 4) << "rows alone would suffice";
    EXPECT_EQ(difference(drawn.plate(160, 20), kTable), 0) << "rows fill the surroundings of the disc";
}

TEST(DiscInpainting, AssignsAStaticFootToTheObject) {
    Scene drawn = scene(true);
    const auto disc = find_turntable_disc(drawn.plate, drawn.known, drawn.object, kDiscTestParameters.disc);
    ASSERT_TRUE(disc.has_value());
    // A white foot of radius 0.1 about the axis below the moving rows; the ring outside of it is not part of it.
    const auto in_foot = [](int x, int y) { return y >= 166 && glm::length(on_table(x, y)) < 0.1; };
    int foot_pixels = 0;
    for (int y = 0; y < kImageHeight; ++y) {
        for (int x = 0; x < kImageWidth; ++x) {
            if (!in_foot(x, y)) continue;
            drawn.plate(x, y) = {250, 250, 245, 255};
            ++foot_pixels;
        }
    }
    ASSERT_GT(foot_pixels, 100);
    const Image<std::uint8_t> foot = static_foot(*disc, drawn.plate, drawn.known, drawn.object, kDiscTestParameters);
    int found = 0;
    int beside = 0;
    for (int y = 0; y < kImageHeight; ++y) {
        for (int x = 0; x < kImageWidth; ++x) {
            if (foot(x, y) == 0) continue;
            (in_foot(x, y) ? found : beside) += 1;
        }
    }
    EXPECT_GT(found, 0.85 * foot_pixels);
    EXPECT_LT(beside, 0.1 * foot_pixels);
}

}  // namespace
}  // namespace rs::capture
