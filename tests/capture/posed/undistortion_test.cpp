#include "capture/posed/undistortion.hpp"

#include "tests/capture/posed/posed_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace rs::capture {
namespace {

using Model = LensDistortion::Model;

TurnSilhouette::Box box_of(const Image<Rgba8>& photo) {
    TurnSilhouette silhouette(photo.width(), photo.height());
    silhouette.add(photo);
    return silhouette.visible();
}

// Mean absolute differences from the photo of a pinhole camera with the same pose, codes.
struct Difference {
    double colour = 0;  // where both are opaque
    double alpha = 0;
};
Difference difference(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    Difference sum;
    double opaque = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const Rgba8 &p = a.pixels()[i], &q = b.pixels()[i];
        sum.alpha += std::abs(p.a - q.a);
        if (p.a < 255 || q.a < 255) continue;
        sum.colour += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
        opaque += 3;
    }
    return {sum.colour / opaque, sum.alpha / static_cast<double>(a.pixels().size())};
}

TEST(Undistortion, DistortedMaskIsTheMaskOfThePhoto) {
    for (const LensDistortion& lens : {LensDistortion{}, LensDistortion{Model::kRadialTangential, {-0.25, 0.08}},
                                       LensDistortion{Model::kFisheye, {0.05, -0.01, 0.002, -0.001}}}) {
        PosedCamera posed = test::posed_cameras(5, 320, 240)[3];
        const Image<Rgba8> pinhole = test::posed_photo(posed);
        cv::Mat1b mask(240, 320), truth(240, 320);
        posed.distortion = lens;
        const Image<Rgba8> photo = test::posed_photo(posed);
        for (int y = 0; y < 240; ++y) {
            for (int x = 0; x < 320; ++x) {
                mask(y, x) = pinhole(x, y).a >= 128 ? 255 : 0;
                truth(y, x) = photo(x, y).a >= 128 ? 255 : 0;
            }
        }
        const cv::Mat1b distorted = distorted_mask(posed, posed.camera, mask);
        EXPECT_LT(cv::countNonZero(distorted ^ truth), 0.012 * cv::countNonZero(truth));
        if (!lens.is_pinhole()) {
            EXPECT_GT(cv::countNonZero(mask ^ truth), 0.016 * cv::countNonZero(truth));
        }
    }
}

TEST(Undistortion, EqualsThePhotoOfAPinhole) {
    const LensDistortion lenses[] = {{Model::kRadialTangential, {-0.25, 0.08}},
                                     {Model::kRadialTangential, {0.15, -0.02, 0.01, -0.02, 0.01}},
                                     {Model::kRadialTangential, {0.3, 0.1, 0.004, 0.002, 0.02, 0.45, 0.12, 0.03}},
                                     {Model::kFisheye, {0.05, -0.01, 0.002, -0.001}}};
    for (const LensDistortion& lens : lenses) {
        PosedCamera posed = test::posed_cameras(5, 320, 240)[3];
        posed.distortion = lens;
        const Image<Rgba8> photo = test::posed_photo(posed);
        const auto camera = undistorted_camera(posed, box_of(photo), "photo");
        ASSERT_TRUE(camera.ok()) << camera.error().message;
        EXPECT_EQ(camera->fl_x, posed.camera.fl_x);
        EXPECT_EQ(camera->world_from_camera, posed.camera.world_from_camera);
        const Image<Rgba8> straight = undistorted(posed, *camera, photo);
        const Image<Rgba8> truth = test::posed_photo({"", "", *camera, {}});
        const Difference off = difference(straight, truth);
        EXPECT_LT(off.colour, 1.2) << lens.coefficients[0];
        EXPECT_LT(off.alpha, 0.6) << lens.coefficients[0];
        EXPECT_FALSE(straight == photo) << "the distortion is visible";
    }
}

TEST(Undistortion, KeepsPixelsOfAPinhole) {
    const PosedCamera posed = test::posed_cameras(5, 160, 120)[3];
    const Image<Rgba8> photo = test::posed_photo(posed);
    const auto camera = undistorted_camera(posed, box_of(photo), "photo");
    ASSERT_TRUE(camera.ok());
    EXPECT_TRUE(undistorted(posed, *camera, photo) == photo);
    EXPECT_EQ(camera->cx, posed.camera.cx);
}

TEST(Undistortion, ExtendsTheFrameToTheWholeObject) {
    PosedCamera posed = test::posed_cameras(5, 320, 240)[3];
    posed.distortion.coefficients = {-0.25, 0.08};
    const auto camera = undistorted_camera(posed, {0, 320, 0, 240}, "photo");
    ASSERT_TRUE(camera.ok()) << camera.error().message;
    EXPECT_GT(camera->width, 330);
    EXPECT_GT(camera->cx - posed.camera.cx, 5);
}

TEST(Undistortion, RefusesFoldedImages) {
    PosedCamera posed = test::posed_cameras(5, 320, 240)[3];
    posed.distortion.coefficients = {-3};
    const auto camera = undistorted_camera(posed, {0, 320, 0, 240}, "a.jpg");
    ASSERT_FALSE(camera.ok());
    EXPECT_THAT(camera.error().message, testing::HasSubstr("a.jpg: the lens distortion cannot be undone"));
}

}  // namespace
}  // namespace rs::capture
