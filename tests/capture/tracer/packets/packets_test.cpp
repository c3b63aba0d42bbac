// Packets against single rays: bit-identical for static and moving objects, holes, mirrors and glass.

#include "capture/tracer/integrator/gather_packet.hpp"
#include "capture/tracer/integrator/whitted.hpp"
#include "tests/capture/tracer/test_shapes.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

void expect_equal_to_single_rays(const Scene& scene) {
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    rs::test::Random random(3);
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    std::vector<RayScene::Ray> asked;
    for (int i = 0; i < 4013; ++i) {  // not a multiple of the packet size
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
    expect_equal_to_single_rays(scene);
    for (Instance& instance : scene.instances) instance.at_close.reset();
    expect_equal_to_single_rays(scene);
}

TEST(Packets, InactiveLanesMayContainNan) {
    const Scene scene = scene_of_all_kinds();
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::size_t kLane = 3;
    MaskLanes active;
    active[kLane] = -1;
    RayHitLanes hits;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        hits.begin(lane, glm::vec3(kNan), glm::vec3(kNan), 0);
        hits.ray.reach[lane] = kNan;
    }
    hits.begin(kLane, {0.3F, 1.2F, 6}, {0, -0.2F, -0.9798F}, 0);
    RayLanes shadow = hits.ray;
    rays->intersect(active, hits);
    EXPECT_TRUE(hits.has_hit(kLane));
    rays->occluded(active, shadow);
    EXPECT_LT(shadow.reach[kLane], 0);
}

// Coherent shadow rays to one lamp, for which Embree did not return with instances as the only occluders.
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

// An emissive ball without a mesh.
class ShiningBall final : public RayPrimitive {
public:
    [[nodiscard]] Box bounds() const override { return {kMiddle - kRadius, kMiddle + kRadius}; }
    [[nodiscard]] std::optional<Answer> answer(const glm::vec3& origin, const glm::vec3& direction) const override {
        const glm::vec3 way = origin - kMiddle;
        const float b = glm::dot(way, direction), root = b * b - glm::dot(way, way) + kRadius * kRadius;
        if (root < 0.0F || -b - std::sqrt(root) <= 0.0F) return std::nullopt;
        return Answer{-b - std::sqrt(root), {0.5F, 0.2F, 0.9F}};
    }

private:
    static constexpr glm::vec3 kMiddle{0.6F, 0.4F, 2.2F};
    static constexpr float kRadius = 0.4F;
};

