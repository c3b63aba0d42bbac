#include "compositor/traced/refinement.hpp"

#include "tests/compositor/traced/small_room.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>

namespace rs::compositor {
namespace {

// Images get finer whatever time they take, and begin() cancels the previous view.
TEST(Refinement, GoesFromCoarseToFineAndBeginsAnew) {
    Refinement refinement([] { return renderer_of(small_room()); });
    const auto wait_for = [&](int passes) {
        const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
        std::shared_ptr<const Image<Rgba8>> image;
        while (std::chrono::steady_clock::now() < patience) {
            if (const auto step = refinement.take()) {
                image = step->image;
                if (step->passes >= passes) return image;
            }
            std::this_thread::yield();
        }
        return image;
    };
    const Camera first = looking_from({3, 2, 4}, {0, 0.4, 0}, 50);
    const Camera second = looking_from({0, 5, 0.1}, {0, 0, 0}, 20);
    refinement.begin(first);
    const auto early = wait_for(0);
    ASSERT_NE(early, nullptr);
    EXPECT_EQ(early->width(), 50);
    ASSERT_NE(wait_for(3), nullptr);
    refinement.begin(second);
    const auto other = wait_for(1);
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(other->width(), 20);
    refinement.end();
    EXPECT_FALSE(refinement.failure());
}

TEST(Refinement, WaitsWhileTheFirstImageIsDrawn) {
    Refinement refinement([] { return renderer_of(small_room()); });
    refinement.begin(looking_from({3, 2, 4}, {0, 0.4, 0}, 50));
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    const auto next = [&] {
        std::optional<Refinement::Step> step;
        while (!step && std::chrono::steady_clock::now() < patience) step = refinement.take();
        return step;
    };
    ASSERT_TRUE(next());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // time to draw it
    EXPECT_FALSE(refinement.take());
    EXPECT_TRUE(next());
    // Another view, and the end, do not wait for that.
    refinement.begin(looking_from({0, 5, 0.1}, {0, 0, 0}, 20));
    ASSERT_TRUE(next());
    refinement.begin(looking_from({0, 5, 0.1}, {0, 0, 0}, 30));
    std::optional<Refinement::Step> step = next();
    while (step && step->camera.width != 30) step = next();
    EXPECT_TRUE(step);
}

TEST(Refinement, ChangesItsLightWithoutANewTracer) {
    std::atomic<int> made{0};
    Refinement refinement([&made] {
        ++made;
        return renderer_of(small_room());
    });
    const Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 40);
    const auto first_pass = [&] {
        const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
        for (std::shared_ptr<const Image<Rgba8>> first; std::chrono::steady_clock::now() < patience;) {
            const auto step = refinement.take();
            if (step && step->passes == 1) first = step->image;
            if (first) return *first;
            // The first pass may have been skipped.
            if (step && step->passes > 1) refinement.begin(camera);
            std::this_thread::yield();
        }
        return Image<Rgba8>();
    };
    refinement.begin(camera);
    const Image<Rgba8> before = first_pass();
    Scene moved = small_room();
    moved.lights[0].location = {-2, 3, 0};
    refinement.set_lights({std::make_shared<const Scene>(moved), 0});
    refinement.begin(camera);
    const Image<Rgba8> after = first_pass();
    EXPECT_NE(after, before);
    refinement.set_lights({std::make_shared<const Scene>(small_room()), 0});
    refinement.begin(camera);
    EXPECT_EQ(first_pass(), before);
    EXPECT_EQ(made, 1);
}

// Continuous restarts still produce images.
TEST(Refinement, FinishesTheFirstImageOfEachView) {
    Refinement refinement([] { return renderer_of(small_room()); });
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    int images = 0;
    for (int i = 0; images < 3 && std::chrono::steady_clock::now() < patience; ++i) {
        const Camera camera = looking_from({3 + 1e-4 * i, 2, 4}, {0, 0.4, 0}, 200);
        refinement.begin(camera);
        const auto step = refinement.take();
        if (!step) continue;
        ++images;
        EXPECT_EQ(step->image->width(), 200);
        EXPECT_LE(step->camera.centre().x, camera.centre().x);
    }
    EXPECT_EQ(images, 3);
}

TEST(Refinement, AGridIsTheMiddleOfItsPixels) {
    auto renderer = renderer_of(small_room());
    ASSERT_TRUE(renderer);
    const Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 50);
    const auto coarse = renderer->coarse_image(camera, 16);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->width(), 50);
    for (int y = 0; y < 50; ++y) {
        for (int x = 0; x < 50; ++x) ASSERT_EQ((*coarse)(x, y), (*coarse)(x / 16 * 16, y / 16 * 16));
    }
    std::atomic<bool> stop{true};
    EXPECT_FALSE(renderer->coarse_image(camera, 4, &stop));
}

TEST(Refinement, SaysWhyThereAreNoImages) {
    Refinement refinement([]() -> Result<TracedRenderer> { return Error{"no tracer today"}; });
    refinement.begin(looking_from({3, 2, 4}, {0, 0.4, 0}, 50));
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!refinement.failure() && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
    ASSERT_TRUE(refinement.failure());
    EXPECT_EQ(refinement.failure()->message, "no tracer today");
    EXPECT_FALSE(refinement.take());
}

}  // namespace
}  // namespace rs::compositor
