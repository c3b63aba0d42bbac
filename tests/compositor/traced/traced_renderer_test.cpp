// Traced rooms, against formulas and for consistency.

#include "compositor/traced/tracer_scene.hpp"
#include "tests/compositor/traced/small_room.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <optional>

namespace rs::compositor {
namespace {

TEST(TracerScene, LightsShineAsTheRasterFormulaHasThem) {
    // A white diffuse surface has radiance colour * attenuation * cos per punctual light, plus interreflection, which a
    // single wall does not have.
    Scene scene;
    scene.geometry = {box_node({40, 0.2, 40}, {0, -0.1, 0}, glm::vec3(0.5F))};
    Light vrml;  // attenuation of VRML97
    vrml.kind = LightKind::kPoint;
    vrml.location = {0, 2, 0};
    vrml.colour = {0.8F, 0.4F, 0.2F};
    vrml.attenuation = {0, 0.5F, 0.25F};
    for (const double out : {0.0, 1.0, 3.0}) {
        scene.lights = {vrml};
        auto renderer = renderer_of(scene);
        ASSERT_TRUE(renderer) << renderer.error().message;
        renderer->begin_image(looking_from({out, 1, 0}, {out, 0, 0}, 3));
        for (int pass = 0; pass < 4; ++pass) ASSERT_TRUE(renderer->add_pass());
        const double d = std::sqrt(4 + out * out);
        const double expected = 0.5 / std::max(0.5 * d + 0.25 * d * d, 1.0) * 2 / d;
        const RgbaF shown = renderer->radiance()(1, 1);
        EXPECT_NEAR(shown.r, 0.8 * expected, 0.03 * expected);
        EXPECT_NEAR(shown.b, 0.2 * expected, 0.03 * expected);
    }
}

TEST(TracerScene, TakesWhatItCanAndCountsTheRest) {
    Scene scene = small_room();
    scene.geometry[1].material.opacity = 0.5F;
    scene.geometry.push_back(scene.geometry[0]);
    auto lines = std::make_shared<Mesh>(*scene.geometry[0].mesh);
    lines->topology = Topology::kLines;
    scene.geometry[2].mesh = lines;
    scene.floor = Floor{};
    const TracerScene room = make_tracer_scene(scene);
    EXPECT_EQ(room.raster_only_nodes, 2);
    EXPECT_EQ(room.scene.lights.size(), 1U);
    EXPECT_TRUE(room.scene.scopes.empty());
    ASSERT_EQ(room.scene.meshes.size(), 2U);  // the white box and the floor
    const capture::Mesh& floor = room.scene.meshes[1];
    const glm::uvec3 t = floor.triangles[5];
    EXPECT_GT(glm::cross(floor.positions[t.y] - floor.positions[t.x], floor.positions[t.z] - floor.positions[t.x]).y,
              0);
}

// Two boxes on a slab under a one-sided roof, and a directional light from above that illuminates the slab and the
// first box only.
struct ScopedRoom {
    Scene scene;
    enum : std::size_t { kSlab, kInside, kOutside, kRoof };

    ScopedRoom() {
        scene.geometry = {box_node({8, 0.2, 4}, {0, -0.1, 0}, glm::vec3(0.5F)),
                          box_node({1, 1, 1}, {-2, 0.5, 0}, glm::vec3(0.5F)),
                          box_node({1, 1, 1}, {2, 0.5, 0}, glm::vec3(0.5F))};
        // Faces down.
        auto sheet = std::make_shared<Mesh>();
        for (const auto& [x, z] : {std::pair(-9.0F, -9.0F), {9.0F, -9.0F}, {9.0F, 9.0F}, {-9.0F, 9.0F}}) {
            sheet->vertices.push_back({.position = {x, 3, z}, .normal = {0, -1, 0}});
        }
        sheet->indices = {0, 1, 2, 0, 2, 3};
        sheet->two_sided = false;
        GeometryNode roof;
        roof.mesh = sheet;
        roof.material = scene.geometry[kSlab].material;
        scene.geometry.push_back(roof);
        scene.lights = {{.colour = glm::vec3(1), .towards = glm::normalize(glm::dvec3(1, -1, 0)), .everywhere = false}};
        for (const std::size_t node : {kSlab, kInside, kRoof}) scene.geometry[node].lights = {0};
    }

