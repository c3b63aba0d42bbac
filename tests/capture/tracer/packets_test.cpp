// Rays in packets beside single rays: the same bits, on what stands still, moves, has holes, mirrors and refracts.

#include "capture/tracer/integrator/whitted.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <limits>

namespace rs::capture::test {
namespace {

Scene scene_of_all_kinds() {
    Scene scene;
    Texture holes;
    holes.pixels = Image<RgbaF>(4, 4, {0.9F, 0.8F, 0.3F, 1});
    for (int i = 0; i < 4; ++i) holes.pixels(i, i).a = 0;
    scene.textures = {holes};
    scene.materials = {material_of(SurfaceKind::diffuse, glm::vec3(0.7F)),
                       material_of(SurfaceKind::glossy, {0.6F, 0.2F, 0.1F}), material_of(SurfaceKind::mirror),
                       material_of(SurfaceKind::glass), material_of(SurfaceKind::metal, {0.8F, 0.6F, 0.2F})};
    scene.materials[0].texture = 0;
    scene.meshes = {make_quad({-4, -1, 4}, {8, 0, 0}, {0, 0, -8}), make_quad({-4, -1, -4}, {8, 0, 0}, {0, 5, 0})};
    scene.meshes[1].material = 2;
    Mesh ball = make_sphere(3);
    for (int kind = 1; kind < 5; ++kind) {
        ball.material = kind;
        scene.parts.push_back({"ball", {ball}});
        const glm::dmat4 at = glm::translate(glm::dmat4(1), {1.3 * kind - 3.2, 0.1 * kind, 0.4 * kind});
        scene.instances.push_back({scene.parts.size() - 1, at * glm::scale(glm::dmat4(1), {0.6, 0.8, 0.7})});
        if (kind % 2 == 0) scene.instances.back().at_close = glm::translate(glm::dmat4(1), {0.2, 0.1, 0}) * at;
    }
    scene.lights = {point_light({2, 5, 4}, glm::vec3(40)), directional_light({1, -2, -1}, glm::vec3(1)),
                    rectangle_light({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, glm::vec3(3))};
    return scene;
}

void expect_the_bits_of_single_rays(const Scene& scene) {
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    rs::test::Random random(3);
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    std::vector<RayScene::Ray> asked;
    for (int i = 0; i < 4013; ++i) {  // not a number of whole packets
        const glm::vec3 from(number(-3, 3), number(0, 3), number(2, 6));
        const glm::vec3 at(number(-3, 3), number(-1, 1), number(-3, 3));
        asked.push_back({from, glm::normalize(at - from), number(0, 1), std::numeric_limits<float>::infinity()});
    }
    std::vector<RayScene::Hit> hits(asked.size());
    rays->intersect_many(asked, hits);
    int met = 0, moving = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const RayScene::Ray& ray = asked[i];
        SurfacePoint single{}, many{};
        ASSERT_EQ(rays->intersect(ray.origin, ray.direction, ray.time, single), hits[i].met()) << i;
        if (!hits[i].met()) continue;
        ++met;
        moving += hits[i].instance != ~0U;
        rays->surface_at(hits[i], ray.direction, ray.time, many);
        ASSERT_EQ(single.distance, many.distance) << i;
        ASSERT_EQ(single.position, many.position) << i;
        ASSERT_EQ(single.shading_normal, many.shading_normal) << i;
        ASSERT_EQ(single.uv, many.uv) << i;
        ASSERT_EQ(single.material, many.material) << i;
    }
    EXPECT_GT(met, 2000);
    EXPECT_GT(moving, 400);
    for (RayScene::Ray& ray : asked) ray.reach = number(1, 9);
    std::vector<std::uint8_t> hidden(asked.size());
    rays->occluded_many(asked, hidden);
    int in_the_way = 0;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const RayScene::Ray& ray = asked[i];
        ASSERT_EQ(rays->occluded(ray.origin, ray.direction, ray.reach, ray.time), hidden[i] != 0) << i;
        in_the_way += hidden[i];
    }
    EXPECT_GT(in_the_way, 500);
    rays->intersect_many({}, {});
}

TEST(Packets, GiveTheBitsOfSingleRays) {
    Scene scene = scene_of_all_kinds();
    expect_the_bits_of_single_rays(scene);
    for (Instance& instance : scene.instances) instance.at_close.reset();
    expect_the_bits_of_single_rays(scene);
}

// Neighbours that go to one lamp, which kept Embree busy for ever where all that stands in the way are instances.
TEST(Packets, OfNeighboursComeBackFromInstances) {
    Scene scene = scene_of_all_kinds();
    for (Instance& instance : scene.instances) instance.at_close.reset();
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    std::vector<RayScene::Ray> asked;
    for (int i = 0; i < 4096; ++i) {
        const glm::vec3 from(-3.0F + 0.1F * static_cast<float>(i % 64), -0.999F,
                             -3.0F + 0.1F * static_cast<float>(i / 64));
        const glm::vec3 way = glm::vec3(1, 3, 1) - from;
        asked.push_back({from, glm::normalize(way), 0, glm::length(way)});
    }
    std::vector<std::uint8_t> hidden(asked.size());
    rays->occluded_many(asked, hidden);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const RayScene::Ray& ray = asked[i];
        ASSERT_EQ(rays->occluded(ray.origin, ray.direction, ray.reach, ray.time), hidden[i] != 0) << i;
    }
}

TEST(Packets, OfWhittedGiveTheBitsOfSingleRays) {
    const Scene scene = scene_of_all_kinds();
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    const LightSet lights(scene, constant_environment(0.3F), {glm::vec3(0), 6.0F});
    const auto models = make_surface_models(scene.materials);
    const LightTransport transport(scene, *rays, lights, models, {true, true});
    const WhittedTracer tracer(transport, IrradianceMap(lights.environment()), glm::vec3(0.1F), 8);
    const Camera camera = look_at_camera({0.3, 1.2, 6}, {0, 0, 0}, radians(60), 61, 47);
    std::vector<CameraRay> many;
    for (int y = 0; y < 47; ++y) {
        for (int x = 0; x < 61; ++x) {
            Sampler sampler(mix_bits(static_cast<std::uint64_t>(y * 61 + x)), 0);
            const float time = sampler.next_2d().x;
            many.push_back(
                {glm::vec3(camera.centre()), glm::vec3(glm::normalize(camera.ray(x + 0.5, y + 0.5))), time, sampler});
        }
    }
    std::vector<Arrived> arrived(many.size());
    tracer.trace_many(many, arrived);
    double sum = 0;
    for (std::size_t i = 0; i < many.size(); ++i) {
        glm::vec3 radiance;
        Sampler sampler = many[i].sampler;
        ASSERT_EQ(tracer.trace(many[i].origin, many[i].direction, many[i].time, sampler, radiance), arrived[i].met);
        ASSERT_EQ(radiance, arrived[i].radiance) << i;
        sum += static_cast<double>(radiance.g);
    }
    EXPECT_GT(sum, 100);
}

}  // namespace
}  // namespace rs::capture::test
