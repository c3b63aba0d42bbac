// Light lists survive writing and reading, and a scene's own lights survive as lists.

#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/scene/reader/vrml_file.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace rs::compositor {
namespace {

constexpr const char* kIes = "TILT=NONE\n1 -1 1 3 2 1 2 0 0 0 1 1 9\n0 45 90\n0 90\n179 100 0\n179 200 0\n";

void expect_same_light(const Light& a, const Light& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.colour, b.colour);
    EXPECT_EQ(a.ambient, b.ambient);
    if (a.kind == LightKind::kDirectional || a.kind == LightKind::kSpot) {
        EXPECT_EQ(a.towards, b.towards);
    }
    if (a.kind != LightKind::kDirectional) {
        EXPECT_EQ(a.location, b.location);
    }
    EXPECT_EQ(a.everywhere, b.everywhere);
    if (a.kind != LightKind::kPoint && a.kind != LightKind::kSpot) return;
    EXPECT_EQ(a.attenuation, b.attenuation);
    EXPECT_EQ(a.least_attenuation, b.least_attenuation);
    EXPECT_EQ(a.radius, b.radius);
    if (a.kind != LightKind::kSpot) return;
    EXPECT_DOUBLE_EQ(a.cut_off_rad, b.cut_off_rad);  // not every double is representable in degrees
    EXPECT_DOUBLE_EQ(a.beam_width_rad, b.beam_width_rad);
}

TEST(LightListText, EveryWordComesBack) {
    const test::TemporaryFolder scratch;
    std::filesystem::create_directory(scratch / "lamps");
    ASSERT_TRUE(write_file(scratch / "lamps" / "a.ies", kIes));
    const Status sky = write_exr(scratch / "sky.exr", Image<RgbaF>(8, 4, {1, 2, 3, 1}));
    ASSERT_TRUE(sky) << sky.error().message;
    const std::string text = R"({ "replace": true, "headlight": true, "lights": [
      {"kind": "luminaire", "name": "desk \"x\"", "file": "lamps/a.ies", "location": [0.1, 2.7, -0.30000000000000004],
       "aim": [0, -1, 0.5], "turn_deg": 33.3, "colour": [1, 0.8, 0.55], "dimmer": 0.25},
      {"kind": "rectangle", "location": [2, 2.7, 0], "aim": [0, -1, 0], "size": [1.2, 0.3], "lumens": 3000},
      {"kind": "disc", "location": [0, 2, 1], "aim": [1, -1, 3], "size": 0.4, "turn_deg": -7, "radiance": [5, 4, 3]},
      {"kind": "spot", "location": [0, 2, 0], "aim": [0, -1, 0], "candela": 300.7, "beam_deg": 20, "cut_off_deg": 30.1,
       "reach": 12.5},
      {"kind": "point", "location": [0, 1, 0], "intensity": [0.4, 0.5, 1], "attenuation": [1, 0.1, 0],
       "ambient": [0.1, 0.2, 0.3]},
      {"kind": "directional", "aim": [-1, -2, 0], "lux": 20000, "name": "sun", "scope": 3} ],
      "environment": {"file": "sky.exr", "scale": 1.7, "turn_deg": 12.3, "seen": true} })";
    const auto list = light_list_from_json(text, scratch / "a.json");
    ASSERT_TRUE(list) << list.error().message;
    const auto written = light_list_to_json(*list, scratch / "a.json");
    ASSERT_TRUE(written) << written.error().message;
    const auto again = light_list_from_json(*written, scratch / "a.json");
    ASSERT_TRUE(again) << again.error().message << *written;
    ASSERT_EQ(again->entries.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        LightEntry expected = list->entries[i];
        expected.luminaire = again->entries[i].luminaire;  // read again
        EXPECT_EQ(again->entries[i], expected) << i;
    }
    EXPECT_TRUE(again->replace && again->headlight);
    EXPECT_EQ(again->environment_entry->file, list->environment_entry->file);
    EXPECT_EQ(again->environment_entry->scale, 1.7);
    EXPECT_EQ(again->environment_entry->turn_deg, 12.3);
    EXPECT_TRUE(again->environment_entry->seen);
    EXPECT_EQ(light_list_to_json(*again, scratch / "a.json").value(), *written);
    // File names are relative to the list's folder.
    const auto elsewhere = light_list_to_json(*list, scratch / "lamps" / "b.json");
    ASSERT_TRUE(elsewhere);
    EXPECT_NE(elsewhere->find(R"("file":"a.ies")"), std::string::npos) << *elsewhere;
    EXPECT_NE(elsewhere->find(R"("file":"../sky.exr")"), std::string::npos) << *elsewhere;
}

TEST(LightListText, LightsOfAnySceneAreWrittenToTheBit) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto positive = [&] { return std::exp(6 * any(random)); };
    for (int trial = 0; trial < 500; ++trial) {
        Light light;
        light.kind = std::array{LightKind::kDirectional, LightKind::kPoint, LightKind::kSpot}[trial % 3];
        light.colour = glm::vec3(glm::dvec3(positive(), positive(), trial % 5 == 0 ? 0 : positive()));
        light.ambient = glm::vec3(glm::dvec3(positive()));
        light.towards = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        light.location = {any(random), any(random), any(random)};
        if (trial % 2 == 0) {
            light.attenuation = {1, trial % 4, 0.3F};
            light.radius = positive();
        } else if (light.kind != LightKind::kDirectional) {
            light.attenuation = {0, 0, 1};
            light.least_attenuation = 0;
            light.radius = std::numeric_limits<double>::infinity();
        }
        light.cut_off_rad = radians(5 + 80 * std::abs(any(random)));
        light.beam_width_rad = light.cut_off_rad * std::abs(any(random));
        LightList list;
        list.entries = {entry_from_light(light)};
        const auto text = light_list_to_json(list, "a.json");
        ASSERT_TRUE(text) << text.error().message;
        const auto again = light_list_from_json(*text, "a.json");
        ASSERT_TRUE(again) << again.error().message << *text;
        expect_same_light(again->lights[0], light);
    }
}