    // Radiance that leaves the surface below `at`.
    [[nodiscard]] float seen_below(const glm::dvec3& at, TracedMethod method) const {
        auto renderer = renderer_of(scene);
        EXPECT_TRUE(renderer) << renderer.error().message;
        renderer->set_method(method);
        renderer->begin_image(looking_from(at, at - glm::dvec3(0, 1, 0), 3));
        for (int pass = 0; pass < 16; ++pass) EXPECT_TRUE(renderer->add_pass());
        return renderer->radiance()(1, 1).r;
    }
};

TEST(ScopedLights, IlluminateTheirNodesThroughTheBackOfOneSidedRoofs) {
    const ScopedRoom room;
    const float direct = 0.5F * std::sqrt(0.5F);  // diffuse colour times the cosine
    for (const TracedMethod method : {TracedMethod::kWhitted, TracedMethod::kRadiosity, TracedMethod::kPath}) {
        SCOPED_TRACE(static_cast<int>(method));
        EXPECT_NEAR(room.seen_below({-3.5, 2, 0}, method), direct, 0.35F * direct);  // slab
        EXPECT_NEAR(room.seen_below({-2, 2, 0}, method), direct, 0.35F * direct);    // box in the scope
        EXPECT_LT(room.seen_below({-1, 2, 0}, method), 0.3F * direct);               // shadow of that box
        EXPECT_LT(room.seen_below({2, 2, 0}, method), 0.3F * direct);                // box out of the scope
        EXPECT_NEAR(room.seen_below({3, 2, 0}, method), direct, 0.35F * direct);     // no shadow of that box
    }
}

TEST(ScopedLights, TwoSidedRoofsInTheScopeShade) {
    ScopedRoom room;
    auto sheet = std::make_shared<Mesh>(*room.scene.geometry[ScopedRoom::kRoof].mesh);
    sheet->two_sided = true;
    room.scene.geometry[ScopedRoom::kRoof].mesh = sheet;
    EXPECT_EQ(room.seen_below({-3.5, 2, 0}, TracedMethod::kWhitted), 0);
    room.scene.geometry[ScopedRoom::kRoof].lights.clear();
    EXPECT_GT(room.seen_below({-3.5, 2, 0}, TracedMethod::kWhitted), 0.3F);
}

TEST(ScopedLights, OnlyTheBrightestDirectionalLightOfANodeCastsShadows) {
    ScopedRoom room;
    room.scene.lights.push_back(room.scene.lights[0]);
    room.scene.lights[1].colour = glm::vec3(0.25F);
    for (const std::size_t node : {ScopedRoom::kSlab, ScopedRoom::kInside}) {
        room.scene.geometry[node].lights = {0, 1};
    }
    EXPECT_NEAR(room.seen_below({-1, 2, 0}, TracedMethod::kWhitted), 0.25F * 0.5F * std::sqrt(0.5F), 1e-3F);
    const TracerScene traced = make_tracer_scene(room.scene);
    EXPECT_TRUE(traced.scene.lights[0].casts_shadows);
    EXPECT_FALSE(traced.scene.lights[1].casts_shadows);
}

TEST(ScopedLights, AmbientPartsIlluminateTheScopeByWhitted) {
    ScopedRoom room;
    room.scene.lights[0].ambient = glm::vec3(0.5F);
    EXPECT_NEAR(room.seen_below({-1, 2, 0}, TracedMethod::kWhitted), 0.25F, 1e-3F);  // in the shadow
    EXPECT_EQ(room.seen_below({2, 2, 0}, TracedMethod::kWhitted), 0);
}

TEST(ScopedLights, MovingNodesKeepTheirScope) {
    ScopedRoom room;
    room.scene.geometry[ScopedRoom::kInside].moving = 1;
    room.scene.geometry[ScopedRoom::kOutside].moving = 2;
    const float direct = 0.5F * std::sqrt(0.5F);
    EXPECT_NEAR(room.seen_below({-2, 2, 0}, TracedMethod::kWhitted), direct, 1e-3F);
    EXPECT_EQ(room.seen_below({-1, 2, 0}, TracedMethod::kWhitted), 0);
    EXPECT_EQ(room.seen_below({2, 2, 0}, TracedMethod::kWhitted), 0);
    EXPECT_NEAR(room.seen_below({3, 2, 0}, TracedMethod::kWhitted), direct, 1e-3F);
}

TEST(TracerScene, MaterialsBecomeSurfaces) {
    Scene scene = small_room();
    scene.geometry[0].material.lit = false;
    scene.geometry[1].material.specular = glm::vec3(0.5F);
    scene.geometry[1].material.shininess = 0.5F;
    const TracerScene room = make_tracer_scene(scene);
    EXPECT_EQ(room.scene.materials[0].emission, glm::vec3(0.6F));
    EXPECT_EQ(room.scene.materials[0].colour, glm::vec3(0));
    EXPECT_EQ(room.scene.materials[1].kind, capture::SurfaceKind::glossy);
    EXPECT_NEAR(room.scene.materials[1].roughness * room.scene.materials[1].roughness, std::sqrt(2.0 / 66), 1e-6);
}

TEST(TracedRenderer, AreasAreSeenFromTheSideTheyShineTo) {
    Scene scene = small_room();
    scene.lights = {rectangle_light({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, glm::vec3(3))};
    ASSERT_LT(glm::cross(scene.lights[0].half_u, scene.lights[0].half_v).y, 0);
    auto renderer = renderer_of(scene);
    ASSERT_TRUE(renderer);
    renderer->begin_image(looking_from({0, 2, 0}, {0, 5, 0}, 5));
    ASSERT_TRUE(renderer->add_pass());
    EXPECT_EQ(renderer->radiance()(2, 2), (RgbaF{3, 3, 3, 1}));
    renderer->begin_image(looking_from({0, 7, 0.01}, {0, 4, 0}, 5));  // the floor's light is not blocked
    ASSERT_TRUE(renderer->add_pass());
    EXPECT_LT(renderer->radiance()(2, 2).r, 1.5F);
}

TEST(TracedRenderer, AnEvenEnvironmentLightsEverySideAlike) {
    Scene scene;
    scene.lights.clear();
    scene.geometry = {box_node({1, 1, 1}, {0, 0, 0}, {0.7F, 0.5F, 0.1F})};
    EnvironmentLight sky;
    sky.pixels = std::make_shared<const Image<RgbaF>>(4, 2, RgbaF{1, 2, 4, 1});
    sky.scale = 0.5F;
    for (const bool seen : {false, true}) {
        sky.seen = seen;
        scene.environment = sky;
        auto renderer = renderer_of(scene);
        ASSERT_TRUE(renderer);
        for (const glm::dvec3& eye : {glm::dvec3(0, 0, 1.2), glm::dvec3(0, 1.2, 0), glm::dvec3(-0.62, -0.62, 0.2)}) {
            renderer->begin_image(looking_from(eye, {0, 0, 0}, 9));
            for (int pass = 0; pass < 64; ++pass) ASSERT_TRUE(renderer->add_pass());
            const Image<RgbaF> shown_pixels = renderer->radiance();  // all pixels show the box
            RgbaF shown{};
            for (const RgbaF& p : shown_pixels.pixels()) {
                ASSERT_EQ(p.a, 1);
                shown = {shown.r + p.r / 81, shown.g + p.g / 81, shown.b + p.b / 81, 1};
            }
            EXPECT_NEAR(shown.r, 0.35, 0.005 * 0.35);
            EXPECT_NEAR(shown.g, 0.5, 0.005 * 0.5);
            EXPECT_NEAR(shown.b, 0.2, 0.005 * 0.2);
        }
        renderer->begin_image(looking_from({0, 0, 3}, {0, 0, 9}, 3));
        ASSERT_TRUE(renderer->add_pass());
        EXPECT_EQ(renderer->radiance()(1, 1), (seen ? RgbaF{0.5F, 1, 2, 1} : RgbaF{0, 0, 0, 0}));
    }
}

TEST(TracedRenderer, PassesGiveTheSameBitsInAnyNumberOfThreads) {
    const Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 33);
    const auto traced = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        auto renderer = renderer_of(small_room());
        EXPECT_TRUE(renderer);
        renderer->begin_image(camera);
        for (int pass = 0; pass < 7; ++pass) EXPECT_TRUE(renderer->add_pass());
        return renderer->radiance();
    };
    const Image<RgbaF> one = traced(1);
    const Image<RgbaF> four = traced(4);
    // Same as one image of seven samples.
    TracerScene room = make_tracer_scene(small_room());
    auto tracer = capture::Tracer::create(std::move(room.scene));
    ASSERT_TRUE(tracer);
    capture::RenderOptions options;
    options.samples_per_pixel = 7;
    const Image<RgbaF> whole = tracer->render(camera, options).image;
    for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 33; ++x) {
            ASSERT_EQ(one(x, y), four(x, y));
            ASSERT_EQ(one(x, y), whole(x, y));
        }
    }
}

