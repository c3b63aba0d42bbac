// White furnace test: in uniform illumination a surface without absorption is invisible.

#include "capture/tracer/integrator/microfacet.hpp"
#include "capture/tracer/scene/scene_transform.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace rs::capture::test {
namespace {

double furnace_mean(Mesh mesh, const Material& material, int samples = 64) {
    Scene scene = scene_of(std::move(mesh), material);
    scene.environment = constant_environment(1.0F);
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.max_bounces = 24;
    return mean_radiance(render(std::move(scene), front_camera(3.5, 36.0, 48), options).image).g;
}

TEST(Furnace, DiffuseReflectsAll) {
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::diffuse)), 1.0, 0.005);
}

TEST(Furnace, TranslucentPassesWhatItDoesNotReflect) {
    Material petal = material_of(SurfaceKind::diffuse);
    petal.translucency = 0.4F;
    EXPECT_NEAR(furnace_mean(make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), petal), 1.0, 0.005);
}

TEST(Furnace, MirrorReflectsAll) {
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::mirror)), 1.0, 0.005);
}

TEST(Furnace, GlassLosesNothing) {
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::glass)), 1.0, 0.005);
}

TEST(Furnace, CoarseSmoothSphereLosesLittle) {
    // 320 triangles: interpolated normals and facets disagree by up to 9 degrees.
    EXPECT_NEAR(furnace_mean(make_sphere(2), material_of(SurfaceKind::diffuse)), 1.0, 0.01);
    EXPECT_NEAR(furnace_mean(make_sphere(2), material_of(SurfaceKind::mirror)), 1.0, 0.005);
    EXPECT_NEAR(furnace_mean(make_sphere(2), material_of(SurfaceKind::glass)), 1.0, 0.005);
}

TEST(Furnace, HalfReflectingSurfaceReflectsHalf) {
    // Convex, so that there are no interreflections.
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::diffuse, glm::vec3(0.5F))), 0.5, 0.0025);
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::mirror, glm::vec3(0.5F))), 0.5, 0.0025);
}

// The camera is outside a room with emissive one-sided walls; only the interior is visible.
TEST(Furnace, CamerasSeeThroughRooms) {
    Scene object, room;
    object.materials = {material_of(SurfaceKind::diffuse)};
    object.meshes = {make_sphere(4)};
    room.materials = {material_of(SurfaceKind::diffuse, glm::vec3(0.0F))};
    room.materials[0].emission = glm::vec3(1.0F);
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0), v(0), corner(-2);
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 4;
        room.meshes.push_back(make_quad(corner, u, v));
        corner[axis] = 2;
        room.meshes.push_back(make_quad(corner, u, v));
    }
    Scene within = object;
    add_surroundings(within, std::move(room), glm::dmat4(1));
    RenderOptions options;
    options.samples_per_pixel = 64;
    options.depth = true;
    const Camera camera = front_camera(3.5, 36.0, 48);
    const Rendering alone = render(std::move(object), camera, options);
    const Rendering lit = render(std::move(within), camera, options);
    EXPECT_NEAR(mean_radiance(lit.image).g, 1.0, 0.005);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x) {
            ASSERT_EQ(lit.image(x, y).a, alone.image(x, y).a) << x << " " << y;
            ASSERT_NEAR(lit.depth(x, y), alone.depth(x, y), 1e-5F) << x << " " << y;
        }
    }
}

class RoughFurnace : public testing::TestWithParam<float> {};

TEST_P(RoughFurnace, CoatOverWhiteReflectsAll) {
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::glossy, glm::vec3(1.0F), GetParam())), 1.0,
                0.005);
}

TEST_P(RoughFurnace, WhiteMetalReflectsAll) {
    EXPECT_NEAR(furnace_mean(make_sphere(5), material_of(SurfaceKind::metal, glm::vec3(1.0F), GetParam())), 1.0, 0.005);
}

TEST(AlbedoTable, SingleScatteringAloneWouldLoseEnergy) {
    // Energy loss of single scattering: more than half for a rough conductor, none for a smooth one, increasing with
    // roughness.
    EXPECT_NEAR(AlbedoTable::conductor(kMinAlpha).mean(), 1.0F, 1e-3F);
    EXPECT_NEAR(AlbedoTable::conductor(1.0F).mean(), 0.41F, 0.02F);
    float last = 1.1F;
    for (const float roughness : {0.1F, 0.25F, 0.5F, 0.75F, 1.0F}) {
        const float mean = AlbedoTable::conductor(roughness * roughness).mean();
        EXPECT_LT(mean, last);
        last = mean;
    }
    // Smooth coat: the diffuse Fresnel reflectance of index 1.5, 0.092 (Duntley's value).
    EXPECT_NEAR(AlbedoTable::dielectric(kMinAlpha, 1.5F).mean(), 0.092F, 0.002F);
}

TEST_P(RoughFurnace, ColouredSurfacesNeverGainEnergy) {
    for (const SurfaceKind kind : {SurfaceKind::glossy, SurfaceKind::metal}) {
        for (const float angle_deg : {0.0F, 50.0F, 80.0F}) {
            // A tilted quad: nearly the same viewing angle for all pixels.
            const float t = static_cast<float>(radians(static_cast<double>(angle_deg)));
            const glm::vec3 across(2.0F * std::cos(t), 0.0F, 2.0F * std::sin(t));
            const Mesh quad = make_quad(-0.5F * across - glm::vec3(0, 1, 0), across, {0, 2, 0});
            const double mean = furnace_mean(quad, material_of(kind, glm::vec3(0.9F), GetParam()), 32);
            EXPECT_LE(mean, 1.003) << "at " << angle_deg << " degrees";
            EXPECT_GE(mean, kind == SurfaceKind::glossy ? 0.897 : 0.82) << "at " << angle_deg << " degrees";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Roughness, RoughFurnace, testing::Values(0.1F, 0.25F, 0.5F, 0.75F, 1.0F));

}  // namespace
}  // namespace rs::capture::test