// All surface kinds with normal maps, clamped textures, vertex colours, translucency, one-sided and emissive surfaces,
// a mirrored part, and every kind of light.
Scene scene_of_all_details() {
    Scene scene = scene_of_all_kinds();
    Texture stripes;
    stripes.pixels = Image<RgbaF>(5, 3, {0.2F, 0.5F, 0.9F, 1});
    for (int x = 0; x < 5; ++x) stripes.pixels(x, x % 3) = {0.9F, 0.4F, 0.1F, 1};
    stripes.repeat_u = false;
    scene.textures.push_back(stripes);
    Texture bumps;
    bumps.pixels = Image<RgbaF>(4, 4, {0.3F, -0.2F, 1, 1});
    bumps.pixels(1, 2) = {0, 0, 1, 1};
    scene.reliefs.push_back(bumps);
    const auto add = [&](Mesh mesh, Material material, glm::vec3 place) {
        mesh.material = static_cast<int>(scene.materials.size());
        for (glm::vec3& p : mesh.positions) p = 0.45F * p + place;
        scene.materials.push_back(material);
        scene.meshes.push_back(std::move(mesh));
    };
    Mesh card = make_quad({-1, -1, 0}, {2, 0, 0.4F}, {0, 2, 0});
    Material material = material_of(SurfaceKind::diffuse, {0.8F, 0.7F, 0.6F});
    material.texture = 1;
    material.relief = 0;
    add(card, material, {-2.4F, 1.2F, 2});
    material = material_of(SurfaceKind::diffuse, {0.3F, 0.9F, 0.4F});
    material.translucency = 0.4F;
    card.colours = {{1, 0.5F, 0.2F}, {0.3F, 1, 1}, {1, 1, 0.1F}, {0.6F, 0.2F, 1}};
    add(card, material, {-1.2F, 1.2F, 2});
    material = material_of(SurfaceKind::glossy, glm::vec3(0.7F), 0.05F);
    material.two_sided = false;
    add(card, material, {0, 1.2F, 2});
    for (glm::uvec3& t : card.triangles) std::swap(t.x, t.y);
    add(card, material, {1.2F, 1.2F, 2});
    material = material_of(SurfaceKind::glossy, glm::vec3(0.4F), 0.9F);
    material.emission = {0.4F, 0.3F, 0.1F};
    material.emission_texture = 1;
    add(card, material, {2.4F, 1.2F, 2});
    material = material_of(SurfaceKind::diffuse, {0.9F, 0.3F, 0.3F});
    material.translucency = 0.6F;
    add(make_sphere(1), material, {-1.2F, -0.1F, 3.2F});  // coarse: its rim has normals that face away
    material = material_of(SurfaceKind::glossy, glm::vec3(0.6F), 0.2F);
    material.two_sided = false;
    Mesh ball = make_sphere(2);
    ball.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(material);
    scene.parts.push_back({"mirrored", {ball}});
    scene.instances.push_back({scene.parts.size() - 1, glm::translate(glm::dmat4(1), {1.4, -0.2, 3.2}) *
                                                           glm::scale(glm::dmat4(1), {-0.4, 0.5, 0.4})});

    Light spot = point_light({-2, 4, 3}, glm::vec3(60));
    spot.kind = LightKind::kSpot;
    spot.towards = glm::normalize(glm::dvec3(1, -2, -1));
    spot.cut_off_rad = 0.7;
    spot.beam_width_rad = 0.3;
    Light lamp = point_light({1, 2.5, 3}, glm::vec3(1));
    lamp.attenuation = {1, 0.2F, 0.1F};
    lamp.least_attenuation = 1;
    lamp.radius = 4;
    Light disc = rectangle_light({2, 3, 1}, {1, 0, 0}, {0, 0, 1}, {2, 1, 3});
    disc.kind = LightKind::kDisc;
    Light luminaire = point_light({-1, 3, 2}, glm::vec3(1));
    luminaire.kind = LightKind::kLuminaire;
    auto read = parse_ies(
        "TILT=NONE\n1 -1 100 3 5 1 2 0 0 0 1 1 9\n0 45 90\n0 90 180 270 360\n"
        "100 80 10 100 120 30 100 40 5 100 60 20 100 80 10\n",
        "test.ies");
    EXPECT_TRUE(read);
    luminaire.luminaire = std::make_shared<const Luminaire>(std::move(read).value());
    scene.lights.insert(scene.lights.end(), {spot, lamp, disc, luminaire});
    scene.primitives.push_back(std::make_shared<const ShiningBall>());
    return scene;
}

void expect_whitted_packets_equal_single_rays(const Scene& scene, float environment, CameraVisibility visibility,
                                              bool soft_shadows) {
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    const LightSet lights(scene, environment > 0 ? constant_environment(environment) : Environment{},
                          {glm::vec3(0), 6.0F});
    const auto models = make_surface_models(scene.materials);
    const LightTransport transport(scene, *rays, lights, models, visibility);
    const WhittedTracer tracer(transport, IrradianceMap(lights.environment()), glm::vec3(0.1F), 8, soft_shadows);
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
    std::vector<RadianceSample> single(many.size());
    std::vector<int> met(scene.materials.size());
    double sum = 0;
    for (std::size_t i = 0; i < many.size(); ++i) {
        Sampler sampler = many[i].sampler;
        single[i].hit = tracer.trace(many[i].origin, many[i].direction, many[i].time, sampler, single[i].radiance);
        sum += static_cast<double>(single[i].radiance.g);
        SurfacePoint point{};
        if (rays->intersect(many[i].origin, many[i].direction, many[i].time, point)) {
            ++met[static_cast<std::size_t>(point.material)];
        }
    }
    EXPECT_GT(sum, 100);
    for (std::size_t i = 0; i < met.size(); ++i) EXPECT_GT(met[i], 20) << "material " << i;
    // Full, partial and empty packets.
    for (const std::size_t at_once : {many.size(), std::size_t{256}, std::size_t{1}, std::size_t{15}, std::size_t{17},
                                      std::size_t{65}, std::size_t{0}}) {
        std::vector<CameraRay> asked = many;
        std::vector<RadianceSample> samples(many.size());
        for (std::size_t i = 0; i < many.size(); i += std::max<std::size_t>(at_once, 1)) {
            const std::size_t count = std::min(at_once, many.size() - i);
            tracer.trace_many(std::span(asked).subspan(i, count), std::span(samples).subspan(i, count));
            if (at_once == 0) break;
        }
        for (std::size_t i = 0; i < many.size() && at_once > 0; ++i) {
            ASSERT_EQ(single[i].hit, samples[i].hit) << i << ", " << at_once << " at once";
            ASSERT_EQ(single[i].radiance, samples[i].radiance) << i << ", " << at_once << " at once";
        }
    }
}