Scene moving_room() {
    Scene scene = small_room();
    scene.geometry[1].moving = 7;
    for (const double x : {-2.0, 2.0}) {
        scene.geometry.push_back(scene.geometry[1]);
        scene.geometry.back().world_from_node[3] = {x, 0.5, 0, 1};
        scene.geometry.back().world_from_node[0] = {0.3, 0.2, 0, 0};
    }
    scene.geometry[3].moving = 8;
    return scene;
}

TEST(TracedRenderer, PartsHaveTheBytesOfTheWhole) {
    auto renderer = renderer_of(small_room());
    ASSERT_TRUE(renderer) << renderer.error().message;
    Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 280);
    camera.height = 240;
    for (const NamedMethod& named : kTracedMethods) {
        SCOPED_TRACE(named.name);
        const auto traced = [&](const capture::PixelRectangle& part) {
            renderer->set_method(named.method);
            renderer->set_part(part);
            renderer->begin_image(camera);
            for (int pass = 0; pass < 2; ++pass) EXPECT_TRUE(renderer->add_pass());
            return renderer->image();
        };
        const Image<Rgba8> whole = traced({0, 0, 280, 240});
        for (const capture::PixelRectangle& part : {capture::PixelRectangle{96, 64, 160, 128}, {240, 0, 280, 64}}) {
            const Image<Rgba8> alone = traced(part);
            for (int y = part.y0; y < part.y1; ++y) {
                for (int x = part.x0; x < part.x1; ++x) ASSERT_EQ(whole(x, y), alone(x, y)) << x << " " << y;
            }
        }
    }
}

