// Directions of reflection and refraction.

#include "capture/tracer/integrator/microfacet.hpp"
#include "capture/tracer/light/environment_map.hpp"
#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rs::capture::test {
namespace {

// Every direction has a unique, slowly varying colour.
Environment compass_environment() {
    Environment environment;
    environment.pixels = Image<RgbaF>(256, 128);
    for (int y = 0; y < 128; ++y) {
        const double polar = kPi * (y + 0.5) / 128;
        for (int x = 0; x < 256; ++x) {
            const double phi = kPi * ((x + 0.5) / 128 - 1.0);
            environment.pixels(x, y) = {static_cast<float>(1.0 + std::sin(polar) * std::sin(phi)),
                                        static_cast<float>(1.0 + std::cos(polar)),
                                        static_cast<float>(1.0 - std::sin(polar) * std::cos(phi)), 1};
        }
    }
    return environment;
}

RenderOptions sharp(int samples) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.filter_radius_px = 1e-4F;
    return options;
}

TEST(Mirror, ReflectsWhereTheLawSays) {
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3F, 0.4F, 1.0F));
    const glm::vec3 across = glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
    const glm::vec3 along = glm::cross(normal, across);
    Scene scene = scene_of(make_quad(-across - along, 2.0F * across, 2.0F * along), material_of(SurfaceKind::mirror));
    scene.environment = compass_environment();
    const Camera camera = front_camera(3.0, 20.0, 16);
    const Rendering rendering = render(std::move(scene), camera, sharp(4));
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const glm::vec3 out = glm::reflect(glm::normalize(glm::vec3(camera.ray(x + 0.5, y + 0.5))), normal);
            const RgbaF& seen = rendering.image(x, y);
            ASSERT_EQ(seen.a, 1.0F);
            EXPECT_NEAR(seen.r, 1.0F + out.x, 2e-3F);
            EXPECT_NEAR(seen.g, 1.0F + out.y, 2e-3F);
            EXPECT_NEAR(seen.b, 1.0F + out.z, 2e-3F);  // the middle column is -Z
        }
    }
}

// A slab top >= z >= top - thickness that covers the camera's field of view.
void add_slab(Scene& scene, float thickness, int material, float top = 0.0F) {
    scene.meshes.push_back(make_quad({-50, -50, top}, {100, 0, 0}, {0, 100, 0}));
    scene.meshes.back().material = material;
    scene.meshes.push_back(make_quad({-50, -50, top - thickness}, {0, 100, 0}, {100, 0, 0}));
    scene.meshes.back().material = material;
}

TEST(Glass, SlabShiftsRaysAsSnellSays) {
    constexpr float kIor = 1.5F;
    constexpr float kThickness = 0.8F;
    Scene scene;
    Material glass = material_of(SurfaceKind::glass);
    glass.ior = kIor;
    Material lamp = material_of(SurfaceKind::diffuse, glm::vec3(0.0F));
    lamp.emission = glm::vec3(1.0F);
    scene.materials = {glass, lamp};
    add_slab(scene, kThickness, 0);
    scene.meshes.push_back(make_quad({0, -50, -1}, {50, 0, 0}, {0, 100, 0}));  // emissive where x > 0 on z = -1
    scene.meshes.back().material = 1;
    const Camera camera = look_at_camera({-2, 0.1, 2}, {0, 0, -1}, radians(20.0), 64, 8);
    const Rendering rendering = render(std::move(scene), camera, sharp(64));
    int lit = 0;
    int dark = 0;
    int moved_by_refraction = 0;
    for (int x = 0; x < 64; ++x) {
        const glm::dvec3 d = glm::normalize(camera.ray(x + 0.5, 4.5));
        const glm::dvec2 sideways(d.x, d.y);  // sine of the angle, with its direction
        const glm::dvec2 inside = sideways / static_cast<double>(kIor);
        const double cos_outside = -d.z;
        const double cos_inside = std::sqrt(1 - glm::dot(inside, inside));
        glm::dvec2 p(camera.centre());
        p += sideways / cos_outside * camera.centre().z;  // down to the slab
        p += inside / cos_inside * static_cast<double>(kThickness);
        p += sideways / cos_outside * (1.0 - static_cast<double>(kThickness));
        const double straight = camera.centre().x + sideways.x / cos_outside * (camera.centre().z + 1);
        if ((straight > 0) != (p.x > 0)) ++moved_by_refraction;
        if (std::abs(p.x) < 2e-3) continue;
        // Fresnel reflection dims lit pixels below 1; dark pixels are exactly 0.
        if (p.x > 0) {
            EXPECT_GT(rendering.image(x, 4).g, 0.7F) << x;
            ++lit;
        } else {
            EXPECT_LT(rendering.image(x, 4).g, 0.15F) << x;
            ++dark;
        }
    }
    EXPECT_GT(lit, 10);
    EXPECT_GT(dark, 10);
    EXPECT_GT(moved_by_refraction, 3) << "a straight ray would give the same image";
}

