// The fast renderer of objects with a shape map equals the scalar definition bit for bit in colour and depth, for
// random maps, sizes and poses, on every SIMD target.

#include "engine/core/definition/reconstruct.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "engine/core/fast/renderer.hpp"
#include "engine/core/views/compare.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/chunks/shape_chunk.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/random.hpp"
#include "tests/support/random_ring_object.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

namespace rs::engine {
namespace {

using test::Pose;
using test::Random;
using test::random_object;
using test::random_options;
using test::shape_camera;

struct CanvasPair {
    Image<Rgba8> colour;
    Image<std::int32_t> lambda;
    bool operator==(const CanvasPair&) const = default;
};

// Renders on a canvas with a border, to check that nothing else is written.
template <class Render>
CanvasPair on_canvas(const Camera& camera, int border, const Render& render) {
    CanvasPair canvas{Image<Rgba8>(camera.width + 2 * border, camera.height + 2 * border, {1, 2, 3, 4}),
                      Image<std::int32_t>(camera.width + 2 * border + 1, camera.height + 2 * border, -7)};
    render(canvas.colour.view().crop(border, border, camera.width, camera.height),
           canvas.lambda.view().crop(border, border, camera.width, camera.height));
    return canvas;
}

struct PixelCounts {
    std::int64_t pixels = 0;
    std::int64_t opaque = 0;  // alpha above 0
};

PixelCounts expect_equal(Pose pose, std::uint64_t first_seed, int objects, int views) {
    PixelCounts counts;
    for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(objects); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const test::RingObjectOptions options = random_options(random);
        const RaySpaceObject object = random_object(random, options);
        for (const Ring& ring : object.rings) {
            const Status valid = object_chunks::check_shape(ring);
            EXPECT_TRUE(valid.ok()) << valid.error().message;
        }
        const Result<Renderer> renderer = Renderer::create(object);
        EXPECT_TRUE(renderer.ok());
        for (int v = 0; v < views; ++v) {
            SCOPED_TRACE(v);
            const Camera camera = shape_camera(random, options, pose);
            const auto filter = static_cast<TexelFilter>(v % 3);
            const Result<ViewRegisters> registers = prepare_view(object, camera, filter);
            if (!registers) continue;
            EXPECT_EQ(registers->upright(), pose != Pose::tilted);
            const int border = random.whole(0, 3);
            const CanvasPair defined = on_canvas(camera, border, [&](const auto& colour, const auto& lambda) {
                reconstruct_scalar(object, *registers, colour, lambda);
            });
            const CanvasPair rendered = on_canvas(camera, border, [&](const auto& colour, const auto& lambda) {
                renderer->render(*registers, colour, lambda);
            });
            EXPECT_EQ(rendered.colour, defined.colour);
            EXPECT_EQ(rendered.lambda, defined.lambda);
            if (!(rendered == defined)) return counts;
            counts.pixels += std::int64_t{camera.width} * camera.height;
            for (int j = border; j < border + camera.height; ++j) {
                for (int i = border; i < border + camera.width; ++i) {
                    const bool shown = defined.colour(i, j).a > 0;
                    counts.opaque += shown;
                    EXPECT_EQ(defined.lambda(i, j) > 0, shown);
                }
            }
        }
    }
    // Guards against a vacuous test: the views must show enough of the objects.
    EXPECT_GT(counts.opaque * 20, counts.pixels);
    return counts;
}

TEST(ShapeRendererProperty, EqualsTheScalarDefinitionOnTheRing) {
    expect_equal(Pose::on_ring, 100, 150, 12);
}

TEST(ShapeRendererProperty, EqualsTheScalarDefinitionAtCapturedViews) {
    expect_equal(Pose::at_captured_view, 1100, 100, 6);
}

TEST(ShapeRendererProperty, EqualsTheScalarDefinitionNearerFartherAndHigher) {
    expect_equal(Pose::upright, 2100, 200, 16);
}

TEST(ShapeRendererProperty, EqualsTheScalarDefinitionOnTiltedViews) {
    expect_equal(Pose::tilted, 3100, 50, 8);
}

TEST(ShapeRendererProperty, EverySimdTargetGivesTheSameBytes) {
    std::int64_t targets = hwy::SupportedTargets();
    int tried = 0;
    while (targets != 0) {
        const std::int64_t target = targets & -targets;
        targets &= targets - 1;
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        expect_equal(Pose::on_ring, 5000, 25, 6);
        expect_equal(Pose::upright, 6000, 25, 10);
        ++tried;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(tried, 1);
}

TEST(ShapeRenderer, GivesTheSameBytesOnAnyNumberOfThreadsAndWithoutDepth) {
    const test::RingObjectOptions options{.views = 24, .width = 100, .height = 90, .fl_px = 140};
    Random random(1);
    const RaySpaceObject object = random_object(random, options);
    const Result<Renderer> renderer = Renderer::create(object);
    ASSERT_TRUE(renderer.ok());
    const Camera camera = look_at_camera({1, 0.2, 3}, {0, 0.2, 0}, radians(40), 131, 77);
    const Result<ViewRegisters> registers = prepare_view(object, camera);
    ASSERT_TRUE(registers.ok());
    Image<Rgba8> defined(131, 77);
    reconstruct_scalar(object, *registers, defined);
    for (const std::size_t threads : {1U, 2U, 4U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Image<Rgba8> image(131, 77);
        renderer->render(*registers, image);
        EXPECT_EQ(image, defined);
    }
}

TEST(ShapeRenderer, ShowsReferencePlanesWhereImagesAreMissing) {
    const test::RingObjectOptions options{.views = 16, .width = 64, .height = 64, .fl_px = 90};
    Random random(2);
    RaySpaceObject with_shape = random_object(random, options);
    for (std::size_t i = 0; i < with_shape.images.size(); ++i) {
        if (progressive_level(static_cast<int>(i)) > 0) with_shape.images[i] = {};
    }
    RaySpaceObject without = with_shape;
    without.rings[0].shape = {};
    const Camera camera = test::ring_rig(options).views[3].camera;
    Image<Rgba8> images[2] = {Image<Rgba8>(64, 64), Image<Rgba8>(64, 64)};
    for (const int n : {0, 1}) {
        const Result<Renderer> renderer = Renderer::create(n == 0 ? with_shape : without);
        ASSERT_TRUE(renderer.ok());
        renderer->render(*prepare_view(renderer->object(), camera), images[n]);
    }
    EXPECT_EQ(images[0], images[1]);
}

TEST(Renderer, DepthIsThatOfTheReferencePlane) {
    const test::RingObjectOptions options{.views = 12, .width = 64, .height = 64, .fl_px = 90};
    const RaySpaceObject object = test::ring_object(options);
    const Result<Renderer> renderer = Renderer::create(object);
    ASSERT_TRUE(renderer.ok());
    for (const double height : {0.0, 0.8}) {  // upright, tilted
        const Camera camera = look_at_camera({0, height, 3}, {0, 0, 0}, radians(45), 41, 33);
        const Result<ViewRegisters> registers = prepare_view(object, camera);
        ASSERT_TRUE(registers.ok());
        EXPECT_EQ(registers->upright(), height == 0);
        CanvasPair rendered{Image<Rgba8>(41, 33), Image<std::int32_t>(41, 33)};
        CanvasPair defined = rendered;
        renderer->render(*registers, rendered.colour, rendered.lambda);
        reconstruct_scalar(object, *registers, defined.colour, defined.lambda);
        EXPECT_EQ(rendered, defined);
        for (int j = 0; j < 33; ++j) {
            for (int i = 0; i < 41; ++i) {
                const double depth = std::ldexp(rendered.lambda(i, j), -20);
                if (rendered.colour(i, j).a == 0) {
                    EXPECT_EQ(depth, 0);
                } else {
                    // The point is on a vertical plane through the axis that is nearly perpendicular to the ray.
                    const glm::dvec3 point = camera.centre() + depth * camera.ray(i + 0.5, j + 0.5);
                    EXPECT_LT(std::abs(point.z), std::abs(point.x) * std::tan(kPi / 6) + 1e-4);
                }
            }
        }
    }
}

TEST(DepthImage, IsInTheRigsUnitsFromTheCamerasOwnCentre) {
    RaySpaceObject object = test::ring_object({.views = 12, .width = 64, .height = 64, .fl_px = 90});
    object.units_per_radius = 2.5;
    const Result<Renderer> renderer = Renderer::create(object);
    ASSERT_TRUE(renderer.ok());
    for (const double radii : {3.0, 900.0}) {  // the viewpoint at 900 radii is moved to 200
        const Camera camera = look_at_camera({0, 0, radii * 2.5}, {0, 0, 0}, 2 * std::atan(1 / radii), 41, 33);
        const Result<ViewRegisters> registers = prepare_view(object, camera);
        ASSERT_TRUE(registers.ok());
        CanvasPair rendered{Image<Rgba8>(41, 33), Image<std::int32_t>(41, 33)};
        renderer->render(*registers, rendered.colour, rendered.lambda);
        const Image<float> depth = depth_image(object, camera, rendered.lambda);
        int shown = 0;
        for (int j = 0; j < 33; ++j) {
            for (int i = 0; i < 41; ++i) {
                if (rendered.colour(i, j).a == 0) {
                    EXPECT_EQ(depth(i, j), 0);
                } else {
                    ++shown;
                    // The plane is within 15 degrees of perpendicular to a ray, a ray within 19 of the axis.
                    EXPECT_NEAR(depth(i, j), radii * 2.5, 2.5 * std::tan(radians(34)));
                }
            }
        }
        EXPECT_GT(shown, 100);
    }
}

TEST(Conformance, CoversShapeMaps) {
    Random random(3);
    const RaySpaceObject object = random_object(random, {.views = 12, .width = 50, .height = 50});
    const Result<ConformanceReport> report = check_conformance(object, 16, 1);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->different_pixels, 0);
    EXPECT_GT(report->object_pixels, 1000);
    EXPECT_GT(report->on_ring_views, 2);
}

}  // namespace
}  // namespace rs::engine