TEST(TracerScene, WhatMayMoveIsAPartThatNodesShare) {
    Scene scene = moving_room();
    scene.geometry.push_back(scene.geometry[3]);
    scene.geometry.back().material.diffuse = glm::vec3(0.5F);  // a different material
    const TracerScene room = make_tracer_scene(scene);
    EXPECT_EQ(room.scene.meshes.size(), 1U);
    EXPECT_EQ(room.scene.parts.size(), 2U);
    ASSERT_EQ(room.scene.instances.size(), 4U);
    EXPECT_EQ(room.moving[2].id, 8U);
    EXPECT_EQ(room.scene.instances[1].part, room.scene.instances[2].part);
}

// Moved nodes equal nodes read at the new position.
TEST(TracedRenderer, MovedNodesLookAsReadThere) {
    const Camera camera = looking_from({3, 3, 5}, {0, 0.4, 0}, 64);
    const auto image_of = [&](TracedRenderer& renderer) {
        renderer.begin_image(camera);
        EXPECT_TRUE(renderer.add_pass());
        return renderer.radiance();
    };
    Scene scene = moving_room();
    auto moved = renderer_of(scene);
    ASSERT_TRUE(moved);
    moved->set_method(TracedMethod::kWhitted);
    const Image<RgbaF> before = image_of(*moved);
    const glm::dmat4 way = glm::translate(glm::dmat4(1), {0.3, 0.2, 1});
    ASSERT_TRUE(moved->move(7, way));
    EXPECT_FALSE(moved->move(9, way));            // no such node
    EXPECT_FALSE(moved->move(8, glm::dmat4(0)));  // no inverse
    const Image<RgbaF> after = image_of(*moved);
    for (GeometryNode& node : scene.geometry) {
        if (node.moving == 7U) node.world_from_node = way * node.world_from_node;
        node.moving.reset();
    }
    auto still = renderer_of(scene);
    ASSERT_TRUE(still);
    still->set_method(TracedMethod::kWhitted);
    const Image<RgbaF> expected = image_of(*still);
    int other = 0, wrong = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            other += std::abs(before(x, y).r - expected(x, y).r) > 1e-3F;
            wrong += std::abs(after(x, y).r - expected(x, y).r) > 1e-3F;
        }
    }
    EXPECT_GT(other, 200);
    EXPECT_LT(wrong, 10);
    // The edge of a shadow moves while the shutter is open: images become grey there.
    ASSERT_TRUE(moved->move(7, way, glm::translate(way, {0.5, 0, 0})));
    const Image<RgbaF> blurred = image_of(*moved);
    EXPECT_NE(blurred, after);
}

// Total width of the lines in the middle row of an image of a box, px. The box hides its sides, so that its outline is
// its front face, which is 4.8 from the camera.
double line_width_px(const std::optional<double>& line_radius, int side) {
    Scene scene;
    scene.geometry = {box_node({2, 2, 0.4}, {0, 0, 0}, glm::vec3(1))};
    scene.lights = {{.colour = glm::vec3(1), .towards = {0, 0, -1}}};
    auto renderer = TracedRenderer::create(scene, {}, {.method = TracedMethod::kToon, .line_radius = line_radius});
    EXPECT_TRUE(renderer) << renderer.error().message;
    renderer->begin_image(looking_from({0, 0, 5}, {0, 0, 0}, side));
    for (int pass = 0; pass < 16; ++pass) EXPECT_TRUE(renderer->add_pass());
    const Image<RgbaF> image = renderer->radiance();
    double width_px = 0;
    for (int x = 0; x < side; ++x) {
        const RgbaF& p = image(x, side / 2);
        width_px += static_cast<double>(p.a * (1 - p.g));
    }
    return width_px;
}

