// The visual hull of photos from anywhere: a ball of known size, masks that lack parts, and sets that have no hull.

#include "encode/posed/hull_volume.hpp"
#include "tests/encode/posed/posed_ball.hpp"

#include <gmock/gmock.h>

namespace rs::encode {
namespace {

using testing::HasSubstr;

double top_of(const CarvedHull& hull) {
    const glm::dvec3 above(0, 2, 0);
    const glm::dvec3 down(0, -1, 0);
    const auto span = hull.volume.clip(above, down);
    const auto met = span ? hull.volume.intersect(above, down, *span) : std::nullopt;
    return met ? above.y - *met : -1;
}

TEST(HullVolume, ABallsSurfaceIsWithinAVoxel) {
    const std::vector<PosedPhoto> photos = photos_of_ball(40, 100);
    const Result<CarvedHull> hull = carve_hull(photos, {.longest_voxels = 64});
    ASSERT_TRUE(hull.ok()) << hull.error().message;
    EXPECT_EQ(hull->tolerance.tolerated, 0);
    const double voxel = hull->volume.grid().voxel;
    EXPECT_NEAR(top_of(*hull), kBallRadius, 1.5 * voxel);
    EXPECT_NEAR(hull->volume.bounds()->radius, kBallRadius, 2.5 * voxel);
    EXPECT_LT(hull->volume.sample({0.9 * kBallRadius, 0, 0}), 0);
    EXPECT_GT(hull->volume.sample({0, 0, 1.15 * kBallRadius}), 0);
}

TEST(HullVolume, AMaskThatLacksHalfOfTheObjectIsOutvoted) {
    std::vector<PosedPhoto> photos = photos_of_ball(60, 80);
    for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 40; ++x) photos[30].image(x, y) = {};
    }
    const Result<CarvedHull> hull = carve_hull(photos, {.longest_voxels = 48});
    ASSERT_TRUE(hull.ok()) << hull.error().message;
    EXPECT_GT(hull->tolerance.tolerated, 0);
    EXPECT_LT(hull->contradicted, 0.01);
}

TEST(HullVolume, SetsWithoutAHullAreRefusedWithTheRemedy) {
    const std::vector<PosedPhoto> few = photos_of_ball(kLeastPhotos - 1, 40);
    const Result<CarvedHull> too_few = carve_hull(few, {});
    ASSERT_FALSE(too_few.ok());
    EXPECT_THAT(too_few.error().message, HasSubstr("too few"));

    std::vector<PosedPhoto> apart = photos_of_ball(12, 40);
    for (std::size_t n = 0; n < apart.size(); ++n) {
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < 40; ++x) apart[n].image(x, y).a = x < 2 && y == static_cast<int>(3 * n) ? 255 : 0;
        }
    }
    const Result<CarvedHull> nothing = carve_hull(apart, {});
    ASSERT_FALSE(nothing.ok());
    EXPECT_THAT(nothing.error().message, HasSubstr("no common volume"));
}

}  // namespace
}  // namespace rs::encode