// Some meshes are lit by two scoped lights, of which one casts no shadows.
Scene scene_of_scoped_lights() {
    Scene scene = scene_of_all_details();
    const auto first = static_cast<std::uint32_t>(scene.lights.size());
    scene.lights.push_back(directional_light({1, -2, -1}, glm::vec3(1, 2, 3)));
    scene.lights.push_back(point_light({1, 2, 2}, glm::vec3(4, 2, 1)));
    scene.lights[first].everywhere = scene.lights[first + 1].everywhere = false;
    scene.lights[first + 1].casts_shadows = false;
    scene.scopes.groups = {{}, {{first, first + 1}, glm::vec3(0.1F, 0.2F, 0)}, {{first}}};
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) scene.scopes.of_mesh.push_back(i % 3);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) scene.scopes.of_instance.push_back((i + 1) % 3);
    return scene;
}

TEST(Packets, OfWhittedGiveTheBitsOfSingleRays) {
    for (const Scene& scene : {scene_of_all_kinds(), scene_of_all_details(), scene_of_scoped_lights()}) {
        for (const bool soft_shadows : {false, true}) {
            expect_whitted_packets_equal_single_rays(scene, 0.3F, {true, true}, soft_shadows);
            expect_whitted_packets_equal_single_rays(scene, 0, {}, soft_shadows);
        }
    }
}

// BSDF value, without a cosine, for light from the surface's viewer direction scattered to `out`.
glm::vec3 bsdf_value(const LightTransport& transport, const LightTransport::Vertex& from, const glm::vec3& out) {
    const SurfaceModel& model = transport.model_of(from.point);
    const glm::vec3& colour = from.surface.colour();
    if (model.kind == SurfaceKind::diffuse) {
        return colour * ((out.z > 0.0F ? 1.0F - model.translucency : model.translucency) / kPiF);
    }
    if (out.z <= 0.0F) return glm::vec3(0.0F);
    const glm::vec3& viewer = from.surface.viewer();
    return Surface(model, colour, out, false).evaluate(viewer).f_cos / std::max(viewer.z, 1e-4F);
}

// Scalar counterpart of light_from_virtual() for one vertex.
std::optional<LightSample> light_from(const LightTransport& transport, const LightTransport::Vertex& from,
                                      const glm::vec3& flux, float bound, const LightTransport::Vertex& to) {
    const glm::vec3 facet = from.point.geometric_normal;
    glm::vec3 place = to.ray_origin(to.point.geometric_normal, true);
    if (to.thin && !(glm::dot(from.point.position - place, to.point.geometric_normal) > 0.0F)) {
        place = to.ray_origin(-to.point.geometric_normal, false);
    }
    glm::vec3 target = from.ray_origin(facet, true);
    if (from.thin) {
        const float side = glm::dot(place - from.point.position, facet);
        target = from.point.position + facet * std::copysign(from.step_off, side);
    }
    const glm::vec3 way = target - place;
    const float distance2 = glm::dot(way, way);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = way / distance;
    const float cos_facet = glm::dot(facet, -direction), cosine = glm::dot(direction, to.frame.normal);
    if (!from.thin && !(cos_facet > 0.0F)) return std::nullopt;
    if (!to.thin && !(cosine > 0.0F)) return std::nullopt;
    float geometry = std::abs(cos_facet) / distance2;
    const float with_cosine = geometry * std::abs(cosine);
    if (with_cosine > bound) geometry *= bound / with_cosine;
    const glm::vec3 radiance = bsdf_value(transport, from, from.frame.to_local(-direction)) * flux * geometry;
    if (!(max_component(radiance) > 0.0F)) return std::nullopt;
    return LightSample{direction, distance, radiance, 1.0F, true};
}

