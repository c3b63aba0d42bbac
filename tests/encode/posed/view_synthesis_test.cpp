// Synthesized views of a mottled ball against drawn ones.

#include "encode/posed/view_synthesis.hpp"
#include "encode/posed/hull_volume.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "tests/encode/posed/posed_ball.hpp"

#include <gtest/gtest.h>

namespace rs::encode {
namespace {

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
