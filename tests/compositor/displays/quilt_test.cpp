#include "compositor/displays/quilt.hpp"

#include "compositor/displays/stereo_image.hpp"
#include "rayspace/base/conventions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;

constexpr Rgba8 kA{10, 20, 30, 255};
constexpr Rgba8 kB{110, 120, 130, 255};

TEST(Quilt, ViewsShareThePlaneOfFocus) {
    const Camera middle = look_at_camera({1, 2, 7}, {0, 1, 0}, 0.6, 420, 560);
    const QuiltLayout layout{5, 9, 420, 560};
    const double focus = 5.5;
    const std::vector<Camera> cameras = quilt_cameras(middle, layout, radians(40), focus);
    ASSERT_EQ(cameras.size(), 45U);
    EXPECT_LT(glm::distance(cameras[22].centre(), middle.centre()), 1e-12);
    EXPECT_DOUBLE_EQ(cameras[22].cx, middle.cx);
    for (const glm::dvec2 at : {glm::dvec2(0, 0), {420, 560}, {100, 300}}) {
        const glm::dvec3 in_focus = middle.centre() + focus * middle.ray(at.x, at.y);
        const glm::dvec3 behind = middle.centre() + 2 * focus * middle.ray(at.x, at.y);
        double before = -1e9;
        for (const Camera& camera : cameras) {
            EXPECT_NEAR(camera.project(in_focus).x, at.x, 1e-9);
            EXPECT_NEAR(camera.project(in_focus).y, at.y, 1e-9);
            // Points behind the focal plane move with the eye, to the right.
            EXPECT_GT(camera.project(behind).x, before);
            before = camera.project(behind).x;
        }
    }
    // The cone is the angle between the outermost eyes as seen from the focal point.
    const glm::dvec3 target = middle.centre() + focus * middle.forward();
    const glm::dvec3 to_first = glm::normalize(cameras.front().centre() - target);
    const glm::dvec3 to_last = glm::normalize(cameras.back().centre() - target);
    EXPECT_NEAR(std::acos(glm::dot(to_first, to_last)), radians(40), 1e-12);
    EXPECT_LT(glm::dot(cameras.front().centre() - middle.centre(), middle.right()), 0);
}

TEST(Quilt, TheFirstViewIsAtTheLowerLeft) {
    const QuiltLayout layout{3, 2, 2, 1};
    Image<Rgba8> quilt(layout.width(), layout.height());
    for (int view = 0; view < 6; ++view) {
        place_tile(layout, view, Image<Rgba8>(2, 1, {static_cast<std::uint8_t>(view + 1), 0, 0, 255}), quilt);
    }
    const auto tile = [&](int column, int row) { return int{quilt(2 * column, row).r}; };
    EXPECT_EQ(tile(0, 1), 1);
    EXPECT_EQ(tile(2, 1), 3);
    EXPECT_EQ(tile(0, 0), 4);
    EXPECT_EQ(tile(2, 0), 6);
}

TEST(Quilt, TheNameTellsTheLayout) {
    EXPECT_EQ(quilt_path("a/shop.png", {5, 9, 420, 560}), "a/shop_qs5x9a0.75.png");
    EXPECT_EQ(quilt_path("a/shop_qs5x9a0.75.png", {5, 9, 420, 560}), "a/shop_qs5x9a0.75.png");
    EXPECT_EQ(quilt_path("shop.png", {8, 6, 640, 360}), "shop_qs8x6a1.778.png");
}

TEST(Quilt, LayoutsThatMakeNoImageAreRefused) {
    EXPECT_TRUE(parse_quilt("5x9", 420, 560, "--quilt").ok());
    for (const char* wrong : {"", "5", "5x", "x9", "0x9", "-1x9", "5x9x", "5x9 ", "1x1", "20x9", "99999999999x1"}) {
        const auto layout = parse_quilt(wrong, 420, 560, "--quilt");
        ASSERT_FALSE(layout.ok()) << wrong;
        EXPECT_THAT(layout.error().message, HasSubstr("--quilt"));
    }
}

TEST(Stereo, ImagesOfBothEyesAreOne) {
    const Image<Rgba8> left(2, 1, kA), right(2, 1, kB);
    const Image<Rgba8> beside = stereo_image(StereoForm::kSideBySide, left, right);
    ASSERT_EQ(beside.width(), 4);
    EXPECT_EQ(beside(1, 0), kA);
    EXPECT_EQ(beside(2, 0), kB);
    const Image<Rgba8> above = stereo_image(StereoForm::kTopBottom, left, right);
    ASSERT_EQ(above.height(), 2);
    EXPECT_EQ(above(1, 0), kA);
    EXPECT_EQ(above(1, 1), kB);
    EXPECT_EQ(stereo_image(StereoForm::kAnaglyph, left, right)(0, 0), (Rgba8{10, 120, 130, 255}));
}

}  // namespace
}  // namespace rs::compositor
