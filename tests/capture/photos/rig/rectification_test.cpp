#include "capture/photos/rig/rectification.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/image/image_metrics.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

// Distorted, tilted, panned and rolled.
TurntableModel crooked_model() {
    TurntableModel model;
    model.lens = {480, 360, 620, 246.3, 171.8, -0.08, 0.03};
    model.pose = {radians(1.5), radians(18), radians(2)};
    for (int i = 0; i < 12; ++i) model.angles_rad.push_back(2 * kPi * i / 12 + (i % 3) * 0.01);
    return model;
}

// Smooth colours on the sphere of directions from the camera, fading out softly 0.2 beside the axis.
Rgba8 pattern(const glm::dvec3& ray) {
    const double x = ray.x / -ray.z;
    const double y = ray.y / -ray.z;
    const auto wave = [](double phase) { return static_cast<float>(0.5 + 0.35 * std::sin(phase)); };
    const double reach = std::hypot(x / 0.22, (y + 0.31) / 0.17);
    const double alpha = std::clamp(6 * (1 - reach), 0.0, 1.0);
    if (alpha == 0) return {};
    return {srgb8_from_linear(wave(40 * x + 9 * y)), srgb8_from_linear(wave(31 * y - 20 * x)),
            srgb8_from_linear(wave(60 * x * y + 25 * x)), static_cast<std::uint8_t>(std::lround(255 * alpha))};
}

Image<Rgba8> drawn(const Lens& lens, const CameraPose& pose) {
    Image<Rgba8> image(lens.width, lens.height);
    for (int y = 0; y < lens.height; ++y) {
        for (int x = 0; x < lens.width; ++x) {
            if (const auto ray = table_ray(lens, pose, {x + 0.5, y + 0.5})) image(x, y) = pattern(*ray);
        }
    }
    return image;
}

TurnSilhouette::Box visible_box(const Image<Rgba8>& image) {
    TurnSilhouette outline(image.width(), image.height());
    outline.add(image);
    return outline.visible();
}

Image<Rgba8> without_hidden_colours(Image<Rgba8> image) {
    for (Rgba8& pixel : image.pixels()) {
        if (pixel.a == 0) pixel = {};
    }
    return image;
}

double psnr_of_rectification(const TurntableModel& model) {
    const Image<Rgba8> photo = drawn(model.lens, model.pose);
    const auto box = visible_box(photo);
    EXPECT_FALSE(box.empty());
    EXPECT_GT(box.left, 0);
    EXPECT_GT(box.top, 0);
    EXPECT_LT(box.right, photo.width());
    EXPECT_LT(box.bottom, photo.height());
    const auto frame = plan_upright_frame(model, std::array{box});
    EXPECT_TRUE(frame.ok()) << frame.error().message;
    if (!frame) return 0;
    const Image<Rgba8> upright = without_hidden_colours(rectified(model, *frame, photo));
    return compare_images_psnr(upright, drawn(frame->lens, {})).psnr_db();
}

TEST(Rectification, EqualsTheImageOfAnUprightCamera) {
    const double psnr_db = psnr_of_rectification(crooked_model());
    EXPECT_GT(psnr_db, 45);
    RecordProperty("psnr_db", std::to_string(psnr_db));
    // The score is sensitive: half a degree of tilt is clearly worse.
    TurntableModel wrong = crooked_model();
    const Image<Rgba8> photo = drawn(wrong.lens, wrong.pose);
    wrong.pose.tilt_rad += radians(0.5);
    const auto frame = plan_upright_frame(wrong, std::array{visible_box(photo)});
    ASSERT_TRUE(frame.ok());
    const Image<Rgba8> upright = without_hidden_colours(rectified(wrong, *frame, photo));
    EXPECT_LT(compare_images_psnr(upright, drawn(frame->lens, {})).psnr_db(), 35);
}

TEST(Rectification, AMovedPhotographIsPutBack) {
    const TurntableModel model = crooked_model();
    const Image<Rgba8> photo = drawn(model.lens, model.pose);
    const auto frame = plan_upright_frame(model, std::array{visible_box(photo)});
    ASSERT_TRUE(frame.ok());
    const ImagePlacement place{{13, -8}, 0.9};
    Lens moved = model.lens;  // a shift is equivalent to another lens: exact without resampling
    const glm::dvec2 principal =
        place.seen({moved.cx, moved.cy}, glm::dvec2(model.lens.width, model.lens.height) / 2.0);
    moved.f_px *= place.scale;
    moved.cx = principal.x;
    moved.cy = principal.y;
    const Image<Rgba8> upright = without_hidden_colours(rectified(model, *frame, drawn(moved, model.pose), place));
    EXPECT_GT(compare_images_psnr(upright, drawn(frame->lens, {})).psnr_db(), 42);
    const Image<Rgba8> ignored = without_hidden_colours(rectified(model, *frame, drawn(moved, model.pose)));
    EXPECT_LT(compare_images_psnr(ignored, drawn(frame->lens, {})).psnr_db(), 30);
}

