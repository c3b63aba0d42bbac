#include "rayspace/output/view_output.hpp"

#include <gtest/gtest.h>

namespace rs {
namespace {

TEST(OutputKind, FollowsTheName) {
    EXPECT_EQ(*output_kind("a/view.png"), OutputKind::image);
    EXPECT_EQ(*output_kind("VIEW.PNG"), OutputKind::image);
    EXPECT_EQ(*output_kind("turn.mp4"), OutputKind::video);
    EXPECT_EQ(*output_kind("views"), OutputKind::folder);
    EXPECT_EQ(*output_kind("set.v2"), OutputKind::folder);
    EXPECT_NE(output_kind("view.JPG").error().message.find("view.JPG"), std::string::npos);
}

TEST(RigOfViews, NumbersItsImages) {
    const Rig rig = make_rig_of_views(std::vector<Camera>(12, look_at_camera({0, 0, 3}, {0, 0, 0}, 0.7, 8, 6)));
    ASSERT_EQ(rig.views.size(), 12U);
    EXPECT_EQ(rig.views[0].file_path, "0000.png");
    EXPECT_EQ(rig.views[11].file_path, "0011.png");
    EXPECT_EQ(rig.views[11].camera.width, 8);
}

TEST(Over, IsExactForOpaqueAndTransparentPixels) {
    EXPECT_EQ(over({1, 2, 3, 255}, {9, 8, 7, 255}), (Rgba8{1, 2, 3, 255}));
    EXPECT_EQ(over({1, 2, 3, 0}, {9, 8, 7, 255}), (Rgba8{9, 8, 7, 255}));
    EXPECT_EQ(over({200, 0, 0, 128}, {100, 0, 0, 255}).r, 150);
}

}  // namespace
}  // namespace rs