TEST(TracedRenderer, LinesAreTwoPixelsWideAtTheMedianDistance) {
    for (const int side : {96, 288}) EXPECT_NEAR(line_width_px({}, side), 2, 0.5) << side;
    EXPECT_NEAR(line_width_px(4.8 * 5 / 96, 96), 2 * 5, 0.5);
    EXPECT_NEAR(line_width_px(0, 96), 0, 1e-3);
}

TEST(TracedRenderer, ExposureCountsInStops) {
    const Camera camera = looking_from({0, 5, 0.1}, {0, 0, 0}, 9);
    auto plain = renderer_of(small_room(), -2);
    auto brighter = renderer_of(small_room(), -1);
    ASSERT_TRUE(plain && brighter);
    for (TracedRenderer* renderer : {&*plain, &*brighter}) {
        renderer->begin_image(camera);
        ASSERT_TRUE(renderer->add_pass());
    }
    EXPECT_EQ(plain->radiance()(1, 1), brighter->radiance()(1, 1));
    const auto linear = [](std::uint8_t code) { return std::pow((code / 255.0 + 0.055) / 1.055, 2.4); };
    EXPECT_NEAR(linear(brighter->image()(1, 1).g) / linear(plain->image()(1, 1).g), 2, 0.1);
}

// After changes of the lights and back, the bits equal those of a new renderer.
TEST(TracedRenderer, EditedLightGivesTheImagesOfASceneThatHasIt) {
    const Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 33);
    Scene first = small_room();
    EnvironmentLight sky;
    sky.pixels = std::make_shared<const Image<RgbaF>>(4, 2, RgbaF{1, 2, 4, 1});
    sky.scale = 0.1F;
    first.environment = sky;
    Scene moved = first;
    moved.lights[0].location = {-1, 2, 0};
    Scene turned = moved;
    turned.environment->turn_rad = 1;
    turned.environment->scale = 0.3F;
    Scene other = turned;
    other.environment->pixels = std::make_shared<const Image<RgbaF>>(2, 2, RgbaF{3, 1, 0, 1});
    other.environment->seen = true;
    Scene none = small_room();
    none.lights = {rectangle_light({-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, glm::vec3(3))};
    Scene dark = none;
    dark.lights.clear();
    dark.navigation.headlight = true;
    const auto image = [&](TracedRenderer& renderer) {
        renderer.begin_image(camera);
        for (int pass = 0; pass < 2; ++pass) EXPECT_TRUE(renderer.add_pass());
        return std::pair(renderer.radiance(), renderer.image());
    };
    for (const NamedMethod& named : kTracedMethods) {
        auto edited = renderer_of(first);
        ASSERT_TRUE(edited);
        edited->set_method(named.method);
        double exposure_ev = 0;
        for (const Scene* scene : {&moved, &turned, &other, &none, &dark, &first}) {
            exposure_ev += 0.5;
            edited->set_lights(*scene, exposure_ev);
            auto fresh = renderer_of(*scene, exposure_ev);
            ASSERT_TRUE(fresh);
            fresh->set_method(named.method);
            EXPECT_EQ(image(*edited), image(*fresh)) << named.name << " " << exposure_ev;
        }
    }
}

TEST(TracedRenderer, TheHeadlightIsCarriedWhereNothingElseShines) {
    Scene scene = small_room();
    scene.lights.clear();
    scene.navigation.headlight = true;
    const Camera camera = looking_from({0, 5, 0.1}, {0, 0, 0}, 5);
    const auto brightness = [&] {
        auto renderer = renderer_of(scene);
        EXPECT_TRUE(renderer);
        renderer->begin_image(camera);
        EXPECT_TRUE(renderer->add_pass());
        return renderer->radiance()(0, 0).g;
    };
    EXPECT_NEAR(brightness(), 0.6, 0.02);
    scene.geometry[1].material.emissive = glm::vec3(1e-3F);
    EXPECT_LT(brightness(), 0.01);
}

}  // namespace
}  // namespace rs::compositor