void expect_virtual_lights_equal_scalar_code(const Scene& scene) {
    const auto rays = RayScene::create(scene);
    ASSERT_TRUE(rays);
    const LightSet lights(scene, {}, {glm::vec3(0), 6.0F});
    const auto models = make_surface_models(scene.materials);
    const LightTransport transport(scene, *rays, lights, models);
    const PacketMaterials materials(scene, models);
    rs::test::Random random(9);
    const auto number = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
    std::vector<LightTransport::Vertex> vertices;
    while (vertices.size() < 400) {
        const glm::vec3 from(number(-3, 3), number(0, 3), number(2, 6));
        const glm::vec3 at(number(-3, 3), number(-1, 1), number(-3, 3));
        SurfacePoint point;
        if (!rays->intersect(from, glm::normalize(at - from), 0.0F, point)) continue;
        const LightTransport::Vertex vertex = transport.vertex_at(point, glm::normalize(at - from));
        if (!vertex.surface.is_specular()) vertices.push_back(vertex);
    }
    const glm::vec3 flux(0.9F, 0.5F, 0.3F);
    constexpr float kBound = 0.2F;
    int lit = 0, dark = 0, bounded = 0;
    for (std::size_t first = 0; first < vertices.size(); first += kLanes) {
        GatherPacket packet;
        for (std::size_t lane = 0; lane < kLanes; ++lane) packet.set(lane, vertices[first + lane], materials);
        packet.lit[3] = 0;
        for (std::size_t from = 0; from < vertices.size(); from += 3) {
            LightLanes arrives;
            const VirtualLight light = materials.make_virtual_light(vertices[from], flux, 1);
            const bool some =
                light_from_virtual(light, kBound, materials.tables(), packet.surfaces, packet.lit, arrives);
            bool some_expected = false;
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(first + lane));
                const auto twin = light_from(transport, vertices[from], flux, kBound, vertices[first + lane]);
                const bool expected = twin && lane != 3;
                ASSERT_EQ(expected, arrives.lit[lane] != 0);
                ++(expected ? lit : dark);
                some_expected = some_expected || expected;
                if (!expected) continue;
                ASSERT_EQ(twin->direction, arrives.direction.at(lane));
                ASSERT_EQ(twin->distance, arrives.distance[lane]);
                ASSERT_EQ(twin->radiance, arrives.radiance.at(lane));
                bounded += twin->radiance !=
                           light_from(transport, vertices[from], flux, 1e9F, vertices[first + lane])->radiance;
            }
            ASSERT_EQ(some, some_expected);
        }
    }
    EXPECT_GT(lit, 5000);
    EXPECT_GT(dark, 5000);
    EXPECT_GT(bounded, 500);
}

TEST(Packets, OfVirtualLightsGiveTheBitsOfTheirTwin) {
    expect_virtual_lights_equal_scalar_code(scene_of_all_details());
}

TEST(Packets, GiveTheSameBitsOnEveryTarget) {
    const Scene scene = scene_of_all_details();
    std::int64_t targets = hwy::SupportedTargets();
    int tried = 0;
    for (; targets != 0; ++tried) {
        const std::int64_t target = targets & -targets;
        targets &= targets - 1;
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        expect_whitted_packets_equal_single_rays(scene, 0.3F, {true, true}, false);
        expect_virtual_lights_equal_scalar_code(scene);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GT(tried, 0);
}

}  // namespace
}  // namespace rs::capture::test
