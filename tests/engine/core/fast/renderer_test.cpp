// The fast renderer equals the scalar definition bit for bit for random objects, sizes and poses, on every SIMD target.

#include "engine/core/fast/renderer.hpp"
#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/fast/column_walk.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/random.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <bit>

namespace rs::engine {
namespace {

using test::Random;

Camera plane_camera(Random& random, bool upright) {
    const double angle = random.real(0, 2 * kPi), distance = random.real(0.3, 12);
    const glm::dvec3 eye(distance * std::sin(angle), random.real(-1, 1), distance * std::cos(angle));
    const glm::dvec3 at(random.real(-0.4, 0.4), upright ? eye.y : random.real(-1, 1), random.real(-0.4, 0.4));
    Camera camera = look_at_camera(eye, at, radians(random.real(5, 100)), random.whole(1, 70), random.whole(1, 70));
    if (upright) camera = upright_camera(camera);
    camera.cx += random.real(-20, 20);
    camera.cy += random.real(-20, 20);
    if (random.whole(0, 9) == 0) {  // upside down: rotated by 180 degrees about the viewing axis
        camera.world_from_camera[0] = -camera.world_from_camera[0];
        camera.world_from_camera[1] = -camera.world_from_camera[1];
    }
    return camera;
}

void expect_equal_on_random_views(bool upright, std::uint64_t first_seed, int objects, int views) {
    std::int64_t shown = 0;
    for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(objects); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const test::RingObjectOptions options{.views = random.whole(1, 20),
                                              .width = random.whole(1, 50),
                                              .height = random.whole(6, 50),
                                              .distance = random.real(1.5, 8),
                                              .fl_px = random.real(10, 150),
                                              .planes = random.whole(3, 16),
                                              .x_cells = random.whole(1, 80),
                                              .u_cells = random.whole(1, 80),
                                              .camera_height = random.real(-0.5, 0.5),
                                              .seed = seed};
        const RaySpaceObject object = test::ring_object(options);
        const Result<Renderer> renderer = Renderer::create(object);
        ASSERT_TRUE(renderer.ok());
        for (int v = 0; v < views; ++v) {
            SCOPED_TRACE(v);
            const Camera camera = plane_camera(random, upright);
            const Result<ViewRegisters> registers = prepare_view(object, camera);
            if (!registers) continue;
            ASSERT_EQ(registers->upright(), upright);
            // View with an odd stride inside a larger image; pixels outside of the view must not change.
            const Rgba8 kMark{1, 2, 3, 4};
            const int border = random.whole(0, 5);
            Image<Rgba8> canvas(camera.width + 2 * border, camera.height + 2 * border, kMark);
            renderer->render(*registers, canvas.view().crop(border, border, camera.width, camera.height));
            Image<Rgba8> expected(canvas.width(), canvas.height(), kMark);
            reconstruct_scalar(object, *registers, expected.view().crop(border, border, camera.width, camera.height));
            ASSERT_EQ(canvas, expected);
            for (const Rgba8& p : expected.pixels()) shown += p.a != 0 && !(p == kMark);
        }
    }
    // Guards against a vacuous test: the views must show enough of the objects.
    EXPECT_GT(shown, std::int64_t{objects} * views * 20);
}

TEST(RendererProperty, EqualsTheScalarDefinitionOnUprightViews) {
    expect_equal_on_random_views(true, 100, 300, 20);
}

TEST(RendererProperty, EqualsTheScalarDefinitionOnTiltedViews) {
    expect_equal_on_random_views(false, 900, 100, 10);
}

TEST(RendererProperty, EverySimdTargetGivesTheSameBytes) {
    std::int64_t targets = hwy::SupportedTargets();
    int tried = 0;
    while (targets != 0) {
        const std::int64_t target = targets & -targets;
        targets &= targets - 1;
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        expect_equal_on_random_views(true, 5000 + static_cast<std::uint64_t>(tried), 6, 10);
        ++tried;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(tried, 1);
}

TEST(Renderer, GivesTheSameBytesOnAnyNumberOfThreads) {
    const RaySpaceObject object = test::ring_object({.views = 24, .width = 200, .height = 150, .fl_px = 300});
    const Result<Renderer> renderer = Renderer::create(object);
    ASSERT_TRUE(renderer.ok());
    const Camera camera = look_at_camera({1, 0.2, 3}, {0, 0.2, 0}, radians(40), 331, 277);
    const Result<ViewRegisters> registers = prepare_view(object, camera);
    ASSERT_TRUE(registers.ok());
    Image<Rgba8> first(331, 277);
    for (const std::size_t threads : {1U, 2U, 4U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Image<Rgba8> image(331, 277);
        renderer->render(*registers, image);
        if (threads == 1) first = image;
        EXPECT_EQ(image, first);
    }
}

TEST(Renderer, ReplacesMissingImagesByNeighbours) {
    const test::RingObjectOptions options{.views = 16, .width = 64, .height = 64, .fl_px = 90};
    RaySpaceObject whole = test::ring_object(options);
    RaySpaceObject partial = whole;
    for (std::size_t i = 0; i < partial.images.size(); ++i) {
        if (progressive_level(static_cast<int>(i)) > 0) partial.images[i] = {};
    }
    const Rig rig = test::ring_rig(options);
    const Result<Renderer> renderer = Renderer::create(partial);
    ASSERT_TRUE(renderer.ok());
    for (const std::size_t i : {0U, 8U, 3U}) {
        const Result<ViewRegisters> registers = prepare_view(renderer->object(), rig.views[i].camera);
        ASSERT_TRUE(registers.ok());
        Image<Rgba8> image(64, 64);
        renderer->render(*registers, image);
        int shown = 0;
        for (const Rgba8& p : image.pixels()) shown += p.a != 0;
        EXPECT_GT(shown, 500);
        if (i != 3) {
            EXPECT_EQ(image, rgba_from_planar(whole.images[i]));
        }
    }
    for (PlanarImage& image : partial.images) image = {};
    EXPECT_FALSE(Renderer::create(partial).ok());
}

}  // namespace
}  // namespace rs::engine
