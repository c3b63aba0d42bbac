// Reflections of raster images against the path tracer. Skipped without OpenGL.

#include "compositor/scene/light/prefiltered_reflections.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kPasses = 64;

std::shared_ptr<const Mesh> unit_sphere() {
    constexpr std::uint32_t kStacks = 32, kSlices = 64;
    auto mesh = std::make_shared<Mesh>();
    for (std::uint32_t stack = 0; stack <= kStacks; ++stack) {
        for (std::uint32_t slice = 0; slice < kSlices; ++slice) {
            const glm::vec3 n =
                direction_in_map(glm::vec2(slice, stack), {static_cast<int>(kSlices), static_cast<int>(kStacks)});
            mesh->vertices.push_back({n, n});
            if (stack == kStacks) continue;
            const std::uint32_t row = stack * kSlices, below = row + kSlices, next = (slice + 1) % kSlices;
            for (const std::uint32_t i :
                 {row + slice, below + next, below + slice, row + slice, row + next, below + next}) {
                mesh->indices.push_back(i);
            }
        }
    }
    mesh->two_sided = false;
    return mesh;
}

// Dark below, brighter towards +X and -Z above.
EnvironmentLight horizon() {
    Image<RgbaF> pixels(32, 16);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            const float above = y < 8 ? 0.7F : 0.15F;
            const float aside = 0.5F + 0.5F * std::sin(0.19635F * (static_cast<float>(x) - 8));
            pixels(x, y) = {above * (0.4F + 0.6F * aside), above * 0.8F, above * (1 - 0.5F * aside), 1};
        }
    }
    return {std::make_shared<const Image<RgbaF>>(std::move(pixels)), 1, 0.5F, true};
}

Scene sphere_of(const SurfaceProperties& surface) {
    Scene scene;
    scene.lights.clear();
    scene.environment = horizon();
    GeometryNode node;
    node.mesh = unit_sphere();
    node.material.diffuse = surface.colour;
    node.material.ambient = 1;
    node.material.surface = surface;
    scene.geometry.push_back(std::move(node));
    return scene;
}

// Linear mean over the sphere's image, without its rim.
template <class Radiance>
glm::dvec3 mean_on_sphere(const Radiance& at) {
    glm::dvec3 sum(0);
    int count = 0;
    for (int y = 0; y < kFrameHeight; ++y) {
        for (int x = 0; x < kFrameWidth; ++x) {
            if (std::hypot(x + 0.5 - kFrameWidth / 2.0, y + 0.5 - kFrameHeight / 2.0) > 22) continue;
            sum += glm::dvec3(at(x, y));
            ++count;
        }
    }
    return sum / static_cast<double>(count);
}

glm::vec3 radiance_of(Rgba8 p) {
    return {linear_from_srgb8(p.r), linear_from_srgb8(p.g), linear_from_srgb8(p.b)};
}

class Reflections : public Compositing {
protected:
    glm::dvec3 raster_mean(const Scene& scene) {
        const Image<Rgba8> image = compose(scene, {}, kFront, 1);
        return mean_on_sphere([&](int x, int y) { return radiance_of(image(x, y)); });
    }

    // Largest difference between the channels of the mean in raster and in traced images, of the traced one.
    double mismatch(const Scene& scene) {
        auto tracer = TracedRenderer::create(scene, {}, {.method = TracedMethod::kPath});
        RS_CHECK(tracer.ok());
        tracer->begin_image(kFront);
        for (int pass = 0; pass < kPasses; ++pass) tracer->add_pass();
        const Image<RgbaF> traced = tracer->radiance();
        const glm::dvec3 expected =
            mean_on_sphere([&](int x, int y) { return glm::vec3(traced(x, y).r, traced(x, y).g, traced(x, y).b); });
        const glm::dvec3 raster = raster_mean(scene);
        const glm::dvec3 d = glm::abs(raster - expected) / expected;
        return std::max({d.x, d.y, d.z});
    }
};