TEST(Rectification, AnAxisThatLiesSidewaysIsTurnedUpright) {
    for (const double roll_deg : {90.0, -90.0}) {
        TurntableModel model = crooked_model();
        model.lens.width = 360;
        model.lens.height = 480;
        model.lens.cx = 182;
        model.lens.cy = 233;
        model.pose.roll_rad = radians(roll_deg);
        EXPECT_GT(psnr_of_rectification(model), 45) << roll_deg;
    }
}

TEST(Rectification, TheFrameIsSmallAndHoldsTheBoxesOfAllViews) {
    const TurntableModel model = crooked_model();
    const std::array<TurnSilhouette::Box, 3> boxes = {{{100, 220, 60, 190}, {}, {180, 330, 120, 300}}};
    const auto frame = plan_upright_frame(model, boxes);
    ASSERT_TRUE(frame.ok()) << frame.error().message;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (const TurnSilhouette::Box& box : boxes) {
        for (int y = box.top; y <= box.bottom && !box.empty(); ++y) {
            for (int x = box.left; x <= box.right; ++x) {
                const auto ray = table_ray(model.lens, model.pose, {x, y});
                ASSERT_TRUE(ray.has_value());
                const auto p = project(frame->lens, {}, *ray + glm::dvec3(0, 0, 1));
                ASSERT_TRUE(p.has_value());
                low = glm::min(low, *p);
                high = glm::max(high, *p);
            }
        }
    }
    const glm::dvec2 size(frame->lens.width, frame->lens.height);
    for (const glm::dvec2 room : {low, size - high}) {
        EXPECT_GE(room.x, kUprightMargin_px - 0.01);
        EXPECT_GE(room.y, kUprightMargin_px - 0.01);
        EXPECT_LT(room.x, kUprightMargin_px + 1.01);
        EXPECT_LT(room.y, kUprightMargin_px + 1.01);
    }
}

TEST(Rectification, KeepsTheObjectsScale) {
    for (const double tilt_deg : {0.0, 18.0, 45.0}) {
        TurntableModel model = crooked_model();
        model.pose.tilt_rad = radians(tilt_deg);
        const TurnSilhouette::Box box{160, 320, 100, 260};
        const auto frame = plan_upright_frame(model, std::array{box});
        ASSERT_TRUE(frame.ok()) << frame.error().message;
        const auto upright = [&](const glm::dvec2& p) {
            return *project(frame->lens, {}, *table_ray(model.lens, model.pose, p) + glm::dvec3(0, 0, 1));
        };
        double least = 1e9;
        double most = 0;
        for (int i = 0; i < 180; ++i) {
            const glm::dvec2 step(0.5 * std::cos(radians(i)), 0.5 * std::sin(radians(i)));
            const glm::dvec2 middle(240, 180);
            const double scale = glm::length(upright(middle + step) - upright(middle - step));
            least = std::min(least, scale);
            most = std::max(most, scale);
        }
        EXPECT_GE(least, 0.9999) << tilt_deg;
        EXPECT_NEAR(least, frame->scale, 1e-3);
        EXPECT_LE(most, 1.5001) << tilt_deg;
    }
}

TEST(Rectification, RefusesWhatAnUprightCameraCannotSee) {
    TurntableModel model = crooked_model();
    model.pose.tilt_rad = radians(80);
    const TurnSilhouette::Box box{160, 320, 100, 260};
    const auto steep = plan_upright_frame(model, std::array{box});
    ASSERT_FALSE(steep.ok());
    EXPECT_NE(steep.error().message.find("steeply"), std::string::npos);
    const auto nothing = plan_upright_frame(crooked_model(), std::array{TurnSilhouette::Box{}});
    ASSERT_FALSE(nothing.ok());
    EXPECT_NE(nothing.error().message.find("no view shows the object"), std::string::npos);
}

TEST(Rectification, ContinuesColoursBeyondTheEdge) {
    const TurntableModel model = crooked_model();
    Image<Rgba8> photo(480, 360);
    for (int y = 120; y < 240; ++y) {
        for (int x = 180; x < 300; ++x) photo(x, y) = {200, 120, 40, 255};
    }
    const auto frame = plan_upright_frame(model, std::array{visible_box(photo)});
    ASSERT_TRUE(frame.ok());
    const Image<Rgba8> upright = rectified(model, *frame, photo);
    int hidden = 0;
    for (const Rgba8& pixel : upright.pixels()) {
        // No rim, neither dark nor bright: pixels of every coverage, also of alpha 0, have the object's colour.
        if (pixel.a > 0 || pixel.r > 0) {
            EXPECT_NEAR(pixel.r, 200, 1);
            EXPECT_NEAR(pixel.g, 120, 1);
            EXPECT_NEAR(pixel.b, 40, 1);
        }
        if (pixel.a == 0 && pixel.r > 0) ++hidden;
    }
    EXPECT_GT(hidden, 500);
}