TEST(Glass, SlabReflectsAndPassesWhatFresnelSays) {
    Scene scene;
    Material glass = material_of(SurfaceKind::glass);
    scene.materials = {glass};
    add_slab(scene, 0.3F, 0);
    // Red light comes from in front of the slab, green from behind it.
    scene.environment.pixels = Image<RgbaF>(256, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 256; ++x) {
            const bool behind = x >= 64 && x < 192;  // the columns about -Z
            scene.environment.pixels(x, y) = {behind ? 0.0F : 1.0F, behind ? 1.0F : 0.0F, 0, 1};
        }
    }
    const Camera camera = look_at_camera({1.5, 0, 1.5}, {0, 0, 0}, radians(0.5), 16, 16);
    const glm::dvec3 mean = mean_radiance(render(std::move(scene), camera, sharp(256)).image);
    const double once = static_cast<double>(fresnel_dielectric(std::sqrt(0.5F), 1.5F));
    EXPECT_NEAR(once, 0.0502, 1e-3);  // tabulated: BK7-like glass at 45 degrees, unpolarised
    EXPECT_NEAR(mean.r, 2 * once / (1 + once), 0.003);
    EXPECT_NEAR(mean.g, (1 - once) / (1 + once), 0.003);
}

TEST(Glass, AbsorbsByTheLengthOfTheWay) {
    Scene scene;
    Material glass = material_of(SurfaceKind::glass, {0.5F, 0.25F, 1.0F});
    glass.ior = 1.0F;  // no reflection, no refraction: absorption only
    scene.materials = {glass};
    add_slab(scene, 2.0F, 0);
    scene.environment = constant_environment(1.0F);
    const glm::dvec3 mean = mean_radiance(render(std::move(scene), front_camera(3.0, 0.5, 8), sharp(1)).image);
    EXPECT_NEAR(mean.r, 0.25, 1e-3);
    EXPECT_NEAR(mean.g, 0.0625, 1e-3);
    EXPECT_NEAR(mean.b, 1.0, 1e-5);
}

// Slabs of index 1 for absorption without refraction: {top, thickness, transmittance per unit length}.
struct Slab {
    float top, thickness, through;
};
double transmitted_radiance(const std::vector<Slab>& slabs) {
    Scene scene;
    for (const Slab& slab : slabs) {
        add_slab(scene, slab.thickness, static_cast<int>(scene.materials.size()), slab.top);
        scene.materials.push_back(material_of(SurfaceKind::glass, glm::vec3(slab.through)));
        scene.materials.back().ior = 1.0F;
    }
    scene.environment = constant_environment(1.0F);
    return mean_radiance(render(std::move(scene), front_camera(9.0, 0.5, 8), sharp(1024)).image).g;
}

TEST(Glass, InsideOfGlassTheInnermostAbsorbs) {
    // Within the noise of Russian roulette.
    const auto expect_transmitted = [](const std::vector<Slab>& slabs, double expected) {
        EXPECT_NEAR(transmitted_radiance(slabs), expected, 0.03 * expected);
    };
    // One unit of the outer, one of the inner, one of the outer again.
    expect_transmitted({{0, 3, 0.5F}, {-1, 1, 0.25F}}, 0.5 * 0.25 * 0.5);
    // Overlapping: one unit of the first, two of the second.
    expect_transmitted({{0, 2, 0.5F}, {-1, 2, 0.25F}}, 0.5 * 0.25 * 0.25);
    // Four levels: each interface is crossed twice.
    expect_transmitted({{0, 7, 0.9F}, {-1, 5, 0.8F}, {-2, 3, 0.7F}, {-3, 1, 0.6F}},
                       0.9 * 0.9 * 0.8 * 0.8 * 0.7 * 0.7 * 0.6);
    // Five levels: the outermost medium is dropped.
    expect_transmitted({{0, 9, 0.5F}, {-1, 7, 0.9F}, {-2, 5, 0.8F}, {-3, 3, 0.7F}, {-4, 1, 0.6F}},
                       0.5 * 0.9 * 0.9 * 0.8 * 0.8 * 0.7 * 0.7 * 0.6);
}

TEST(Fresnel, KnownValues) {
    EXPECT_NEAR(fresnel_dielectric(1.0F, 1.5F), 0.04F, 1e-6F);
    EXPECT_NEAR(fresnel_dielectric(0.0F, 1.5F), 1.0F, 1e-5F);
    EXPECT_NEAR(fresnel_dielectric(0.7F, 1.0F), 0.0F, 1e-6F);
    // Total internal reflection beyond asin(1 / 1.5) = 41.8 degrees.
    EXPECT_EQ(fresnel_dielectric(std::cos(static_cast<float>(radians(42.0))), 1.0F / 1.5F), 1.0F);
    EXPECT_LT(fresnel_dielectric(std::cos(static_cast<float>(radians(41.0))), 1.0F / 1.5F), 1.0F);
}

}  // namespace
}  // namespace rs::capture::test
