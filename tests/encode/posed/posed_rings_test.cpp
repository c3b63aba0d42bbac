// Rings planned for posed photos, and the whole way from posed photos to views of an object.

#include "encode/posed/posed_rings.hpp"
#include "encode/evaluation/evaluation.hpp"
#include "encode/set/set_checks.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/encode/posed/posed_ball.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>

namespace rs::encode {
namespace {

using testing::HasSubstr;

constexpr SignedVolume::Bounds kBall = {glm::dvec3(-kBallRadius), glm::dvec3(kBallRadius), kBallRadius};

TEST(RingPlan, UprightCamerasContainTheObjectAtTheDensityOfThePhotos) {
    const std::vector<PosedPhoto> photos = photos_of_ball(60, 100);
    const Result<RingPlan> plan = plan_rings(photos, kBall, {});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_NEAR(plan->highest_deg, 75, 4);
    EXPECT_EQ(find_rings(plan->rig).size(), static_cast<std::size_t>(plan->rings));
    const double photo_px = photos[0].camera.fl_x / 3.5;  // per unit at the axis
    for (const RigView& view : plan->rig.views) {
        EXPECT_TRUE(is_upright(view.camera));
        const glm::dvec3 top = view.camera.project({0, kBallRadius, 0});
        const glm::dvec3 side = view.camera.project(kBallRadius * view.camera.right());
        EXPECT_NEAR(side.x - view.camera.project({0, 0, 0}).x, photo_px * kBallRadius, 1e-6);
        for (const glm::dvec3& seen : {top, side}) {
            EXPECT_TRUE(seen.x > 0 && seen.y > 0 && seen.x < view.camera.width && seen.y < view.camera.height);
        }
    }
}

TEST(RingPlan, ViewsThatTakeTooMuchMemoryAreRefused) {
    const std::vector<PosedPhoto> photos = photos_of_ball(20, 100);
    const Result<RingPlan> plan = plan_rings(photos, kBall, {.memory_bytes = 1 << 20});
    ASSERT_FALSE(plan.ok());
    EXPECT_THAT(plan.error().message, HasSubstr("make the photos smaller"));
}

TEST(PosedRings, SetsOfRingsAreNotPosed) {
    Rig rig = test::drawn_ring(20, 10);
    EXPECT_FALSE(is_posed(rig));
    rig.extras[kPosedKey] = true;
    EXPECT_TRUE(is_posed(rig));
    Rig spread;
    for (int n = 0; n < 60; ++n) spread.views.push_back({"", "", posed_camera(n, 60, 100), {}});
    EXPECT_TRUE(is_posed(spread));
}

TEST(PosedRings, HeldOutPhotosAreRenderedByTheEngine) {
    const test::TemporaryFolder folder;
    constexpr int kPhotos = 60;
    Rig rig;
    rig.extras[kPosedKey] = true;
    for (int n = 0; n < kPhotos; ++n) {
        RigView view;
        view.camera = posed_camera(n, kPhotos, 64, 30);  // few rings, for the time
        view.file_path = std::to_string(n) + ".png";
        ASSERT_TRUE(write_png(folder / view.file_path, mottled_ball(view.camera)).ok());
        rig.views.push_back(std::move(view));
    }
    ASSERT_TRUE(write_rig(folder / kRigFileName, rig).ok());
    const Result<CaptureSet> set = open_capture_set(folder.path());
    ASSERT_TRUE(set.ok()) << set.error().message;
    ASSERT_TRUE(set->posed);
    const Result<HoldOut> hold_out = choose_hold_out(set->upright, 10, "ball");
    ASSERT_TRUE(hold_out.ok()) << hold_out.error().message;
    const auto scores = evaluate(*set, *hold_out, {.methods = {Method::kPhoto, Method::kShape}});
    ASSERT_TRUE(scores.ok()) << scores.error().message;
    EXPECT_GT((*scores)[1].mean_psnr_db, 17);
    EXPECT_GT((*scores)[1].mean_psnr_db, (*scores)[0].mean_psnr_db + 5);
}

}  // namespace
}  // namespace rs::encode
