// Rings planned for posed photos, and the whole way from posed photos to views of an object.

#include "encode/posed/posed_rings.hpp"
#include "encode/build.hpp"
#include "encode/evaluation/evaluation.hpp"
#include "encode/set/set_checks.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/renderer.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "rayspace/geometry/ring_axes.hpp"
#include "rayspace/image/image_metrics.hpp"
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
    EXPECT_EQ(plan->highest_deg, 90);  // photos reach 80 degrees
    std::size_t views = 0;
    const double photo_px = photos[0].camera.fl_x / 3.5;  // per unit at the axis
    for (const ViewRing& ring : plan->rings) {
        views += ring.views.size();
        EXPECT_LE(std::abs(degrees(ring.elevation_rad)), 50.001);
        for (const int v : ring.views) {
            const Camera& camera = plan->rig.views[static_cast<std::size_t>(v)].camera;
            EXPECT_TRUE(is_upright(in_ring_axes(camera, ring.rotation)));
            const glm::dvec3 side = camera.project(kBallRadius * camera.right());
            EXPECT_NEAR(side.x - camera.project({0, 0, 0}).x, photo_px * kBallRadius, 1e-6);
            for (const glm::dvec3& seen : {camera.project({0, kBallRadius, 0}), side}) {
                EXPECT_TRUE(seen.x > 0 && seen.y > 0 && seen.x < camera.width && seen.y < camera.height);
            }
        }
    }
    EXPECT_EQ(views, plan->rig.views.size());
}

TEST(RingPlan, EveryDirectionAboveTheLowestPhotoIsNearAView) {
    const std::vector<PosedPhoto> photos = photos_of_ball(60, 100);
    const Result<RingPlan> plan = plan_rings(photos, kBall, {});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    for (int n = 0; n < 500; ++n) {
        const glm::dvec3 direction = glm::normalize(posed_camera(n, 500, 8, 90).centre());
        double nearest = -1;
        for (const RigView& view : plan->rig.views) {
            nearest = std::max(nearest, glm::dot(direction, glm::normalize(view.camera.centre())));
        }
        EXPECT_LT(degrees(std::acos(nearest)), 7.5) << glm::degrees(std::asin(direction.y));
    }
}

TEST(RingPlan, PhotosOfModerateElevationNeedNoCap) {
    std::vector<PosedPhoto> photos;
    for (int n = 0; n < 40; ++n) photos.push_back({"", posed_camera(n, 40, 64, 45), {}});
    const Result<RingPlan> plan = plan_rings(photos, kBall, {});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_TRUE(std::ranges::all_of(plan->rings, [](const ViewRing& r) { return r.rotation.is_identity(); }));
    EXPECT_EQ(find_rings(plan->rig).size(), plan->rings.size());
    EXPECT_DOUBLE_EQ(plan->rig.object_radius, kBallRadius);
}

TEST(RingPlan, TurnsKeepTheirCamerasAndRingsFillTheGaps) {
    std::vector<PosedPhoto> photos;
    for (const double elevation_deg : {0.0, 25.0, 60.0}) {
        for (int n = 0; n < 36; ++n) photos.push_back({"", turn_camera(n, 36, elevation_deg, 64), {}});
    }
    const Result<RingPlan> plan = plan_rings(photos, kBall, {});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    ASSERT_EQ(plan->photos.size(), plan->rig.views.size());
    std::vector<int> used(photos.size(), 0);
    for (std::size_t n = 0; n < plan->photos.size(); ++n) {
        if (plan->photos[n] < 0) continue;
        const auto photo = static_cast<std::size_t>(plan->photos[n]);
        ++used[photo];
        EXPECT_LT(glm::length(plan->rig.views[n].camera.centre() - photos[photo].camera.centre()), 1e-9);
    }
    EXPECT_EQ(std::count(used.begin(), used.begin() + 72, 1), 72);
    EXPECT_EQ(std::count(used.begin() + 72, used.end(), 0), 36);  // steep photos are resampled by their depth
    std::vector<double> elevations_deg;
    for (const ViewRing& ring : plan->rings) {
        if (ring.rotation.is_identity()) elevations_deg.push_back(degrees(ring.elevation_rad));
    }
    EXPECT_THAT(elevations_deg, testing::ElementsAre(testing::DoubleNear(0, 1e-6), testing::DoubleNear(25. / 3, 1e-6),
                                                     testing::DoubleNear(50. / 3, 1e-6), testing::DoubleNear(25, 1e-6),
                                                     testing::DoubleNear(33.75, 1e-6), testing::DoubleNear(42.5, 1e-6),
                                                     testing::DoubleNear(51.25, 1e-6), testing::DoubleNear(60, 1e-6)));
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
    for (const double apart_deg : {10, 20}) {
        Rig turns;
        for (const double elevation_deg : {5.0, 5 + apart_deg}) {
            for (int n = 0; n < 12; ++n) turns.views.push_back({"", "", turn_camera(n, 12, elevation_deg, 64), {}});
        }
        EXPECT_EQ(is_posed(turns), apart_deg > 15);
    }
}

