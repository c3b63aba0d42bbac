// Depth of posed photos against a ball's, and its fusion with a hull that is too large.

#include "encode/posed/photo_depth.hpp"
#include "encode/posed/depth_fusion.hpp"
#include "encode/posed/hull_volume.hpp"
#include "rayspace/base/median.hpp"
#include "tests/encode/posed/posed_ball.hpp"

#include <gtest/gtest.h>

namespace rs::encode {
namespace {

// Axial depth of the ball at a pixel; 0 where the ray misses it.
double ball_at(const Camera& camera, int x, int y) {
    const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
    const double half_b = glm::dot(ray, camera.centre());
    const double c = glm::dot(camera.centre(), camera.centre()) - kBallRadius * kBallRadius;
    const double a = glm::dot(ray, ray);
    const double inside = half_b * half_b - a * c;
    return inside < 0 ? 0 : (-half_b - std::sqrt(inside)) / a;
}

// A ball of `radius` as signed distances.
SignedVolume ball_volume(double radius, int voxels) {
    SignedVolume volume(make_grid(glm::dvec3(-1.2), glm::dvec3(1.2), voxels));
    const VolumeGrid& grid = volume.grid();
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                const double distance = (glm::length(grid.centre(x, y, z)) - radius) / grid.voxel;
                volume.row(y, z)[x] = std::clamp(static_cast<float>(distance), -SignedVolume::kTruncation_voxels,
                                                 SignedVolume::kTruncation_voxels);
            }
        }
    }
    volume.index_empty_blocks();
    return volume;
}

TEST(PhotoDepth, ABallWithinAHullThatIsTooLarge) {
    const std::vector<PosedPhoto> photos = photos_of_ball(40, 120);
    const SignedVolume hull = ball_volume(1.05, 80);
    const Result<std::vector<PhotoDepth>> depths = estimate_photo_depths(photos, hull, {});
    ASSERT_TRUE(depths.ok()) << depths.error().message;
    std::vector<double> errors;
    std::size_t object = 0;
    for (const PhotoDepth& map : *depths) {
        for (int y = 0; y < map.depth.height(); ++y) {
            for (int x = 0; x < map.depth.width(); ++x) {
                const double truth = ball_at(map.camera, x, y);
                if (truth > 0) ++object;
                if (truth > 0 && map.depth(x, y) > 0) {
                    errors.push_back(std::abs(static_cast<double>(map.depth(x, y)) - truth));
                }
            }
        }
    }
    EXPECT_GT(static_cast<double>(errors.size()), 0.7 * static_cast<double>(object));
    EXPECT_LT(median(errors), 0.015);  // the hull is 0.25 away

    const SignedVolume fused = fuse_depths(hull, *depths);
    const Image<float> cast = cast_depth(fused, photos[20].camera);
    const int middle = 60;
    EXPECT_NEAR(static_cast<double>(cast(middle, middle)), ball_at(photos[20].camera, middle, middle), 0.02);
}

TEST(PhotoDepth, ManyPhotosGiveMapsOfThoseSpreadMostEvenly) {
    std::vector<PosedPhoto> photos = photos_of_ball(40, 120);
    const std::vector<PosedPhoto> others = photos;
    // Photos from almost the same directions add no maps.
    for (const PosedPhoto& photo : others) {
        photos.push_back(photo);
        photos.back().camera.world_from_camera[3] += glm::dvec4(1e-4, 0, 0, 0);
    }
    const SignedVolume hull = ball_volume(1.05, 80);
    const Result<std::vector<PhotoDepth>> depths = estimate_photo_depths(photos, hull, {.most_maps = 40});
    ASSERT_TRUE(depths.ok()) << depths.error().message;
    ASSERT_EQ(depths->size(), 40U);
    for (std::size_t i = 0; i < depths->size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_GT(glm::distance((*depths)[i].camera.centre(), (*depths)[j].camera.centre()), 0.01);
        }
    }
    const Image<float> cast = cast_depth(fuse_depths(hull, *depths), photos[20].camera);
    EXPECT_NEAR(static_cast<double>(cast(60, 60)), ball_at(photos[20].camera, 60, 60), 0.02);
}

TEST(DepthFusion, WhatNoPhotoShowsStaysSolid) {
    const SignedVolume hull = ball_volume(0.8, 60);
    const SignedVolume fused = fuse_depths(hull, {});
    EXPECT_LT(fused.sample({0, 0, 0.7}), 0);
    EXPECT_GT(fused.sample({0, 0, 0.9}), 0);
}

}  // namespace
}  // namespace rs::encode
