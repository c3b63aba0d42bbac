// Synthesized views of a mottled ball against drawn ones.

#include "encode/posed/view_synthesis.hpp"
#include "encode/posed/hull_volume.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "tests/encode/posed/posed_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::encode {
namespace {

// Signed distance of a box from its half sides, positive outside.
double box_distance(const glm::dvec3& p, const glm::dvec3& half) {
    const glm::dvec3 outside = glm::abs(p) - half;
    return glm::length(glm::max(outside, 0.0)) + std::min(std::max({outside.x, outside.y, outside.z}), 0.0);
}

// A post that stands on a plate.
SignedVolume post_on_plate() {
    SignedVolume volume(make_grid(glm::dvec3(-0.7), glm::dvec3(0.7), 64));
    const VolumeGrid& grid = volume.grid();
    for (int z = 0; z < grid.size.z; ++z) {
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                const glm::dvec3 p = grid.centre(x, y, z);
                const double plate = box_distance(p - glm::dvec3(0, -0.45, 0), {0.5, 0.05, 0.5});
                const double post = box_distance(p, {0.15, 0.5, 0.15});
                const auto voxels = static_cast<float>(std::min(plate, post) / grid.voxel);
                volume.row(y, z)[x] =
                    std::clamp(voxels, -SignedVolume::kTruncation_voxels, SignedVolume::kTruncation_voxels);
            }
        }
    }
    volume.index_empty_blocks();
    return volume;
}

TEST(ViewSynthesis, APointIsColoredByTheOnlyPhotoThatShowsIt) {
    const auto photo_at = [](double azimuth_deg, double elevation_deg) {
        const double azimuth = radians(azimuth_deg), elevation = radians(elevation_deg);
        const glm::dvec3 direction(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                   std::cos(elevation) * std::cos(azimuth));
        return PosedPhoto{"", look_at_camera(3.5 * direction, {0, 0, 0}, 0.62, 120, 120),
                          Image<Rgba8>(120, 120, Rgba8{200, 100, 50, 255})};
    };
    // Most photos are from the right, and the post hides the plate left of it from them.
    std::vector<PosedPhoto> photos;
    for (int n = 0; n < 20; ++n) photos.push_back(photo_at(80 + n, 50));
    photos.push_back(photo_at(-90, 40));
    const SignedVolume volume = post_on_plate();
    const ViewSynthesizer synthesizer(photos, volume, {});
    const Camera above = look_at_camera({0, 3.5, 0.001}, {0, 0, 0}, 0.62, 120, 120);
    const SynthesizedView view = synthesizer.synthesize(above);
    const glm::dvec3 seen = above.project({-0.3, -0.4, 0});
    const Rgba8& pixel = view.image(static_cast<int>(seen.x), static_cast<int>(seen.y));
    EXPECT_EQ(pixel.a, 255);
    EXPECT_NEAR(pixel.r, 200, 2);
}

TEST(ViewSynthesis, AViewBetweenPhotosResemblesTheBall) {
    const std::vector<PosedPhoto> photos = photos_of_ball(60, 120);
    const Result<CarvedHull> hull = carve_hull(photos, {.longest_voxels = 96});
    ASSERT_TRUE(hull.ok()) << hull.error().message;
    const ViewSynthesizer synthesizer(photos, hull->volume, {});
    const Camera between = look_at_camera({2, 1.7, 2.1}, {0, 0, 0}, 0.62, 120, 120);
    const SynthesizedView view = synthesizer.synthesize(between);
    // The ball is drawn without antialiasing, which costs several dB at its contour.
    EXPECT_GT(compare_images(mottled_ball(between), view.image).psnr_db(), 22);
    const double distance = glm::length(between.centre()) - kBallRadius;
    EXPECT_NEAR(static_cast<double>(view.depth(60, 60)), distance, 0.03);
    EXPECT_EQ(view.depth(1, 1), 0);

    // The camera of a photo gives its pixels.
    const SynthesizedView own = synthesizer.synthesize(photos[25].camera);
    EXPECT_GT(compare_images(photos[25].image, own.image).psnr_db(), 26);
}

}  // namespace
}  // namespace rs::encode
