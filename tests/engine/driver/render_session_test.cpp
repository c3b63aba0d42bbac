// The data module: objects in and out, cycles in order, double buffering, use from several threads.

#include "engine/driver/render_session.hpp"
#include "engine/core/fast/renderer.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace rs::engine {
namespace {

const test::RingObjectOptions kSmall{.views = 10, .width = 40, .height = 40, .fl_px = 55};

Camera pose(std::size_t i) {
    return test::ring_rig(kSmall).views[i].camera;
}

TEST(RenderSession, HandsOutTheViewsInTheOrderAsked) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession module;
    const Result<ObjectHandle> handle = module.load(object);
    ASSERT_TRUE(handle.ok());
    const Result<CycleHandle> cycle = module.submit({{*handle, pose(3)}, {*handle, pose(7)}});
    ASSERT_TRUE(cycle.ok());
    const auto images = module.retrieve(*cycle);
    ASSERT_TRUE(images.ok());
    ASSERT_EQ(images->size(), 2U);
    EXPECT_EQ((*images)[0], rgba_from_planar(object.images[3]));
    EXPECT_EQ((*images)[1], rgba_from_planar(object.images[7]));
    EXPECT_FALSE(module.retrieve(*cycle).ok());  // each cycle once
}

TEST(RenderSession, TellsDepthAndCostOfAView) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession module;
    const Result<ObjectHandle> handle = module.load(object);
    ASSERT_TRUE(handle.ok());
    const Result<CycleHandle> cycle = module.submit({{*handle, pose(3), true}, {*handle, pose(3)}});
    ASSERT_TRUE(cycle.ok());
    const Result<std::vector<DrawnView>> views = module.retrieve_views(*cycle);
    ASSERT_TRUE(views.ok());
    Image<Rgba8> image(40, 40);
    Image<std::int32_t> depth(40, 40);
    const Result<Renderer> renderer = Renderer::create(object);
    renderer->render(*prepare_view(object, pose(3)), image, depth);
    EXPECT_EQ((*views)[0].image, image);
    EXPECT_EQ((*views)[0].depth_q20, depth);
    EXPECT_EQ((*views)[1].image, image);
    EXPECT_TRUE((*views)[1].depth_q20.empty());
    for (const DrawnView& view : *views) {
        EXPECT_GT(view.seconds, 0);
        EXPECT_FALSE(view.by_board);
    }
}

TEST(RenderSession, APreparedObjectIsSharedNotCopied) {
    const auto renderer = std::make_shared<const Renderer>(Renderer::create(test::ring_object(kSmall)).value());
    RenderSession module;
    const Result<ObjectHandle> handle = module.load(PreparedObject{renderer, nullptr});
    ASSERT_TRUE(handle.ok());
    EXPECT_EQ(module.describe(*handle)->get(), &renderer->object());
    ASSERT_TRUE(module.retrieve(*module.submit({{*handle, pose(1)}})).ok());
    ASSERT_TRUE(module.evict(*handle).ok());
    EXPECT_EQ(renderer.use_count(), 1);
    EXPECT_FALSE(module.has_board());
}

TEST(RenderSession, AViewThatIsRefusedNamesItsObject) {
    RenderSession module;
    const Result<ObjectHandle> handle = module.load(test::ring_object(kSmall));
    Camera without_focus = pose(0);
    without_focus.fl_x = 0;
    const Result<CycleHandle> cycle = module.submit({{*handle, without_focus}});
    ASSERT_FALSE(cycle.ok());
    EXPECT_EQ(cycle.error().message.rfind("ring: ", 0), 0U) << cycle.error().message;
}

TEST(RenderSession, HoldsTwoCyclesAndRefusesAThird) {
    RenderSession module;
    const Result<ObjectHandle> handle = module.load(test::ring_object(kSmall));
    ASSERT_TRUE(handle.ok());
    const auto first = module.submit({{*handle, pose(0)}});
    const auto second = module.submit({{*handle, pose(1)}});
    ASSERT_TRUE(first.ok() && second.ok());
    const auto third = module.submit({{*handle, pose(2)}});
    ASSERT_FALSE(third.ok());
    EXPECT_NE(third.error().message.find("retrieve one first"), std::string::npos);
    ASSERT_TRUE(module.retrieve(*second).ok());  // in any order
    EXPECT_TRUE(module.ready(*first));           // it was queued before the second
    EXPECT_TRUE(module.submit({{*handle, pose(2)}}).ok());
}

TEST(RenderSession, AnEvictedObjectFinishesItsCycleAndTakesNoNewOne) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession module({.objects = 1});
    const Result<ObjectHandle> handle = module.load(object);
    ASSERT_TRUE(handle.ok());
    EXPECT_FALSE(module.load(object).ok());  // full
    const auto cycle = module.submit({{*handle, pose(5)}});
    ASSERT_TRUE(cycle.ok());
    ASSERT_TRUE(module.evict(*handle).ok());
    EXPECT_FALSE(module.submit({{*handle, pose(5)}}).ok());
    EXPECT_FALSE(module.describe(*handle).ok());
    EXPECT_FALSE(module.evict(*handle).ok());
    const auto images = module.retrieve(*cycle);
    ASSERT_TRUE(images.ok());
    EXPECT_EQ(images->front(), rgba_from_planar(object.images[5]));
    const Result<ObjectHandle> next = module.load(object);
    ASSERT_TRUE(next.ok());
    EXPECT_FALSE(*next == *handle);
}

TEST(RenderSession, RefusesABadViewWithNothingQueued) {
    RenderSession module;
    const Result<ObjectHandle> handle = module.load(test::ring_object(kSmall));
    ASSERT_TRUE(handle.ok());
    Camera bad = pose(0);
    bad.fl_x = 0;
    for (int n = 0; n < 5; ++n) EXPECT_FALSE(module.submit({{*handle, pose(0)}, {*handle, bad}}).ok());
    EXPECT_FALSE(module.submit(std::vector<ViewRequest>(16, {*handle, pose(0)})).ok());
    RaySpaceObject damaged = test::ring_object(kSmall);
    damaged.rings[0].cells[5] = 999;
    EXPECT_FALSE(module.load(damaged).ok());
    EXPECT_TRUE(module.submit({{*handle, pose(0)}}).ok());
}

TEST(RenderSession, ServesSeveralThreads) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession module({.objects = 8, .cycles_in_flight = 4});
    std::vector<std::thread> threads;
    std::vector<int> right(4);
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t n = 0; n < 25; ++n) {
                const Result<ObjectHandle> handle = module.load(object);
                if (!handle) continue;
                const std::size_t view = (t + n) % 10;
                const auto cycle = module.submit({{*handle, pose(view)}});
                if (cycle && module.evict(*handle)) {
                    const auto images = module.retrieve(*cycle);
                    right[t] += images && images->front() == rgba_from_planar(object.images[view]);
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const int count : right) EXPECT_EQ(count, 25);
}

}  // namespace
}  // namespace rs::engine