// A soft spot at the point's projection; small, because perspective shifts the centroid of a wide one.
Image<Rgba8> spot(const TurntableModel& model, const glm::dvec2& p) {
    Image<Rgba8> photo(model.lens.width, model.lens.height);
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            const double d2 = (x + 0.5 - p.x) * (x + 0.5 - p.x) + (y + 0.5 - p.y) * (y + 0.5 - p.y);
            photo(x, y) = {90, 90, 90, static_cast<std::uint8_t>(std::lround(255 * std::exp(-d2 / (2 * 1.5 * 1.5))))};
        }
    }
    return photo;
}

glm::dvec2 centroid(const Image<Rgba8>& image) {
    glm::dvec3 sum(0);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x)
            sum += static_cast<double>(image(x, y).a) * glm::dvec3(x + 0.5, y + 0.5, 1);
    }
    return glm::dvec2(sum) / sum.z;
}

TEST(Rectification, TheRigSeesPointsWhereTheRectifiedImagesShowThem) {
    const TurntableModel model = crooked_model();
    const auto frame = plan_upright_frame(model, std::array{TurnSilhouette::Box{90, 390, 40, 320}});
    ASSERT_TRUE(frame.ok());
    const TurnSilhouette::Box visible{20, frame->lens.width - 30, 12, frame->lens.height - 40};
    const Rig rig = make_rig(model, *frame, visible);
    ASSERT_EQ(rig.views.size(), model.angles_rad.size());
    EXPECT_EQ(rig.object_radius, 1);
    const double distance = std::hypot(rig.views[0].camera.centre().x, rig.views[0].camera.centre().z);
    const double camera_height = rig.views[0].camera.centre().y;
    EXPECT_GT(camera_height, 0.2 * distance);  // the camera looks down
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        const Camera& camera = rig.views[i].camera;
        EXPECT_TRUE(is_upright(camera));
        EXPECT_EQ(camera.width, frame->lens.width);
        EXPECT_NEAR(glm::length(glm::cross(camera.forward(), glm::dvec3(camera.centre().x, 0, camera.centre().z))), 0,
                    1e-12);
        for (const glm::dvec3& p : {glm::dvec3(0.1, -0.25, 0.05), glm::dvec3(-0.08, -0.36, 0.1)}) {
            // In units of the camera's distance, in the distorted camera; in object radii in the rig.
            const auto seen = project(model.lens, model.pose, turned(p, model.angles_rad[i]));
            ASSERT_TRUE(seen.has_value());
            const glm::dvec2 shown = centroid(rectified(model, *frame, spot(model, *seen)));
            const glm::dvec3 expected = camera.project(p * distance + glm::dvec3(0, camera_height, 0));
            EXPECT_NEAR(shown.x, expected.x, 0.02) << i;
            EXPECT_NEAR(shown.y, expected.y, 0.02) << i;
        }
    }
}

TEST(Rectification, TheRigKnowsTheGround) {
    const TurntableModel model = crooked_model();
    const auto frame = plan_upright_frame(model, std::array{TurnSilhouette::Box{90, 390, 40, 320}});
    ASSERT_TRUE(frame.ok());
    const TurnSilhouette::Box visible{60, 300, 30, 250};
    EXPECT_EQ(make_rig(model, *frame, visible).foot_height, std::nullopt);
    const Rig rig = make_rig(model, *frame, visible, -0.37);
    // Intersection of the axis and the ground, in the photo's camera and in the rig's.
    const auto seen = project(Lens(frame->lens), {}, {0, -0.37, 0});
    ASSERT_TRUE(seen.has_value() && rig.foot_height.has_value());
    const glm::dvec3 ground(0, *rig.foot_height, 0);
    EXPECT_NEAR(rig.views[2].camera.project(ground).x, seen->x, 1e-9);
    EXPECT_NEAR(rig.views[2].camera.project(ground).y, seen->y, 1e-9);
}

TEST(Rectification, TheRigsUnitIsTheRadiusThatHoldsWhatIsSeen) {
    const TurntableModel model = crooked_model();
    const auto frame = plan_upright_frame(model, std::array{TurnSilhouette::Box{90, 390, 40, 320}});
    ASSERT_TRUE(frame.ok());
    const TurnSilhouette::Box visible{60, 300, 30, 250};
    const Rig rig = make_rig(model, *frame, visible);
    const Camera& camera = rig.views[3].camera;
    const double column = frame->lens.cx - visible.left > visible.right - frame->lens.cx ? visible.left : visible.right;
    const glm::dvec3 ray = camera.ray(column, 17);
    const glm::dvec2 flat = glm::normalize(glm::dvec2(ray.x, ray.z));
    const glm::dvec2 centre(camera.centre().x, camera.centre().z);
    EXPECT_NEAR(glm::length(centre - flat * glm::dot(flat, centre)), 1, 1e-12);
    EXPECT_NEAR(camera.project(glm::dvec3(0)).y, 140, 1e-9);
    EXPECT_NEAR(camera.project(glm::dvec3(0)).x, frame->lens.cx, 1e-9);
}

}  // namespace
}  // namespace rs::capture