TEST(PosedRings, PhotosOfTurnsAreUsedAsTheyAre) {
    const test::TemporaryFolder folder;
    Rig rig;
    for (const double elevation_deg : {0.0, 25.0}) {
        for (int n = 0; n < 36; ++n) {
            RigView view;
            view.camera = turn_camera(n, 36, elevation_deg, 64);
            view.file_path = std::to_string(rig.views.size()) + ".png";
            ASSERT_TRUE(write_png(folder / view.file_path, mottled_ball(view.camera)).ok());
            rig.views.push_back(std::move(view));
        }
    }
    ASSERT_TRUE(write_rig(folder / kRigFileName, rig).ok());
    Result<CaptureSet> set = open_capture_set(folder.path());
    ASSERT_TRUE(set.ok()) << set.error().message;
    const Result<CaptureSet> rings = with_rings(std::move(*set));
    ASSERT_TRUE(rings.ok()) << rings.error().message;
    int used = 0;
    for (std::size_t n = 0; n < rings->synthesized.size(); ++n) {
        if (rings->synthesized[n] != nullptr) continue;
        ++used;
        const Result<Image<Rgba8>> image = read_upright_image(*rings, static_cast<int>(n));
        ASSERT_TRUE(image.ok()) << image.error().message;
        EXPECT_GT(compare_images(mottled_ball(rings->upright.views[n].camera), *image).psnr_db(), 21);
    }
    EXPECT_EQ(used, 72);
    Result<BuiltObject> built = build_object(*rings, {});
    ASSERT_TRUE(built.ok()) << built.error().message;
    const auto renderer = engine::Renderer::create(std::move(built->object));
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    for (const double elevation_deg : {0.0, 12.0, 25.0}) {
        const Camera between = turn_camera(1, 72, elevation_deg, 64);
        const Result<engine::MixedView> view = engine::prepare_mixed_view(renderer->object(), between);
        ASSERT_TRUE(view.ok()) << view.error().message;
        Image<Rgba8> image(64, 64);
        renderer->render(*view, image);
        EXPECT_GT(compare_images(mottled_ball(between), image).psnr_db(), 17) << elevation_deg;
    }
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

TEST(PosedRings, TheBallIsSeenFromStraightAbove) {
    const test::TemporaryFolder folder;
    constexpr int kPhotos = 40;
    Rig rig;
    rig.extras[kPosedKey] = true;
    for (int n = 0; n < kPhotos; ++n) {
        RigView view;
        view.camera = posed_camera(n, kPhotos, 64);
        view.file_path = std::to_string(n) + ".png";
        ASSERT_TRUE(write_png(folder / view.file_path, mottled_ball(view.camera)).ok());
        rig.views.push_back(std::move(view));
    }
    ASSERT_TRUE(write_rig(folder / kRigFileName, rig).ok());
    Result<CaptureSet> set = open_capture_set(folder.path());
    ASSERT_TRUE(set.ok()) << set.error().message;
    PosedOptions options;
    options.rings.step_deg = 20;
    options.rings.views = 24;
    const Result<CaptureSet> rings = with_rings(std::move(*set), options);
    ASSERT_TRUE(rings.ok()) << rings.error().message;
    EXPECT_THAT(rings->warnings, testing::Contains(HasSubstr("within 2 degrees of a photo")));
    Result<BuiltObject> built = build_object(*rings, {});
    ASSERT_TRUE(built.ok()) << built.error().message;
    ASSERT_TRUE(validate_object(built->object, "ball").ok());
    const auto renderer = engine::Renderer::create(std::move(built->object));
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    const Camera above = look_at_camera({0, 3.5, 0}, {0, 0, 0}, 0.62, 64, 64);
    const Result<engine::MixedView> view = engine::prepare_mixed_view(renderer->object(), above);
    ASSERT_TRUE(view.ok()) << view.error().message;
    Image<Rgba8> image(64, 64);
    renderer->render(*view, image);
    EXPECT_GT(compare_images(mottled_ball(above), image).psnr_db(), 17);
}

}  // namespace
}  // namespace rs::encode
