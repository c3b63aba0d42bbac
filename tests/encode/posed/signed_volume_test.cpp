// Rays against the signed distances of a ball and a thin post beside it.

#include "encode/posed/signed_volume.hpp"
#include "tests/encode/posed/posed_ball.hpp"

#include <gtest/gtest.h>

namespace rs::encode {
namespace {

SignedVolume ball_and_post(int voxels) {
    SignedVolume volume(make_grid(glm::dvec3(-1.5), glm::dvec3(1.5), voxels));
    const VolumeGrid& grid = volume.grid();
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                const glm::dvec3 p = grid.centre(x, y, z);
                const double ball = glm::length(p) - 0.5;
                const double post = std::max(std::hypot(p.x - 1, p.z) - 0.1, std::abs(p.y) - 1);
                volume.row(y, z)[x] = std::clamp(static_cast<float>(std::min(ball, post) / grid.voxel),
                                                 -SignedVolume::kTruncation_voxels, SignedVolume::kTruncation_voxels);
            }
        }
    }
    volume.index_empty_blocks();
    return volume;
}

TEST(SignedVolume, DepthIsThatOfRaysThroughTheWholeGrid) {
    const SignedVolume volume = ball_and_post(90);
    for (const glm::dvec3& eye : {glm::dvec3(0.3, 0.2, 4), glm::dvec3(3, 2, -2), glm::dvec3(0.1, 5, 0.2)}) {
        const Camera camera = look_at_camera(eye, {0, 0, 0}, 0.7, 101, 83);
        const Image<float> depth = cast_depth(volume, camera);
        int hits = 0;
        for (int y = 0; y < depth.height(); ++y) {
            for (int x = 0; x < depth.width(); ++x) {
                const glm::dvec3 direction = camera.ray(x + 0.5, y + 0.5);
                const auto span = volume.clip(camera.centre(), direction);
                const auto t = span ? volume.intersect(camera.centre(), direction, *span) : std::nullopt;
                const auto here = static_cast<double>(depth(x, y));
                ASSERT_EQ(here > 0, t.has_value()) << x << ", " << y;
                if (!t) continue;
                ++hits;
                ASSERT_NEAR(here, *t, volume.grid().voxel) << x << ", " << y;
            }
        }
        EXPECT_GT(hits, 500);
        EXPECT_LT(hits, 4000);
    }
}

TEST(SignedVolume, DepthOfABall) {
    const SignedVolume volume = ball_and_post(90);
    const Camera camera = look_at_camera({0, 0, 4}, {0, 0, 0}, 0.7, 101, 101);
    EXPECT_NEAR(static_cast<double>(cast_depth(volume, camera)(50, 50)), 3.5, 0.1 * volume.grid().voxel);
    EXPECT_NEAR(volume.normal({0.3, 0, 0.4}).x, 0.6, 0.02);
}

TEST(SignedVolume, ACameraBesideASurfaceSeesIt) {
    const SignedVolume volume = ball_and_post(90);
    const Camera camera = look_at_camera({0, 0, 0.6}, {0, 0, 0}, 1.2, 33, 33);
    EXPECT_NEAR(static_cast<double>(cast_depth(volume, camera)(16, 16)), 0.1, 0.2 * volume.grid().voxel);
}

}  // namespace
}  // namespace rs::encode