TEST_F(Reflections, GoldMirrorAndLacquerHaveTheColoursOfThePathTracer) {
    EXPECT_LT(mismatch(sphere_of({rs::SurfaceKind::metal, {1, 0.77F, 0.34F}, 0.3F})), 0.11);
    EXPECT_LT(mismatch(sphere_of({rs::SurfaceKind::metal, {0.9F, 0.6F, 0.5F}, 0.8F})), 0.16);
    EXPECT_LT(mismatch(sphere_of({rs::SurfaceKind::mirror, glm::vec3(0.9F)})), 0.05);
    EXPECT_LT(mismatch(sphere_of({rs::SurfaceKind::glossy, {0.5F, 0.1F, 0.1F}, 0.2F})), 0.1);
}

TEST_F(Reflections, MirrorsShowTheOtherSurfacesAndTheFloor) {
    Scene scene = sphere_of({rs::SurfaceKind::mirror, glm::vec3(1)});
    const glm::dvec3 alone = raster_mean(scene);
    scene.geometry.push_back(scene.geometry[0]);  // a red wall at the right
    GeometryNode& wall = scene.geometry.back();
    wall.mesh = std::make_shared<const Mesh>(box_mesh({1, 20, 20}));
    wall.material = Material();
    wall.material.diffuse = {1, 0, 0};
    wall.material.ambient = 1;
    wall.world_from_node[3] = glm::dvec4(6, 0, 0, 1);
    const glm::dvec3 beside = raster_mean(scene);
    EXPECT_LT(beside.g, 0.9 * alone.g);
    EXPECT_LT(beside.b, 0.9 * alone.b);
    EXPECT_GT(beside.r / beside.g, 1.1 * alone.r / alone.g);
}

TEST_F(Reflections, GlassIsClearInItsMiddleAndReflectsAtItsRim) {
    Scene scene = sphere_of({rs::SurfaceKind::glass, glm::vec3(1)});
    scene.geometry[0].material.opacity = 0;
    scene.background.sky = {glm::vec3(0)};
    scene.environment->pixels = std::make_shared<const Image<RgbaF>>(8, 4, RgbaF{0.7F, 0.7F, 0.7F, 1});
    scene.environment->seen = false;
    const Image<Rgba8> image = compose(scene, {}, kFront, 1);
    // Schlick's approximation with 0.04 at normal incidence.
    EXPECT_NEAR(radiance_of(middle(image)).g, 0.04F * 0.7F, 0.004F);
    const float rim = radiance_of(image(kFrameWidth / 2 - 25, kFrameHeight / 2)).g;
    EXPECT_GT(rim, 0.08F);
    EXPECT_LT(rim, 0.4F);
}

TEST(PrefilteredReflections, KeepConstantsAndSmoothStepsByRoughness) {
    Image<RgbaF> radiance(kReflectionWidth, kReflectionHeight);
    for (int y = 0; y < kReflectionHeight; ++y) {
        for (int x = 0; x < kReflectionWidth; ++x) radiance(x, y) = {0.5F, y < kReflectionHeight / 2 ? 1.0F : 0, 0, 1};
    }
    const std::vector<Image<RgbaF>> levels = prefilter_reflections(radiance);
    ASSERT_EQ(levels.size(), static_cast<std::size_t>(kReflectionLevels));
    float last = 1;
    for (const Image<RgbaF>& level : levels) {
        for (const RgbaF& p : level.pixels()) EXPECT_NEAR(p.r, 0.5F, 1e-4F);
        // 45 degrees above the horizon, and the same below.
        const float above = level(level.width() / 3, level.height() / 4).g;
        EXPECT_LE(above, last + 1e-3F);
        EXPECT_NEAR(above + level(level.width() / 3, level.height() - 1 - level.height() / 4).g, 1, 0.05F);
        last = above;
    }
    EXPECT_GT(levels[2](10, 10).g, 0.98F);
    EXPECT_LT(last, 0.95F);
}

}  // namespace
}  // namespace rs::compositor
