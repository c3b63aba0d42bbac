// Cascades: plan, independence of the way walked, and shadows that a single map loses. The latter are skipped without
// OpenGL.

#include "compositor/viewer/shadows/shadow_plan.hpp"
#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/viewer/shadows/shadow_scene.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::compositor {
namespace {

using Cascades = test::GlTest;

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.5, -1, -0.3));  // direction of travel
constexpr double kKerbTop = 0.12;                                   // kerb: x < 0; its edge is the Z axis
constexpr double kPostHeight = 5;
constexpr glm::dvec3 kPost(3, 0, -30);

// A street of 200 m: ground, kerb, a thin post far from the eye at the origin.
Scene street() {
    Scene scene;
    scene.lights = {directional_light(kSun, glm::vec3(3))};
    scene.geometry = {test::matte_box({200, 1, 200}, {0, -0.5, 0}),
                      test::matte_box({2, kKerbTop, 150}, {-1, 0.5 * kKerbTop, -70}),
                      test::matte_box({0.12, kPostHeight, 0.12}, kPost + glm::dvec3(0, 0.5 * kPostHeight, 0))};
    return scene;
}

// The same with a single map for its sun.
Scene without_cascades(Scene scene) {
    scene.navigation.avatar.y = 1e6;
    return scene;
}

ShadowPlan plan_of(const Scene& scene) {
    return plan_shadows(scene, bounds_of_casters(scene));
}

// Position in clip coordinates of a cascade, or of the map of all casters, that the shader selects.
struct Selected {
    double texel = 0;  // scene units
    std::size_t face = 0;
    glm::dvec2 uv{0};  // by the rows of the shader
};
Selected selected_at(const ShadowPlan& plan, const glm::dvec3& p) {
    const LightShadow& shadow = plan.of_light[0];
    const glm::dvec2 whole(glm::dot(glm::dvec4(shadow.row_u), glm::dvec4(p, 1)),
                           glm::dot(glm::dvec4(shadow.row_v), glm::dvec4(p, 1)));
    const std::vector<glm::vec4> rows = plan.cascade_rows();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const glm::dvec4 row(rows[i]);
        const glm::dvec2 uv = glm::dvec2(row) + glm::dvec2(row.z, row.w) * whole;
        if (std::max(std::abs(uv.x - 0.5), std::abs(uv.y - 0.5)) >= 0.49) continue;
        return {shadow.layer_texel.y / std::max(row.z, row.w), plan.cascades[i].face, uv};
    }
    return {shadow.layer_texel.y, 0, whole};
}

TEST(CascadePlan, TexelsAreSmallInTheWholeFrustum) {
    ShadowPlan plan = plan_of(street());
    ASSERT_EQ(plan.cascades.size(), kCascades);
    const Camera camera = look_at_camera({4, 1.6, 20}, {-6, 1, -20}, radians(65), 1280, 720);
    plan.centre_cascades(camera.centre());
    std::vector<bool> used(plan.faces.size());
    for (double depth = 1.6; depth < 70; depth *= 1.1) {
        for (const double x : {0.0, 320.0, 640.0, 1280.0}) {
            for (const double y : {0.0, 360.0, 720.0}) {
                const glm::dvec3 p = camera.centre() + depth * camera.ray(x, y);
                const Selected at = selected_at(plan, p);
                EXPECT_LE(at.texel, kMaxTexel_rad * glm::distance(p, camera.centre())) << depth;
                const glm::dvec2 clip(plan.faces[at.face].clip_from_world * glm::dvec4(p, 1));
                EXPECT_LT(glm::distance(at.uv, 0.5 + 0.5 * glm::dvec2(clip.x, -clip.y)), 1e-4) << depth;
                used[at.face] = true;
            }
        }
    }
    EXPECT_TRUE(std::ranges::all_of(used, [](bool u) { return u; }));
}

TEST(CascadePlan, MovesByWholeTexels) {
    ShadowPlan plan = plan_of(street());
    plan.centre_cascades({4, 1.6, 20});
    const std::vector<ShadowFace> before = plan.faces;
    EXPECT_TRUE(plan.centre_cascades({4, 1.6, 20}).empty());
    int moves = 0;
    for (int i = 1; i <= 40; ++i) {
        moves += static_cast<int>(plan.centre_cascades(glm::dvec3(4 - 0.013 * i, 1.6, 20 - 0.05 * i)).size());
        for (std::size_t f = 0; f < plan.faces.size(); ++f) {
            const glm::dvec2 shift_px =
                0.5 * plan.plane_side * glm::dvec2(plan.faces[f].clip_from_world[3] - before[f].clip_from_world[3]);
            EXPECT_LT(glm::distance(shift_px, glm::round(shift_px)), 1e-6) << i;
        }
    }
    EXPECT_GT(moves, 1);
    EXPECT_LT(moves, 12);  // of 120: most frames reuse the maps
}