TEST(LightListText, AWorldsLightsReplaceThemselves) {
    const std::string world = R"(#VRML V2.0 utf8
NavigationInfo { headlight FALSE }
PointLight { location 1 2 3 intensity 0.7 color 1 0.5 0.25 attenuation 1 0.2 0 radius 20 ambientIntensity 0.1 }
SpotLight { location 0 3 0 direction 1 -2 0.5 cutOffAngle 0.6 beamWidth 0.4 }
Group { children [ DirectionalLight { direction 0 -1 0.3 intensity 0.5 }
                   Shape { geometry Box { size 1 1 1 } appearance Appearance { material Material {} } } ] }
Shape { geometry Box { size 2 2 2 } appearance Appearance { material Material {} } })";
    const auto scene = scene_from_vrml(world, "world.wrl");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->lights.size(), 3U);
    const auto text = light_list_to_json(lights_as_list(*scene), "own.json");
    ASSERT_TRUE(text) << text.error().message;
    auto list = light_list_from_json(*text, "own.json");
    ASSERT_TRUE(list) << list.error().message << *text;
    Scene again = *scene;
    ASSERT_TRUE(add_lights(again, *list, "own.json"));
    ASSERT_EQ(again.lights.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) expect_same_light(again.lights[i], scene->lights[i]);
    for (std::size_t n = 0; n < scene->geometry.size(); ++n) {
        EXPECT_EQ(again.geometry[n].lights, scene->geometry[n].lights);
    }
    EXPECT_EQ(again.navigation.headlight, scene->navigation.headlight);
    // Second export, after the import: scopes are still those of the file.
    EXPECT_EQ(light_list_to_json(lights_as_list(again), "own.json").value(), *text);
    // A scope that the scene does not have changes nothing.
    list->entries[0].scope = 7;
    const Status refused = add_lights(again, *list, "own.json");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("own.json: lights[0].scope"), std::string::npos);
    EXPECT_EQ(again.lights.size(), 3U);
}

TEST(RasterLights, OfTheSameFileAreEachTheirOwn) {
    const test::TemporaryFolder scratch;
    ASSERT_TRUE(write_file(scratch / "a.ies", kIes));
    const auto list = light_list_from_json(
        R"({"lights": [
          {"kind": "luminaire", "name": "a", "file": "a.ies", "location": [1, 2, 3], "colour": [1, 0.5, 0.2]},
          {"kind": "luminaire", "name": "b", "file": "a.ies", "location": [0, 2, 0], "aim": [1, -1, 0], "dimmer": 2}]})",
        scratch / "a.json");
    ASSERT_TRUE(list) << list.error().message;
    Scene scene;
    scene.lights = list->lights;
    scene.lights[1].everywhere = false;
    const std::vector<Light> lights = raster_lights(scene, 0);
    for (std::size_t i = 0; i < 2; ++i) expect_same_light(lights.at(i), to_punctual_light(scene.lights[i]));
}

// In a box of 24 square metres with reflectance 1/2.
TEST(RasterLights, WallsReflectWhatLightsOfCandelasGive) {
    Scene scene;
    GeometryNode room;
    room.mesh = std::make_shared<const Mesh>(box_mesh({2, 2, 2}));
    scene.geometry = {room};
    Light lamp = point_light({0, 0, 0}, {3, 6, 0});
    const auto reflected = [&] {
        scene.lights = {lamp};
        return reflected_light(scene);
    };
    EXPECT_NEAR(reflected().x, 4 * 3.0 / 24, 1e-6);  // flux 4 pi I over the surface and pi
    EXPECT_NEAR(reflected().y, 4 * 6.0 / 24, 1e-6);
    EXPECT_EQ(reflected().z, 0);
    lamp.kind = LightKind::kSpot;
    lamp.cut_off_rad = lamp.beam_width_rad = kPi / 2;
    EXPECT_NEAR(reflected().x, 2 * 3.0 / 24, 1e-6);
    lamp.beam_width_rad = 0;  // linear falloff from the axis: the integral of (1 - 2 a / pi) sin a is 1 - 2 / pi
    EXPECT_NEAR(reflected().x, 2 * 3.0 / 24 * (1 - 2 / kPi), 1e-6);
    lamp.least_attenuation = 1;  // as VRML97 lights, which have an ambient part
    EXPECT_EQ(reflected(), glm::vec3(0));
    lamp = directional_light({0, -1, 0}, glm::vec3(5));
    EXPECT_EQ(reflected(), glm::vec3(0));
}

TEST(LightListText, WhatNoListMayHoldIsNotWritten) {
    LightList list;
    list.entries = {LightEntry{.kind = LightKind::kLuminaire}};
    auto text = light_list_to_json(list, "a.json");
    ASSERT_FALSE(text);
    EXPECT_NE(text.error().message.find("a.json: lights[0]"), std::string::npos);
    list.entries = {LightEntry{.location = {1e9, 0, 0}}};
    EXPECT_FALSE(light_list_to_json(list, "a.json"));
    list.entries = {LightEntry{.power = std::numeric_limits<double>::quiet_NaN()}};
    EXPECT_FALSE(light_list_to_json(list, "a.json"));
}

}  // namespace
}  // namespace rs::compositor
