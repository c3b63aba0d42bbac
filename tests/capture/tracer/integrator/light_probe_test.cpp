// Light probes against direct rendering in the same scene.

#include "capture/tracer/integrator/light_probe.hpp"

#include "tests/capture/tracer/test_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture::test {
namespace {

// Irradiance of a surface with normal `normal`.
glm::dvec3 irradiance_of(const Image<RgbaF>& map, const glm::dvec3& normal) {
    glm::dvec3 sum(0);
    const int width = map.width();
    for (int y = 0; y < map.height(); ++y) {
        const double step = kPi / map.height();
        const double angle = (std::cos(y * step) - std::cos((y + 1) * step)) * 2 * kPi / width;
        for (int x = 0; x < width; ++x) {
            const double facing = std::max(glm::dot(probe_direction(x + 0.5, y + 0.5, width), normal), 0.0);
            sum +=
                glm::dvec3(map(x, y).r, map(x, y).g, map(x, y).b) * (angle * facing * static_cast<double>(map(x, y).a));
        }
    }
    return sum;
}

TEST(LightProbe, HoldsEveryLightWithItsIrradiance) {
    Scene scene =
        scene_of(make_quad({-1, -50, 1}, {2, 0, 0}, {0, 0, -2}), material_of(SurfaceKind::diffuse, glm::vec3(0)));
    const auto measured = [&](const Light& light, const glm::dvec3& normal) {
        Scene lit = scene;
        lit.lights = {light};
        auto tracer = Tracer::create(std::move(lit));
        EXPECT_TRUE(tracer);
        return irradiance_of(light_probe(*tracer, {0, 0, 0}, {.width = 256, .samples_per_pixel = 16}), normal).g;
    };
    const glm::dvec3 aside = glm::normalize(glm::dvec3(1, 2, -3));
    EXPECT_NEAR(measured(point_light(4.0 * aside, glm::vec3(8)), aside), 0.5, 1e-3);
    EXPECT_NEAR(measured(directional_light(-aside, glm::vec3(3)), aside), 3, 3e-3);
    // A square of half width 1 at distance 2, seen from its axis: E = 4 L (a/sqrt(1+a^2) atan(a/sqrt(1+a^2))), a = 1/2.
    const double a = 0.5 / std::sqrt(1.25);
    EXPECT_NEAR(measured(rectangle_light({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, glm::vec3(1)), {0, 1, 0}),
                4 * a * std::atan(a), 0.02);
    // Occluded by a wall.
    EXPECT_EQ(measured(point_light({0, -60, 0}, glm::vec3(8)), {0, -1, 0}), 0);
}

// Against the projection of a fine map with the same lights.
TEST(LightProbe, IrradianceIsThatOfTheMap) {
    Scene scene =
        scene_of(make_quad({-4, -1, 4}, {8, 0, 0}, {0, 0, -8}), material_of(SurfaceKind::diffuse, {0.8F, 0.2F, 0.1F}));
    scene.lights = {rectangle_light({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, glm::vec3(2)),
                    point_light({3, 1, 0}, glm::vec3(4)), directional_light({0, -0.6, -0.8}, glm::vec3(1)),
                    point_light({0, -3, 0}, glm::vec3(90))};  // the last one below the floor
    scene.environment.pixels = Image<RgbaF>(4, 2, RgbaF{0.2F, 0.3F, 0.4F, 1});
    auto tracer = Tracer::create(std::move(scene));
    ASSERT_TRUE(tracer);
    Image<RgbaF> map = light_probe(*tracer, {0, 0, 0}, {.width = 128, .samples_per_pixel = 16});
    for (RgbaF& p : map.pixels()) p = {p.r * p.a, p.g * p.a, p.b * p.a, 1};
    const IrradianceHarmonics expected = project_irradiance(map);
    const IrradianceHarmonics found = trace_irradiance(*tracer, {0, 0, 0}, {.width = 16, .samples_per_pixel = 32});
    for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(found.at(n)[channel], expected.at(n)[channel], 0.04F * expected.at(n)[channel] + 0.01F);
        }
    }
    EXPECT_LT(direct_irradiance(*tracer, {0, 0, 0}).at({0, -1, 0}).r, 0.15F);  // no floor, no sky
}

// A room of 4 x 3 x 4 m with coloured walls and two lamps; a ball of 0.2 m in its centre, traced in the
// room and lit by the light probe at its position.
TEST(LightProbe, LightsAnObjectAsTheRoomDoes) {
    Scene room;
    const auto add_wall = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                              const glm::vec3& colour) {
        Mesh wall = make_quad(corner, u, v);
        wall.material = static_cast<int>(room.materials.size());
        room.materials.push_back(material_of(SurfaceKind::diffuse, colour));
        room.meshes.push_back(std::move(wall));
    };
    add_wall({-2, -1.5F, 2}, {4, 0, 0}, {0, 0, -4}, {0.4F, 0.3F, 0.2F});
    add_wall({-2, 1.5F, -2}, {4, 0, 0}, {0, 0, 4}, glm::vec3(0.8F));
    add_wall({-2, -1.5F, -2}, {4, 0, 0}, {0, 3, 0}, {0.7F, 0.7F, 0.6F});
    add_wall({2, -1.5F, 2}, {-4, 0, 0}, {0, 3, 0}, {0.7F, 0.7F, 0.6F});
    add_wall({-2, -1.5F, 2}, {0, 0, -4}, {0, 3, 0}, {0.7F, 0.1F, 0.1F});
    add_wall({2, -1.5F, -2}, {0, 0, 4}, {0, 3, 0}, {0.1F, 0.6F, 0.1F});
    room.lights.push_back(rectangle_light({-1.5, 1.4, -1}, {0.6, 0, 0}, {0, 0, 0.6}, glm::vec3(6)));
    room.lights.push_back(point_light({1.2, 1, 1.2}, glm::vec3(1.5F)));
    for (const SurfaceKind kind : {SurfaceKind::diffuse, SurfaceKind::glossy}) {
        Mesh ball = make_sphere(5);
        for (glm::vec3& p : ball.positions) p *= 0.2F;
        const Material skin = material_of(kind, glm::vec3(0.7F));
        auto empty = Tracer::create(Scene(room));
        ASSERT_TRUE(empty);
        Scene alone = scene_of(ball, skin);
        alone.environment.pixels = light_probe(*empty, {0, 0, 0}, {.width = 256, .samples_per_pixel = 64});
        Scene inside = room;
        ball.material = static_cast<int>(inside.materials.size());
        inside.materials.push_back(skin);
        inside.meshes.push_back(ball);
        const Camera camera = look_at_camera({0.3, 0.4, 1}, {0, 0, 0}, radians(18.0), 32, 32);
        RenderOptions options;
        options.samples_per_pixel = 256;
        const Image<Rgba8> in_room = to_srgb8(render(std::move(inside), camera, options).image);
        const Rendering by_itself = render(std::move(alone), camera, options);
        const Image<Rgba8> by_probe = to_srgb8(by_itself.image);
        double squares = 0;
        int count = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 32; ++x) {
                if (by_itself.image(x, y).a < 1) continue;
                for (const int d : {in_room(x, y).r - by_probe(x, y).r, in_room(x, y).g - by_probe(x, y).g,
                                    in_room(x, y).b - by_probe(x, y).b}) {
                    squares += d * d;
                    ++count;
                }
            }
        }
        ASSERT_GT(count, 900);
        const double psnr = 10 * std::log10(255.0 * 255.0 * count / squares);
        RecordProperty(kind == SurfaceKind::diffuse ? "diffuse_db" : "glossy_db", std::to_string(psnr));
        EXPECT_GT(psnr, 30) << (kind == SurfaceKind::diffuse ? "diffuse" : "glossy");
    }
}

}  // namespace
}  // namespace rs::capture::test
