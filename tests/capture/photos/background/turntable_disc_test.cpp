#include "capture/photos/background/turntable_disc.hpp"

#include "capture/photos/background/disc_bridging.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rs::capture {
namespace {

constexpr int kPictureWidth = 320;
constexpr int kPictureHeight = 256;
constexpr Rgba8 kTable{120, 96, 80, 255};
constexpr double kTilt_rad = 0.4;
constexpr double kRadius = 0.36;

// A camera of the focal length that the search assumes, at height 1 above the disc: where a pixel's ray meets it,
// measured from the axis.
glm::dvec2 on_table(int x, int y) {
    const double f_px = 1.4 * kPictureWidth;
    const glm::dvec3 up(0, -std::cos(kTilt_rad), -std::sin(kTilt_rad));
    const glm::dvec3 away(0, -std::sin(kTilt_rad), std::cos(kTilt_rad));
    const glm::dvec3 ray((x + 0.5 - 0.5 * kPictureWidth) / f_px, (y + 0.5 - 0.5 * kPictureHeight) / f_px, 1);
    const double reach = -1 / glm::dot(up, ray);
    constexpr double kAxis = 1.9;  // so far away on the table
    return {reach * ray.x, reach * glm::dot(away, ray) - kAxis};
}

Rgba8 disc_colour(double radius) {
    const bool ring = std::abs(radius - 0.25) < 0.012 || std::abs(radius - 0.12) < 0.012;
    return ring ? Rgba8{110, 120, 130, 255} : Rgba8{190, 195, 200, 255};
}

Image<Rgba8> draw(bool disc) {
    Image<Rgba8> plate(kPictureWidth, kPictureHeight, kTable);
    for (int y = 0; disc && y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x) {
            const double radius = glm::length(on_table(x, y));
            if (radius <= kRadius) plate(x, y) = disc_colour(radius);
        }
    }
    return plate;
}

// What a tall object that stands in the middle hides.
bool hides(int x, int y) {
    return std::abs(x - 160) < 45 && y < 166;
}

struct Scene {
    Image<Rgba8> plate;
    Image<std::uint8_t> known{kPictureWidth, kPictureHeight, 255};
    Image<std::uint8_t> object{kPictureWidth, kPictureHeight};
};

Scene scene(bool disc) {
    Scene result{draw(disc)};
    for (int y = 0; y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x) {
            if (!hides(x, y)) continue;
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

TEST(TurntableDisc, IsFoundBehindAnObjectThatHidesItsFarSide) {
    const Scene drawn = scene(true);
    const auto disc = find_turntable_disc(drawn.plate, drawn.known, drawn.object);
    ASSERT_TRUE(disc.has_value());
    EXPECT_NEAR(disc->tilt_rad, kTilt_rad, 0.03);
    EXPECT_NEAR(disc->roll_rad, 0, 0.02);
    EXPECT_NEAR(disc->centre_x, 0.5 * kPictureWidth, 1.5);
    const glm::dvec2 foot = on_table(160, static_cast<int>(disc->centre_y));
    EXPECT_LT(glm::length(foot), 0.03);
}

TEST(TurntableDisc, IsNotFoundOnAnEvenTableNorInALine) {
    Scene drawn = scene(false);
    EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, drawn.object).has_value());
    for (int y = 172; y < 175; ++y) {
        for (int x = 120; x < 200; ++x) drawn.plate(x, y) = {230, 230, 230, 255};
    }
    EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, drawn.object).has_value());
}

// As a circle through the foot of an object and what it stands on: a part of it goes over into the table.
TEST(TurntableDisc, IsNotFoundWhereAPartOfTheRimIsNoEdge) {
    for (const double from_rad : {-0.2, -0.9}) {
        Scene drawn = scene(true);
        for (int y = 0; y < kPictureHeight; ++y) {
            for (int x = 0; x < kPictureWidth; ++x) {
                const glm::dvec2 p = on_table(x, y);
                const double angle_rad = std::atan2(p.y, p.x);
                const bool runs_on = angle_rad > from_rad && angle_rad < from_rad + 1.1;
                const bool even = runs_on || glm::length(p) <= kRadius;  // no rings either
                if (even && !hides(x, y)) drawn.plate(x, y) = disc_colour(0);
            }
        }
        EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, drawn.object).has_value()) << from_rad;
    }
}

TEST(TurntableDisc, NothingIsFoundWithoutAnObjectOrWithoutAPlate) {
    const Scene drawn = scene(true);
    const Image<std::uint8_t> none(kPictureWidth, kPictureHeight);
    EXPECT_FALSE(find_turntable_disc(drawn.plate, drawn.known, none).has_value());
    EXPECT_FALSE(find_turntable_disc(drawn.plate, none, drawn.object).has_value());
}

TEST(TurntableDisc, GapsGetTheColoursOfTheirCircles) {
    Scene drawn = scene(true);
    const Image<Rgba8> truth = draw(true);
    const auto disc = find_turntable_disc(drawn.plate, drawn.known, drawn.object);
    ASSERT_TRUE(disc.has_value());
    Image<Rgba8> by_rows = drawn.plate;
    Image<std::uint8_t> known_by_rows = drawn.known;
    bridge_gaps(std::nullopt, by_rows, known_by_rows);
    bridge_gaps(disc, drawn.plate, drawn.known);
    int hidden = 0;
    int wrong = 0;
    int wrong_by_rows = 0;
    for (int y = 0; y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x) {
            if (!hides(x, y) || glm::length(on_table(x, y)) > kRadius) {
                if (!hides(x, y)) {
                    ASSERT_EQ(difference(drawn.plate(x, y), truth(x, y)), 0) << "what is known stays";
                }
                continue;
            }
            ++hidden;
            wrong += difference(drawn.plate(x, y), truth(x, y)) > 12 ? 1 : 0;
            wrong_by_rows += difference(by_rows(x, y), truth(x, y)) > 12 ? 1 : 0;
        }
    }
    ASSERT_GT(hidden, 2000);
    EXPECT_LT(wrong, hidden / 10);
    EXPECT_GT(wrong_by_rows, hidden / 4) << "rows alone would do";
    EXPECT_EQ(difference(drawn.plate(160, 20), kTable), 0) << "rows bridge what is around the disc";
}

TEST(TurntableDisc, AFootThatNeverMovesIsTheObjects) {
    Scene drawn = scene(true);
    const auto disc = find_turntable_disc(drawn.plate, drawn.known, drawn.object);
    ASSERT_TRUE(disc.has_value());
    // Below what moves, a white foot of radius 0.1 about the axis; outside of it the ring stays what it is.
    const auto in_foot = [](int x, int y) { return y >= 166 && glm::length(on_table(x, y)) < 0.1; };
    int foot_pixels = 0;
    for (int y = 0; y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x) {
            if (!in_foot(x, y)) continue;
            drawn.plate(x, y) = {250, 250, 245, 255};
            ++foot_pixels;
        }
    }
    ASSERT_GT(foot_pixels, 100);
    const Image<std::uint8_t> foot = still_foot(*disc, drawn.plate, drawn.known, drawn.object);
    int found = 0;
    int beside = 0;
    for (int y = 0; y < kPictureHeight; ++y) {
        for (int x = 0; x < kPictureWidth; ++x) {
            if (foot(x, y) == 0) continue;
            (in_foot(x, y) ? found : beside) += 1;
        }
    }
    EXPECT_GT(found, 0.85 * foot_pixels);
    EXPECT_LT(beside, 0.1 * foot_pixels);
}

}  // namespace
}  // namespace rs::capture
