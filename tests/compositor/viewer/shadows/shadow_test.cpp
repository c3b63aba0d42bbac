// Raster shadows against traced ones, and typical artefacts of shadow maps. Skipped without OpenGL.

#include "tests/compositor/gl_test.hpp"
#include "tests/compositor/objects.hpp"
#include "tests/compositor/viewer/shadows/shadow_scene.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace rs::compositor {
namespace {

constexpr int kWidth_px = 480;
constexpr int kHeight_px = 320;

using Shadows = test::GlTest;

Camera over_the_boxes() {
    return look_at_camera({2.2, 2.6, 4.2}, {0, 0.4, 0}, radians(50), kWidth_px, kHeight_px);
}

struct NamedLight {
    const char* name;
    Light light;
};
std::vector<NamedLight> hard_lights() {
    Light point = point_light({0.3, 2.4, 1.2}, glm::vec3(12));
    point.least_attenuation = 1e-3F;  // not in candela, so without reflected light
    return {{"directional", directional_light({-0.5, -1, -0.3}, glm::vec3(3))},
            {"low directional", directional_light({-1, -0.45, 0.2}, glm::vec3(5))},
            {"point", point},
            {"narrow spot", test::spot_light({2.5, 3, 1.5}, {0, 0, 0}, 0.6)},
            {"wide spot", test::spot_light({-0.4, 2.6, 0.9}, {0.2, 0, 0.3}, 1.45)}};
}

TEST_F(Shadows, AgreeWithTracedOnes) {
    for (const auto& [name, light] : hard_lights()) {
        const test::ShadowAgreement found = test::shadow_agreement(test::boxes(light), {}, over_the_boxes());
        EXPECT_GT(found.compared, kWidth_px * kHeight_px / 4) << name;
        EXPECT_GT(found.shaded, 1500) << name;
        EXPECT_GE(found.share(), 0.99) << name;
        RecordProperty(name, std::to_string(100 * found.share()));
    }
}

// A plane without other casters.
TEST_F(Shadows, ALitPlaneDoesNotShadeItself) {
    const auto plane = test::matte_box({6, 0.5, 6}, {0, -0.25, 0});
    const Camera camera = look_at_camera({0, 2.5, 3.5}, {0, 0, 0}, radians(60), kWidth_px, kHeight_px);
    for (int incidence_deg = 0; incidence_deg <= 80; incidence_deg += 5) {
        const double from_up = radians(incidence_deg);
        // Diagonal to the texels.
        const glm::dvec3 from(std::sin(from_up) * 0.8, std::cos(from_up), std::sin(from_up) * 0.6);
        for (const Light& light :
             {directional_light(-from, glm::vec3(4)), point_light(3.0 * from, glm::vec3(20)),
              test::spot_light(5.0 * from, {0, 0, 0}, 0.9), test::spot_light(5.0 * from, {0, 0, 0}, 1.3)}) {
            Scene scene;
            scene.lights = {light};
            scene.geometry = {plane};
            const Image<Rgba8> open = test::raster_image(scene, {}, camera, false);
            const Image<Rgba8> shadowed = test::raster_image(scene, {}, camera, true);
            int differing = 0;
            for (std::size_t i = 0; i < open.pixels().size(); ++i) {
                if (open.pixels()[i] != shadowed.pixels()[i]) ++differing;
            }
            EXPECT_EQ(differing, 0) << incidence_deg << " degrees, kind " << static_cast<int>(light.kind);
        }
    }
}

// Points on the board at the foot of a box, on the side away from the light, are dark up to the box.
TEST_F(Shadows, AreClosedAtTheFoot) {
    const Camera camera = look_at_camera({-1.6, 0.9, 0.4}, {-0.5, 0.1, 0}, radians(50), 960, 640);
    for (const auto& [name, light] : {NamedLight{"directional", directional_light({-1, -1, 0.1}, glm::vec3(6))},
                                      NamedLight{"low directional", directional_light({-1, -0.3, 0.1}, glm::vec3(9))},
                                      NamedLight{"point", point_light({1.5, 2, -0.1}, glm::vec3(20))},
                                      NamedLight{"spot", test::spot_light({2, 2.5, -0.2}, {-0.5, 0, 0}, 0.7)}}) {
        Scene scene;
        scene.lights = {light};
        scene.geometry = {test::matte_box({6, 0.2, 6}, {0, -0.1, 0}), test::matte_box({1, 1, 1}, {0, 0.5, 0})};
        const Image<float> open = test::red_of(test::raster_image(scene, {}, camera, false));
        const Image<float> shadowed = test::red_of(test::raster_image(scene, {}, camera, true));
        int looked_at = 0;
        for (double along = -0.35; along <= 0.35; along += 0.01) {
            for (const double beside : {0.002, 0.005, 0.01, 0.02, 0.05, 0.1}) {
                const glm::dvec3 at = camera.project({-0.5 - beside, 0, along});
                const auto x = static_cast<int>(at.x);
                const auto y = static_cast<int>(at.y);
                if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
                if (!(open(x, y) > 0.05F)) continue;  // pixel of the box's own dark side
                ++looked_at;
                EXPECT_LT(shadowed(x, y), 0.02F * open(x, y)) << name << " " << along << " " << beside;
            }
        }
        EXPECT_GT(looked_at, 200) << name;
    }
}

TEST_F(Shadows, OfSheetsFallFromTheSideThatIsSeenOnly) {
    Scene scene;
    scene.lights = {directional_light({0, -1, 0}, glm::vec3(3))};
    auto sheet = std::make_shared<Mesh>();
    for (const glm::vec2 at : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
        sheet->vertices.push_back({{at.x, 0, -at.y}, {0, 1, 0}});
    }
    sheet->indices = {0, 1, 2, 0, 2, 3};  // visible from above
    sheet->two_sided = false;
    GeometryNode ceiling;
    ceiling.mesh = sheet;
    ceiling.world_from_node = glm::dmat4(1.0);
    ceiling.world_from_node[3] = glm::dvec4(0, 1, 0, 1);
    scene.geometry = {test::matte_box({6, 0.2, 6}, {0, -0.1, 0}), ceiling};
    const Camera camera = look_at_camera({0, 0.5, 3}, {0, 0, 0}, radians(50), 65, 65);
    const auto middle = [&](bool shadows) { return test::raster_image(scene, {}, camera, shadows)(32, 32).r; };
    EXPECT_GT(middle(false), 100);
    EXPECT_EQ(middle(true), 0);
    scene.geometry[1].world_from_node = scene.geometry[1].world_from_node *
                                        NodeTransform{.axis = {1, 0, 0}, .angle_rad = kPi}.parent_from_node().matrix();
    EXPECT_EQ(middle(true), middle(false));
}

// Scoped lights of a room are not shadowed by objects of another.
TEST_F(Shadows, OfLightsInRoomsAreThoseOfTheRoom) {
    Light light = directional_light({-1, -1, 0}, glm::vec3(3));
    light.everywhere = false;
    Scene scene = test::boxes(light);
    for (GeometryNode& node : scene.geometry) node.lights = {0};
    const Image<Rgba8> alone = test::raster_image(scene, {}, over_the_boxes(), true);
    scene.geometry.push_back(test::matte_box({4, 4, 4}, {6, 6, 0}));  // between the light and the room
    EXPECT_TRUE(std::ranges::equal(test::raster_image(scene, {}, over_the_boxes(), true).pixels(), alone.pixels()));
    scene.geometry.back().lights = {0};
    EXPECT_FALSE(std::ranges::equal(test::raster_image(scene, {}, over_the_boxes(), true).pixels(), alone.pixels()));
}

TEST_F(Shadows, OfObjectsAgreeWithTracedOnes) {
    const std::vector<PlacedObject> objects{
        test::placed_at(test::drum(Rgba8{200, 60, 40, 255}), {.translation = {0, 0.5, 0}, .scale = 0.5})};
    for (const auto& [name, light] : hard_lights()) {
        Scene scene = test::boxes(light);
        scene.geometry.resize(1);
        const test::ShadowAgreement found = test::shadow_agreement(scene, objects, over_the_boxes());
        EXPECT_GT(found.shaded, 300) << name;
        EXPECT_GE(found.share(), 0.97) << name;
        RecordProperty(name, std::to_string(100 * found.share()));
    }
}

TEST_F(Shadows, AreDrawnAgainOnlyWhereSomethingHasChanged) {
    Scene scene = test::boxes(point_light({0.3, 2.4, 1.2}, glm::vec3(12)));
    const std::vector<PlacedObject> objects{
        test::placed_at(test::drum(Rgba8{200, 60, 40, 255}), {.translation = {1.5, 0.3, 1.4}, .scale = 0.3})};
    auto frames = FrameCompositor::create(scene, objects, {.width = 64, .height = 48, .shadows = true});
    ASSERT_TRUE(frames);
    const Camera camera = look_at_camera({2.2, 2.6, 4.2}, {0, 0.4, 0}, radians(50), 64, 48);
    ASSERT_TRUE(frames->draw(camera));
    EXPECT_EQ(frames->statistics().shadow_maps_drawn, 6);
    ASSERT_TRUE(frames->draw(camera));
    EXPECT_EQ(frames->statistics().shadow_maps_drawn, 0);
    frames->turn_object(0, 0.5);
    ASSERT_TRUE(frames->draw(camera));
    EXPECT_GT(frames->statistics().shadow_maps_drawn, 0);
    EXPECT_LT(frames->statistics().shadow_maps_drawn, 6);
    // Not under a traced image, which has its own shadows, but as soon as it is removed.
    frames->set_traced(std::make_shared<const Image<Rgba8>>(64, 48));
    frames->turn_object(0, 0.7);
    ASSERT_TRUE(frames->draw(camera));
    EXPECT_EQ(frames->statistics().shadow_maps_drawn, 0);
    frames->set_traced(nullptr);
    ASSERT_TRUE(frames->draw(camera));
    EXPECT_GT(frames->statistics().shadow_maps_drawn, 0);
    ASSERT_TRUE(frames->set_shadows(false));
    ASSERT_TRUE(frames->draw(camera));
    EXPECT_EQ(frames->statistics().shadow_maps_drawn, 0);
}

// Moved nodes are redrawn in their part of the maps only; frames equal those of complete maps.
TEST_F(Shadows, OfWhatHasMovedAreThoseOfMapsDrawnWhole) {
    const Camera camera = over_the_boxes();
    const std::vector<PlacedObject> objects{
        test::placed_at(test::drum(Rgba8{200, 60, 40, 255}), {.translation = {1.5, 0.3, 1.4}, .scale = 0.3})};
    for (const auto& [name, light] : hard_lights()) {
        Scene scene = test::boxes(light);
        for (std::uint32_t i = 1; i < 4; ++i) scene.geometry[i].moving = i;
        scene.geometry.push_back(test::matte_box({0.2, 1.2, 0.2}, {-1.6, 0.6, -0.9}));  // among the moving ones
        const auto make = [&] {
            auto frames = FrameCompositor::create(
                scene, objects, {.width = camera.width, .height = camera.height, .samples = 1, .shadows = true});
            RS_CHECK(frames.ok());
            return std::move(*frames);
        };
        FrameCompositor walked = make();
        ASSERT_TRUE(walked.draw(camera));
        const Image<Rgba8> before = walked.image();
        for (const double shift : {0.0, 0.13, 0.9, 2.5, 40.0, -1.0}) {
            const auto move = [&](FrameCompositor& frames) {
                for (std::uint32_t i = 1; i < 4; ++i) {
                    std::optional<glm::dmat4> place = scene.geometry[i].world_from_node;
                    (*place)[3] += glm::dvec4(i == 1 ? shift : 0, i == 2 ? shift : 0, i == 3 ? -shift : 0, 0);
                    if (i == 3 && shift == 0.9) place.reset();
                    RS_CHECK(frames.move_geometry(i, place).ok());
                }
                frames.turn_object(0, shift);
                RS_CHECK(frames.draw(camera).ok());
            };
            FrameCompositor fresh = make();
            move(walked);
            move(fresh);
            EXPECT_TRUE(std::ranges::equal(walked.image().pixels(), fresh.image().pixels())) << name << " " << shift;
            if (shift == 0.13) {
                EXPECT_FALSE(std::ranges::equal(walked.image().pixels(), before.pixels())) << name;
            }
        }
    }
}

TEST_F(Shadows, FallOntoTheFloor) {
    Light point = point_light({-1.2, 2.4, -0.8}, glm::vec3(12));
    point.least_attenuation = 1e-3F;  // not in candela, so without reflected light
    const std::vector<NamedLight> lights{{"directional", directional_light({0.9, -1, -0.1}, glm::vec3(3))},
                                         {"point", point},
                                         {"narrow spot", test::spot_light({-1.6, 3, -1}, {0.4, 0, 0.2}, 0.6)},
                                         {"wide spot", test::spot_light({-1.2, 2.4, -0.8}, {0.2, 0, 0.3}, 1.3)}};
    for (const auto& [name, light] : lights) {
        Scene scene;
        scene.lights = {light};
        scene.background.sky = {glm::vec3(0)};  // the traced floor does not fade into it
        scene.floor = Floor{};
        scene.geometry = {test::matte_box({1, 1, 1}, {0, 0.5, 0})};
        const test::ShadowAgreement found = test::shadow_agreement(scene, {}, over_the_boxes());
        EXPECT_GT(found.shaded, 1000) << name;
        EXPECT_GE(found.share(), 0.99) << name;
    }
}

}  // namespace
}  // namespace rs::compositor
