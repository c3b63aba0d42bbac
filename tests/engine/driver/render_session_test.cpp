// Tests of RenderSession: loading and evicting, order of cycles, double buffering, use from several threads.

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

TEST(RenderSession, ReturnsViewsInTheOrderOfSubmission) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession session;
    const Result<ObjectHandle> handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    const Result<CycleHandle> cycle = session.submit({{*handle, pose(3)}, {*handle, pose(7)}});
    ASSERT_TRUE(cycle.ok());
    const auto images = session.retrieve(*cycle);
    ASSERT_TRUE(images.ok());
    ASSERT_EQ(images->size(), 2U);
    EXPECT_EQ((*images)[0], rgba_from_planar(object.images[3]));
    EXPECT_EQ((*images)[1], rgba_from_planar(object.images[7]));
    EXPECT_FALSE(session.retrieve(*cycle).ok());  // a cycle can be retrieved once
}

TEST(RenderSession, ReportsDepthAndTimeOfAView) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession session;
    const Result<ObjectHandle> handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    const Result<CycleHandle> cycle = session.submit({{*handle, pose(3), true}, {*handle, pose(3)}});
    ASSERT_TRUE(cycle.ok());
    const Result<std::vector<DrawnView>> views = session.retrieve_views(*cycle);
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
    RenderSession session;
    const Result<ObjectHandle> handle = session.load(PreparedObject{renderer, nullptr});
    ASSERT_TRUE(handle.ok());
    EXPECT_EQ(session.describe(*handle)->get(), &renderer->object());
    ASSERT_TRUE(session.retrieve(*session.submit({{*handle, pose(1)}})).ok());
    ASSERT_TRUE(session.evict(*handle).ok());
    EXPECT_EQ(renderer.use_count(), 1);
    EXPECT_FALSE(session.has_board());
}

TEST(RenderSession, ARejectedViewNamesItsObject) {
    RenderSession session;
    const Result<ObjectHandle> handle = session.load(test::ring_object(kSmall));
    Camera without_focus = pose(0);
    without_focus.fl_x = 0;
    const Result<CycleHandle> cycle = session.submit({{*handle, without_focus}});
    ASSERT_FALSE(cycle.ok());
    EXPECT_EQ(cycle.error().message.rfind("ring: ", 0), 0U) << cycle.error().message;
}

TEST(RenderSession, QueuesTwoCyclesAndRejectsAThird) {
    RenderSession session;
    const Result<ObjectHandle> handle = session.load(test::ring_object(kSmall));
    ASSERT_TRUE(handle.ok());
    const auto first = session.submit({{*handle, pose(0)}});
    const auto second = session.submit({{*handle, pose(1)}});
    ASSERT_TRUE(first.ok() && second.ok());
    const auto third = session.submit({{*handle, pose(2)}});
    ASSERT_FALSE(third.ok());
    EXPECT_NE(third.error().message.find("retrieve one first"), std::string::npos);
    ASSERT_TRUE(session.retrieve(*second).ok());  // in any order
    EXPECT_TRUE(session.ready(*first));           // queued before the second
    EXPECT_TRUE(session.submit({{*handle, pose(2)}}).ok());
}

TEST(RenderSession, AnEvictedObjectFinishesItsCycleAndRejectsNewOnes) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession session({.objects = 1});
    const Result<ObjectHandle> handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    EXPECT_FALSE(session.load(object).ok());  // full
    const auto cycle = session.submit({{*handle, pose(5)}});
    ASSERT_TRUE(cycle.ok());
    ASSERT_TRUE(session.evict(*handle).ok());
    EXPECT_FALSE(session.submit({{*handle, pose(5)}}).ok());
    EXPECT_FALSE(session.describe(*handle).ok());
    EXPECT_FALSE(session.evict(*handle).ok());
    const auto images = session.retrieve(*cycle);
    ASSERT_TRUE(images.ok());
    EXPECT_EQ(images->front(), rgba_from_planar(object.images[5]));
    const Result<ObjectHandle> next = session.load(object);
    ASSERT_TRUE(next.ok());
    EXPECT_FALSE(*next == *handle);
}

TEST(RenderSession, RejectsABadViewWithNothingQueued) {
    RenderSession session;
    const Result<ObjectHandle> handle = session.load(test::ring_object(kSmall));
    ASSERT_TRUE(handle.ok());
    Camera bad = pose(0);
    bad.fl_x = 0;
    for (int n = 0; n < 5; ++n) EXPECT_FALSE(session.submit({{*handle, pose(0)}, {*handle, bad}}).ok());
    EXPECT_FALSE(session.submit(std::vector<ViewRequest>(16, {*handle, pose(0)})).ok());
    RaySpaceObject damaged = test::ring_object(kSmall);
    damaged.rings[0].cells[5] = 999;
    EXPECT_FALSE(session.load(damaged).ok());
    EXPECT_TRUE(session.submit({{*handle, pose(0)}}).ok());
}

TEST(RenderSession, ServesSeveralThreads) {
    const RaySpaceObject object = test::ring_object(kSmall);
    RenderSession session({.objects = 8, .cycles_in_flight = 4});
    std::vector<std::thread> threads;
    std::vector<int> right(4);
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t n = 0; n < 25; ++n) {
                const Result<ObjectHandle> handle = session.load(object);
                if (!handle) continue;
                const std::size_t view = (t + n) % 10;
                const auto cycle = session.submit({{*handle, pose(view)}});
                if (cycle && session.evict(*handle)) {
                    const auto images = session.retrieve(*cycle);
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
