// Traced images in FrameCompositor.

#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

class TracedFrame : public Compositing {};

// A traced image replaces geometry with the same depths, which still occlude objects.
TEST_F(TracedFrame, ATracedImageHasTheDepthsOfTheGeometry) {
    for (const bool in_fog : {false, true}) {
        Scene scene = with_box({1, 3, 0.2}, {0.6, 0, 1.5});
        if (in_fog) scene.fog = Fog{.colour = {0.5F, 0.5F, 0.5F}, .visibility = 60};
        auto frames = FrameCompositor::create(scene, {test::placed_at(test::drum(kRed))},
                                              {.width = kFrameWidth, .height = kFrameHeight, .samples = 1});
        ASSERT_TRUE(frames);
        const Result<Image<Rgba8>> lit = frames->compose(kFront);
        ASSERT_TRUE(lit.ok());
        const auto depths = [&] {
            std::vector<double> inverse;
            for (int y = 0; y < kFrameHeight; ++y) {
                for (int x = 0; x < kFrameWidth; ++x) {
                    const auto point = frames->surface_at(x, y);
                    inverse.push_back(point ? point->place.z : -100);
                }
            }
            return inverse;
        };
        const std::vector<double> lit_depths = depths();
        frames->set_traced(std::make_shared<const Image<Rgba8>>(kFrameWidth, kFrameHeight, kBlue));
        const Result<Image<Rgba8>> traced = frames->compose(kFront);
        ASSERT_TRUE(traced.ok());
        EXPECT_EQ(depths(), lit_depths);
        Camera aside = kFront;
        aside.world_from_camera[3].x += 0.5;
        EXPECT_EQ(*frames->compose(kFront), *traced);  // with the depths of the frame before
        EXPECT_NE(*frames->compose(aside), *traced);
        EXPECT_EQ(*frames->compose(kFront), *traced);
        int of_image = 0, of_object = 0;
        for (int y = 0; y < kFrameHeight; ++y) {
            for (int x = 0; x < kFrameWidth; ++x) {
                const bool object = is_colour((*lit)(x, y), kRed);
                of_object += object ? 1 : 0;
                if (object) {
                    EXPECT_EQ((*traced)(x, y), (*lit)(x, y));
                }
                of_image += (*traced)(x, y) == kBlue ? 1 : 0;
            }
        }
        if (in_fog) {  // dims the object and covers the geometry of the image
            EXPECT_GT(of_image, kFrameWidth * kFrameHeight / 2);
        } else {
            EXPECT_GT(of_object, 300);
            EXPECT_GT(of_image, kFrameWidth * kFrameHeight - 2500);
        }
        frames->set_traced(nullptr);
        const Result<Image<Rgba8>> again = frames->compose(kFront);
        ASSERT_TRUE(again.ok());
        EXPECT_EQ(count_different(*again, *lit, 0), 0);
    }
}

// Without blended parts over a traced image, depths are rendered on request only.
TEST_F(TracedFrame, ATracedImageOfGeometryAloneHasDepthsForWhoAsks) {
    auto frames = FrameCompositor::create(with_box({1, 3, 0.2}, {0.2, 0, 1.5}), {},
                                          {.width = kFrameWidth, .height = kFrameHeight, .samples = 1});
    ASSERT_TRUE(frames);
    ASSERT_TRUE(frames->draw(kFront));
    const int x = kFrameWidth / 2;
    const int y = kFrameHeight / 2;
    const auto lit_surface = frames->surface_at(x, y);
    const auto lit_ahead = frames->distance_ahead();
    ASSERT_TRUE(lit_surface && lit_ahead);
    frames->set_traced(std::make_shared<const Image<Rgba8>>(kFrameWidth, kFrameHeight, kBlue));
    const auto traced = frames->compose(kFront);
    ASSERT_TRUE(traced);
    EXPECT_FALSE(frames->statistics().has_depths);
    const auto surface = frames->surface_at(x, y);
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->place, lit_surface->place);
    EXPECT_EQ(frames->distance_ahead(), lit_ahead);
    EXPECT_TRUE(frames->statistics().has_depths);
    EXPECT_EQ(frames->image(), *traced);
    // Depths are kept for the next image of the view, but not for another view.
    ASSERT_TRUE(frames->draw(kFront));
    EXPECT_TRUE(frames->statistics().has_depths);
    Camera aside = kFront;
    aside.world_from_camera[3].x += 0.5;
    ASSERT_TRUE(frames->draw(aside));
    EXPECT_FALSE(frames->statistics().has_depths);
    EXPECT_NE(frames->distance_ahead(), std::nullopt);
}

}  // namespace
}  // namespace rs::compositor
