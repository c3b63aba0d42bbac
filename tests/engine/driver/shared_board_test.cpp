// Tests of RenderSession with a board: distribution of views, a board that is full or fails, replaced objects, and a
// long random run on both executors. Every image is compared with the scalar definition.

#include "engine/core/definition/reconstruct.hpp"
#include "engine/driver/render_session.hpp"
#include "engine/model/board.hpp"
#include "engine/model/layout/object_image.hpp"
#include "tests/support/random_shape.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <deque>
#include <random>
#include <thread>

namespace rs::engine {
namespace {

// These tests are about the threads of the session. TBB is restricted to one thread, since race detectors do not
// understand its synchronization.
const tbb::global_control kNoOtherThreads(tbb::global_control::max_allowed_parallelism, 1);

const test::RingObjectOptions kSmallOnBoard{
    .views = 6, .width = 24, .height = 20, .fl_px = 30, .planes = 4, .x_cells = 24, .u_cells = 16};

// Object with the 2-bit alpha of the board.
RaySpaceObject object_of(std::uint64_t seed) {
    test::RingObjectOptions options = kSmallOnBoard;
    options.seed = seed;
    RaySpaceObject object = model::with_board_alpha(test::ring_object(options));
    object.name = "object " + std::to_string(seed);
    return object;
}

Camera camera_at(double azimuth, double distance, int width, int height) {
    const glm::dvec3 eye(distance * std::sin(azimuth), 0, distance * std::cos(azimuth));
    return look_at_camera(eye, {0, 0, 0}, 2 * std::atan(1.1 / distance), width, height);
}

Image<Rgba8> defined(const RaySpaceObject& object, const Camera& camera) {
    Image<Rgba8> image(camera.width, camera.height);
    reconstruct_scalar(object, *prepare_view(object, camera), image);
    return image;
}

model::BoardConfig config() {
    return *model::read_board_config("prototype-2000");
}

std::vector<Image<Rgba8>> images_of(RenderSession& session, const std::vector<ViewRequest>& views) {
    const auto cycle = session.submit(views);
    EXPECT_TRUE(cycle.ok()) << cycle.error().message;
    auto images = session.retrieve(*cycle);
    EXPECT_TRUE(images.ok()) << images.error().message;
    return images ? std::move(*images) : std::vector<Image<Rgba8>>();
}

// Renders until the board has rendered a view; false after 2000 attempts.
bool wait_for_board(RenderSession& session, const ViewRequest& view, const Image<Rgba8>& expected) {
    for (int n = 0; n < 2000; ++n) {
        EXPECT_EQ(images_of(session, {view}).front(), expected);
        if (session.statistics().views_by_board > 0) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

TEST(SharedBoard, TheCoreRendersUntilTheObjectIsOnTheBoard) {
    const RaySpaceObject object = object_of(1);
    RenderSession session({}, model::make_simulated_board(config()));
    const auto handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    const Camera camera = camera_at(0.3, 3.1, 24, 20);
    EXPECT_TRUE(wait_for_board(session, {*handle, camera}, defined(object, camera)));
    EXPECT_EQ(session.statistics().board.loads, 1);
    EXPECT_GT(session.statistics().views_by_core, 0);
}

TEST(SharedBoard, TheCoreRendersWhatTheBoardCannot) {
    RenderSession session({}, model::make_simulated_board(config(), true));
    RaySpaceObject shaped = object_of(2);
    std::mt19937_64 random(3);
    shaped.rings[0].shape = test::random_shape(shaped, 0, random, 0.3);
    const RaySpaceObject plain = object_of(4);
    const auto shaped_handle = session.load(shaped);
    const auto plain_handle = session.load(plain);
    ASSERT_TRUE(shaped_handle.ok() && plain_handle.ok());
    const Camera level = camera_at(1, 3, 20, 20);
    const Camera tilted = look_at_camera({1, 1.5, 3}, {0, 0, 0}, 0.6, 20, 20);
    ASSERT_TRUE(wait_for_board(session, {*plain_handle, level}, defined(plain, level)));
    const RenderSessionStatistics before = session.statistics();
    const auto images = images_of(session, {{*shaped_handle, level}, {*plain_handle, tilted}, {*plain_handle, level}});
    ASSERT_EQ(images.size(), 3U);
    EXPECT_EQ(images[0], defined(shaped, level));
    EXPECT_EQ(images[1], defined(plain, tilted));
    EXPECT_EQ(images[2], defined(plain, level));
    EXPECT_EQ(session.statistics().views_by_board, before.views_by_board + 1);
    EXPECT_EQ(session.statistics().views_by_core, before.views_by_core + 2);
}

TEST(SharedBoard, EachObjectThatTheCoreRendersIsReportedOnce) {
    RenderSession session({}, model::make_simulated_board(config(), true));
    RaySpaceObject shaped = object_of(2);
    std::mt19937_64 random(3);
    shaped.rings[0].shape = test::random_shape(shaped, 0, random, 0.3);
    const auto shaped_handle = session.load(shaped);
    const auto plain_handle = session.load(object_of(4));
    ASSERT_TRUE(shaped_handle.ok() && plain_handle.ok());
    session.load_on_board({*plain_handle});
    EXPECT_TRUE(session.take_fallbacks().empty()) << "nothing is rendered yet";
    const Camera level = camera_at(1, 3, 20, 20);
    images_of(session, {{*plain_handle, level}, {*shaped_handle, level}});
    images_of(session, {{*shaped_handle, level}});
    std::vector<CoreFallback> fallbacks = session.take_fallbacks();
    ASSERT_EQ(fallbacks.size(), 1U);
    EXPECT_EQ(fallbacks[0].object, *shaped_handle);
    EXPECT_NE(fallbacks[0].reason.find("object 2: has a shape map"), std::string::npos) << fallbacks[0].reason;
    images_of(session, {{*plain_handle, look_at_camera({1, 1.5, 3}, {0, 0, 0}, 0.6, 20, 20)}, {*shaped_handle, level}});
    fallbacks = session.take_fallbacks();
    ASSERT_EQ(fallbacks.size(), 1U);
    EXPECT_EQ(fallbacks[0].object, *plain_handle);
    EXPECT_NE(fallbacks[0].reason.find("object 4: view: the camera is tilted"), std::string::npos)
        << fallbacks[0].reason;
}

TEST(SharedBoard, AnObjectWithoutASlotIsReported) {
    model::BoardConfig two = config();
    two.limits.objects = 2;
    RenderSession session({}, model::make_simulated_board(two, true));
    const auto first = session.load(object_of(1));
    const auto second = session.load(object_of(2));
    const auto third = session.load(object_of(3));
    ASSERT_TRUE(first.ok() && second.ok() && third.ok());
    session.load_on_board({*first, *second, *third});
    const Camera camera = camera_at(1, 3, 20, 20);
    images_of(session, {{*first, camera}, {*second, camera}, {*third, camera}});
    const std::vector<CoreFallback> fallbacks = session.take_fallbacks();
    ASSERT_EQ(fallbacks.size(), 1U);
    EXPECT_EQ(fallbacks[0].object, *third);
    EXPECT_NE(fallbacks[0].reason.find("slots are full"), std::string::npos) << fallbacks[0].reason;
}

TEST(SharedBoard, WithoutABoardNothingIsReported) {
    RenderSession session;
    const auto handle = session.load(object_of(1));
    images_of(session, {{*handle, camera_at(1, 3, 20, 20)}});
    EXPECT_TRUE(session.take_fallbacks().empty());
}

TEST(SharedBoard, ABoardWithoutFiltersRendersShapeMapsBilinearly) {
    RenderSession session({}, model::make_simulated_board(*model::read_board_config("parallel"), true));
    RaySpaceObject shaped = object_of(6);
    test::make_middle_opaque(shaped);
    std::mt19937_64 random(7);
    shaped.rings[0].shape = test::random_shape(shaped, 0, random, 0.1);
    const auto handle = session.load(shaped);
    ASSERT_TRUE(handle.ok());
    const Camera camera = camera_at(1, 3, 40, 36);
    const auto with = [&](TexelFilter filter) {
        Image<Rgba8> image(camera.width, camera.height);
        reconstruct_scalar(shaped, *prepare_view(shaped, camera, filter), image);
        return image;
    };
    EXPECT_TRUE(wait_for_board(session, {*handle, camera}, with(TexelFilter::kBilinear)));
    EXPECT_NE(with(TexelFilter::kBilinear), with(TexelFilter::kSharp));
}

TEST(SharedBoard, TheCoreRendersAnObjectWhoseLoadingFails) {
    model::BoardConfig slow = config();
    slow.disk.stall_after_bytes = 1;
    slow.disk.stall_cycles = 10'000'000;
    slow.disk.timeout_cycles = 100'000;
    const RaySpaceObject object = object_of(5);
    RenderSession session({}, model::make_simulated_board(slow));
    const auto handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    const Camera camera = camera_at(2, 3.3, 24, 20);
    for (int n = 0; n < 2000 && session.statistics().board.failed_loads == 0; ++n) {
        EXPECT_EQ(images_of(session, {{*handle, camera}}).front(), defined(object, camera));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(images_of(session, {{*handle, camera}}).front(), defined(object, camera));
    const RenderSessionStatistics statistics = session.statistics();
    EXPECT_EQ(statistics.board.failed_loads, 1);
    EXPECT_EQ(statistics.views_by_board, 0);
    EXPECT_NE(statistics.board.last_failure.find("disk"), std::string::npos) << statistics.board.last_failure;
}

const ExecutorTraits kTwoViews{.name = "two views", .depth = false, .views_per_cycle = 2};

// Board that loads objects and fails in every cycle.
class BrokenBoard final : public Executor {
public:
    [[nodiscard]] const ExecutorTraits& traits() const override { return kTwoViews; }
    Result<std::optional<int>> load(const RaySpaceObject&) override { return std::optional<int>(next_++); }
    Status evict(int) override { return {}; }
    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>& views) override {
        EXPECT_LE(views.size(), 2U);
        if (++calls_ % 2 == 0) throw std::runtime_error("smoke");
        return Error{"no power"};
    }

private:
    int next_ = 0;
    int calls_ = 0;
};

TEST(SharedBoard, TheCoreRendersAFailedCycle) {
    const RaySpaceObject object = object_of(6);
    RenderSession session({}, std::make_unique<BrokenBoard>());
    const auto handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    const Camera camera = camera_at(4, 2.8, 22, 26);
    for (int n = 0; n < 2000 && session.statistics().board.failed_cycles < 2; ++n) {
        const auto images = images_of(session, std::vector<ViewRequest>(4, {*handle, camera}));
        for (const Image<Rgba8>& image : images) ASSERT_EQ(image, defined(object, camera));
    }
    EXPECT_GE(session.statistics().board.failed_cycles, 2);
    EXPECT_EQ(session.statistics().views_by_board, 0);
    EXPECT_NE(session.statistics().board.last_failure.find("smoke"), std::string::npos);
    const std::vector<CoreFallback> fallbacks = session.take_fallbacks();
    ASSERT_EQ(fallbacks.size(), 1U);
    EXPECT_NE(fallbacks[0].reason.find("the board failed: "), std::string::npos) << fallbacks[0].reason;
}

// Board whose driver is out of memory.
class ExhaustedBoard final : public Executor {
public:
    [[nodiscard]] const ExecutorTraits& traits() const override { return kTwoViews; }
    Result<std::optional<int>> load(const RaySpaceObject&) override { throw std::bad_alloc(); }
    Status evict(int) override { throw std::bad_alloc(); }
    Result<std::vector<ExecutedView>> render(const std::vector<SlotView>&) override { throw std::bad_alloc(); }
};

TEST(SharedBoard, TheCoreRendersAnObjectThatTheDriverCannotLoad) {
    const RaySpaceObject object = object_of(6);
    RenderSession session({}, std::make_unique<ExhaustedBoard>());
    const auto handle = session.load(object);
    ASSERT_TRUE(handle.ok());
    const Camera camera = camera_at(4, 2.8, 22, 26);
    for (int n = 0; n < 2000 && session.statistics().board.failed_loads == 0; ++n) {
        const auto images = images_of(session, std::vector<ViewRequest>(4, {*handle, camera}));
        for (const Image<Rgba8>& image : images) ASSERT_EQ(image, defined(object, camera));
    }
    EXPECT_GE(session.statistics().board.failed_loads, 1);
    EXPECT_EQ(session.statistics().views_by_board, 0);
    EXPECT_NE(session.statistics().board.last_failure.find("driver failed"), std::string::npos);
}

// Renders random views of more objects than fit on the board, while objects are replaced.
void draw_random_cycles(int cycles) {
    constexpr int kObjects = 24;
    model::BoardConfig few = config();
    few.limits.objects = 20;
    RenderSession session({.objects = 64, .cycles_in_flight = 2}, model::make_simulated_board(few, true));
    std::vector<RaySpaceObject> objects;
    for (int n = 0; n < kObjects; ++n) objects.push_back(object_of(100 + static_cast<std::uint64_t>(n)));

    struct Loaded {
        ObjectHandle handle;
        std::size_t object = 0;
    };
    struct Pending {
        CycleHandle cycle;
        std::vector<std::size_t> objects;
        std::vector<Camera> cameras;
    };
    std::mt19937_64 random(77);
    const auto real = [&](double low, double high) {
        return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11U), -53);
    };
    std::vector<Loaded> loaded;
    for (std::size_t n = 0; n < objects.size(); ++n) {
        const auto handle = session.load(objects[n]);
        ASSERT_TRUE(handle.ok());
        loaded.push_back({*handle, n});
    }
    std::deque<Pending> pending;
    const auto check_one = [&] {
        const Pending oldest = std::move(pending.front());
        pending.pop_front();
        const auto images = session.retrieve(oldest.cycle);
        ASSERT_TRUE(images.ok()) << images.error().message;
        for (std::size_t v = 0; v < oldest.objects.size(); ++v) {
            ASSERT_EQ((*images)[v], defined(objects[oldest.objects[v]], oldest.cameras[v])) << "view " << v;
        }
    };
    for (int n = 0; n < cycles; ++n) {
        if (pending.size() == 2) check_one();
        if (testing::Test::HasFatalFailure()) FAIL() << "in cycle " << n;
        if (random() % 16 == 0) {  // replaces an object that may be in use
            Loaded& replaced = loaded[random() % loaded.size()];
            ASSERT_TRUE(session.evict(replaced.handle).ok());
            replaced.object = random() % objects.size();
            const auto handle = session.load(objects[replaced.object]);
            ASSERT_TRUE(handle.ok());
            replaced.handle = *handle;
        }
        Pending next;
        std::vector<ViewRequest> views;
        const std::size_t base = random() % loaded.size();  // mostly the same objects in consecutive cycles
        for (std::size_t v = 0; v < 15; ++v) {
            const Loaded& shown = loaded[(base / 8 * 4 + random() % 16) % loaded.size()];
            next.objects.push_back(shown.object);
            const int width = 8 + static_cast<int>(random() % 12);
            const int height = 8 + static_cast<int>(random() % 12);
            next.cameras.push_back(camera_at(real(0, 6.28), real(1.5, 6), width, height));
            views.push_back({shown.handle, next.cameras.back()});
        }
        const auto cycle = session.submit(views);
        ASSERT_TRUE(cycle.ok()) << cycle.error().message;
        next.cycle = *cycle;
        pending.push_back(std::move(next));
    }
    while (!pending.empty()) check_one();
    const RenderSessionStatistics statistics = session.statistics();
    EXPECT_EQ(statistics.cycles, cycles);
    EXPECT_EQ(statistics.views_by_board + statistics.views_by_core, 15 * cycles);
    EXPECT_GT(statistics.views_by_board, 0);
    EXPECT_GT(statistics.views_by_core, 0);
    EXPECT_EQ(statistics.board.failed_cycles, 0) << statistics.board.last_failure;
    std::printf("%lld views by the board, %lld by the core; %lld loads, %lld evictions\n",
                static_cast<long long>(statistics.views_by_board), static_cast<long long>(statistics.views_by_core),
                static_cast<long long>(statistics.board.loads), static_cast<long long>(statistics.board.evictions));
}

TEST(SharedBoard, ThousandsOfCyclesEqualTheDefinition) {
    draw_random_cycles(3000);
}

}  // namespace
}  // namespace rs::engine