TEST(CascadePlan, AreForLargeScenesOnly) {
    EXPECT_TRUE(plan_of(test::boxes(directional_light(kSun, glm::vec3(3)))).cascades.empty());
    EXPECT_TRUE(plan_of(without_cascades(street())).cascades.empty());
    Scene suns = street();
    suns.lights.resize(kMaxPlaneShadows + 1, suns.lights[0]);
    const ShadowPlan plan = plan_of(suns);
    EXPECT_EQ(plan.cascades.size(), kCascades * kMaxCascadedLights);
    EXPECT_EQ(plan.plane_layers, kMaxPlaneShadows + kCascades * kMaxCascadedLights);
}

// Point of the ground that a point's shadow falls on.
glm::dvec3 shadow_of(const glm::dvec3& p) {
    return p - kSun * (p.y / kSun.y);
}

// Share of the pixels on the middle line of a thin far post's shadow that are dark.
double dark_share_of_post(const Scene& scene) {
    const glm::dvec3 tip = shadow_of(kPost + glm::dvec3(0, kPostHeight, 0));
    const Camera camera = look_at_camera({0, 8, 0}, 0.5 * (kPost + tip), radians(10), 960, 540);
    const Image<float> shadowed = test::red_of(test::raster_image(scene, {}, camera, true));
    const Image<float> open = test::red_of(test::raster_image(scene, {}, camera, false));
    int dark = 0;
    int all = 0;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
            const glm::dvec3 from_post = camera.centre() - ray * (camera.centre().y / ray.y) - kPost;
            const double along = glm::dot(from_post, tip - kPost) / glm::dot(tip - kPost, tip - kPost);
            if (along < 0.2 || along > 0.9 || glm::length(from_post - along * (tip - kPost)) > 0.02) continue;
            ++all;
            dark += shadowed(x, y) < 0.5F * open(x, y) ? 1 : 0;
        }
    }
    RS_CHECK(all > 30);
    return static_cast<double>(dark) / all;
}

TEST_F(Cascades, AThinFarPostKeepsItsShadow) {
    EXPECT_GT(dark_share_of_post(street()), 0.97);
    EXPECT_LT(dark_share_of_post(without_cascades(street())), 0.9);
}

// Largest distance of the shadow's edge from its true place beside a kerb near the eye, in rows of pixels.
double kerb_error_px(const Scene& scene) {
    const Camera camera = look_at_camera({2.5, 1.6, 0}, {0, 0, -3}, radians(60), 960, 540);
    const Image<float> open = test::red_of(test::raster_image(scene, {}, camera, false));
    const Image<float> shadowed = test::red_of(test::raster_image(scene, {}, camera, true));
    double worst = 0;
    for (double z = -1.5; z > -5; z -= 0.02) {
        const glm::dvec3 at = camera.project(shadow_of({0, kKerbTop, z}));
        const auto x = static_cast<int>(at.x);
        // Below the edge the road is lit, above it is dark.
        int y = static_cast<int>(at.y) + 6;
        while (y > 0 && shadowed(x, y) > 0.5F * open(x, y)) --y;
        const glm::dvec3 next = camera.project(shadow_of({0, kKerbTop, z - 0.01}));
        const double slope = (next.y - at.y) / (next.x - at.x);
        const double edge = at.y + slope * (x + 0.5 - at.x);
        // Sampling leaves the edge open between the centres of rows y and y + 1.
        worst = std::max(worst, std::abs(y + 1 - edge) - 0.5);
    }
    return worst;
}

TEST_F(Cascades, TheShadowOfANearKerbIsStraight) {
    EXPECT_LE(kerb_error_px(street()), 1.0);
    EXPECT_GT(kerb_error_px(without_cascades(street())), 2.0);
}

// Frames depend on the viewpoint, not on earlier ones, also when geometry moves.
TEST_F(Cascades, AreThoseOfMapsDrawnWhole) {
    Scene scene = street();
    scene.geometry.push_back(test::matte_box({1.8, 1.4, 4}, {1.5, 0.7, -6}));
    scene.geometry.back().moving = 3;
    scene.floor = Floor{.height = 0.001, .radius = 8};
    const auto make = [&] {
        auto frames = FrameCompositor::create(scene, std::vector<PlacedObject>{},
                                              {.width = 160, .height = 90, .samples = 1, .shadows = true});
        RS_CHECK(frames.ok());
        return std::move(*frames);
    };
    FrameCompositor walked = make();
    int reused = 0;
    for (int i = 0; i < 8; ++i) {
        const Camera camera = look_at_camera({2.5, 1.6, 0.2 * i}, {0, 0, -3}, radians(60), 160, 90);
        glm::dmat4 place = scene.geometry.back().world_from_node;
        place[3].z -= i / 2 * 0.7;
        FrameCompositor fresh = make();
        for (FrameCompositor* frames : {&walked, &fresh}) {
            ASSERT_TRUE(frames->move_geometry(3, place));
            ASSERT_TRUE(frames->draw(camera));
        }
        EXPECT_TRUE(std::ranges::equal(walked.image().pixels(), fresh.image().pixels())) << i;
        reused += walked.statistics().shadow_maps_drawn < fresh.statistics().shadow_maps_drawn ? 1 : 0;
    }
    EXPECT_GT(reused, 2);
}

}  // namespace
}  // namespace rs::compositor
