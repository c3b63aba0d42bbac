// Light lists of scenes.

#include "compositor/scene/light/lights_file.hpp"

#include "compositor/scene/light/scene_lights.hpp"
#include "datasets-synthetic/showroom/showroom.hpp"
#include "datasets-synthetic/showroom/world_file.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

Light only(const std::string& light, const std::filesystem::path& file = "lights.json") {
    const auto list = light_list_from_json("{\"lights\": [" + light + "]}", file);
    EXPECT_TRUE(list) << (list ? "" : list.error().message);
    return list && list->lights.size() == 1 ? list->lights[0] : Light{};
}

TEST(SceneLights, LightsMayCastNoShadows) {
    Scene scene;
    Light light;
    light.kind = LightKind::kPoint;
    scene.lights = {light, light};
    scene.lights[1].casts_shadows = false;
    EXPECT_EQ(lights_with_shadows(scene), (std::vector<bool>{true, false}));
}

TEST(LightList, PunctualLightsGiveWhatTheirNumbersSay) {
    const Light sun = only(R"({"kind": "directional", "aim": [0, -3, 0], "lux": 17900, "colour": [1, 0.5, 0]})");
    EXPECT_NEAR(irradiance_at(sun, {}).r, 100, 1e-3);
    EXPECT_NEAR(irradiance_at(sun, {}).g, 50, 1e-3);
    const Light bulb = only(R"({"kind": "point", "location": [0, 2, 0], "candela": 179, "name": "bulb"})");
    EXPECT_EQ(bulb.name, "bulb");
    EXPECT_NEAR(irradiance_at(bulb, {0, 0, 0}).r, 0.25, 1e-6);
    EXPECT_NEAR(irradiance_at(bulb, {0, 1.9, 0}).r, 100, 1e-3);  // also nearby
    const Light spot = only(
        R"({"kind": "spot", "location": [0, 2, 0], "aim": [0, -1, 0], "candela": 179, "beam_deg": 20, "cut_off_deg": 40})");
    EXPECT_NEAR(irradiance_at(spot, {2 * std::tan(radians(9.9)), 0, 0}).r, 0.25 * std::pow(std::cos(radians(9.9)), 2),
                1e-5);
    EXPECT_NEAR(irradiance_at(spot, {2 * std::tan(radians(15)), 0, 0}).r, 0.125 * std::pow(std::cos(radians(15)), 2),
                1e-5);
    EXPECT_EQ(irradiance_at(spot, {2 * std::tan(radians(20.1)), 0, 0}).r, 0);
}

TEST(LightList, AreasShineToTheirAimWithTheirLumens) {
    for (const char* aim : {"[0, -1, 0]", "[1, 0, 0]", "[0.3, 0.2, -0.7]"}) {
        const Light panel = only(std::string(R"({"kind": "rectangle", "location": [0, 2, 0], "size": [1.2, 0.3], )") +
                                 R"("lumens": 3580, "turn_deg": 30, "aim": )" + aim + "}");
        EXPECT_NEAR(area_of(panel), 0.36, 1e-9);
        EXPECT_NEAR(panel.colour.r * kPi * 0.36, 20, 1e-4);
        const Light spot = to_punctual_light(panel);
        glm::dvec3 towards(0, -1, 0);
        if (aim[1] == '1') towards = {1, 0, 0};
        if (aim[1] == '0' && aim[2] == '.') towards = glm::normalize(glm::dvec3(0.3, 0.2, -0.7));
        EXPECT_LT(glm::distance(glm::normalize(glm::cross(panel.half_u, panel.half_v)), towards), 1e-9) << aim;
        EXPECT_LT(glm::distance(spot.towards, towards), 1e-9);
        // From far away the panel is a point on its axis.
        EXPECT_NEAR(irradiance_at(spot, panel.location + 10.0 * towards).r, 20 / kPi / 100, 1e-5);
    }
    EXPECT_NEAR(
        area_of(only(R"({"kind": "disc", "location": [0, 0, 0], "aim": [0, 1, 0], "size": 2, "radiance": [1, 1, 1]})")),
        kPi, 1e-9);
}

TEST(LightList, LuminairesAreTurnedAboutTheirAim) {
    const test::TemporaryFolder scratch;
    // 179 cd downwards; 100 in plane 0, 200 in plane 90 at 45 degrees.
    ASSERT_TRUE(write_file(scratch / "lamp.ies",
                           "TILT=NONE\n1 -1 1 3 2 1 2 0 0 0 1 1 9\n0 45 90\n0 90\n179 100 0\n179 200 0\n"));
    const std::string head = R"({"kind": "luminaire", "file": "lamp.ies", "location": [0, 1, 0])";
    const auto list = scratch / "lights.json";
    const Light down = only(head + "}", list);
    EXPECT_NEAR(irradiance_at(down, {0, 0, 0}).r, 1, 1e-6);
    EXPECT_NEAR(irradiance_at(down, {1, 0, 0}).r, 100 / 179.0 / 2, 1e-6);
    EXPECT_NEAR(irradiance_at(down, {0, 0, -1}).r, 200 / 179.0 / 2, 1e-6);
    const Light turned = only(head + R"(, "turn_deg": 90})", list);
    EXPECT_NEAR(irradiance_at(turned, {0, 0, -1}).r, 100 / 179.0 / 2, 1e-6);
    EXPECT_NEAR(irradiance_at(turned, {1, 0, 0}).r, 200 / 179.0 / 2, 1e-6);
    const Light aside = only(head + R"(, "aim": [1, 0, 0]})", list);
    EXPECT_NEAR(irradiance_at(aside, {1, 1, 0}).r, 1, 1e-6);
    EXPECT_EQ(irradiance_at(aside, {-2, 1, 0}).r, 0);
    EXPECT_NEAR(glm::determinant(aside.world_from_luminaire), 1, 1e-12);
    // Its spot has the same intensity straight ahead and the same extent.
    const Light spot = to_punctual_light(down);
    EXPECT_LT(glm::distance(spot.towards, glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_NEAR(irradiance_at(spot, {0, 0, 0}).r, 200 / 179.0, 1e-5);  // of the peak
    EXPECT_EQ(irradiance_at(spot, {0, 2, 0}).r, 0);
}

TEST(LightList, TheShowroomsEveningIsOne) {
    synthetic::ShowroomOptions small;
    small.texture_scale = 0.05F;
    const synthetic::World world = synthetic::make_showroom(small);
    const test::TemporaryFolder scratch;
    ASSERT_TRUE(write_file(scratch / synthetic::kDownlightFile, synthetic::downlight_ies()));
    ASSERT_TRUE(write_file(scratch / "evening.json", synthetic::evening_lights(world)));
    const auto list = read_light_list(scratch / "evening.json");
    ASSERT_TRUE(list) << list.error().message;
    EXPECT_TRUE(list->replace);
    EXPECT_GT(list->lights.size(), 12U);
    EXPECT_NEAR(list->lights[0].luminaire->web.lumens(), 560, 1.5);
    for (const Light& light : list->lights) {
        EXPECT_TRUE(std::ranges::any_of(world.rooms, [&](const synthetic::Room& room) {
            const glm::vec3 place(light.location);
            return glm::all(glm::lessThan(room.low, place)) && glm::all(glm::lessThan(place, room.high));
        })) << "a lamp hangs outside";
    }
}

TEST(LightList, AnEnvironmentIsAImage) {
    const test::TemporaryFolder scratch;
    Image<RgbaF> sky(8, 4, {0.5F, -1, 3, 1});
    ASSERT_TRUE(write_exr(scratch / "sky.exr", sky));
    const auto list_of = [&](const std::string& environment) {
        return light_list_from_json(R"({"lights": [], "environment": )" + environment + "}", scratch / "a.json");
    };
    const auto list = list_of(R"({"file": "sky.exr", "scale": 2, "turn_deg": 90, "seen": true})");
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_TRUE(list->environment);
    EXPECT_EQ((*list->environment->pixels)(3, 2), (RgbaF{0.5F, 0, 3, 1}));
    EXPECT_EQ(list->environment->scale, 2);
    EXPECT_NEAR(list->environment->turn_rad, kPi / 2, 1e-6);
    EXPECT_TRUE(list->environment->seen);
    sky(1, 1).g = std::numeric_limits<float>::quiet_NaN();
    ASSERT_TRUE(write_exr(scratch / "bad.exr", sky));
    for (const auto& [environment, wrong] :
         std::vector<std::pair<std::string, std::string>>{{R"({"file": "bad.exr"})", "environment.file"},
                                                          {R"({"file": "bad.exr"})", "not finite"},
                                                          {R"({"file": "none.exr"})", "none.exr"},
                                                          {R"({"scale": 1})", "file"},
                                                          {R"({"file": "sky.exr", "scale": -1})", "environment.scale"},
                                                          {R"({"file": "sky.exr", "turn": 1})", "turn"}}) {
        const auto refused = list_of(environment);
        ASSERT_FALSE(refused) << environment;
        EXPECT_NE(refused.error().message.find(wrong), std::string::npos) << refused.error().message;
    }
}

TEST(LightList, ErrorsNameFileKeyAndRemedy) {
    const auto message = [](const std::string& lights) {
        const auto list = light_list_from_json("{\"lights\": [" + lights + "]}", "a.json");
        return list ? std::string("read") : list.error().message;
    };
    EXPECT_EQ(message(R"({"kind": "candle"})"),
              "a.json: lights[0].kind: must be point, spot, luminaire, rectangle, disc or directional");
    EXPECT_NE(message(R"({"kind": "directional", "aim": [0, 1, 0]})").find("lights[0]: lux is missing"),
              std::string::npos);
    for (const char* both_or_none : {"", R"(, "candela": 1, "intensity": [1, 1, 1])"}) {
        EXPECT_EQ(message(R"({"kind": "point", "location": [0, 0, 0])" + std::string(both_or_none) + "}"),
                  "a.json: lights[0]: must have either candela or intensity");
    }
    EXPECT_NE(
        message(R"({"kind": "directional", "aim": [0, 0, 0], "lux": 1})").find("lights[0].aim: must be a direction"),
        std::string::npos);
    EXPECT_NE(message(R"({"kind": "point", "location": [0, 0, 0], "candela": 1, "size": 2})")
                  .find("'size' that means nothing here"),
              std::string::npos);
    EXPECT_NE(message(R"({"kind": "luminaire", "location": [0, 0, 0], "file": "none.ies"})")
                  .find("lights[0].file: none.ies: cannot be opened"),
              std::string::npos);
    EXPECT_NE(
        message(
            R"({"kind": "spot", "location": [0,0,0], "aim": [0,1,0], "candela": 1, "beam_deg": 9, "cut_off_deg": 5})")
            .find("must not be above cut_off_deg"),
        std::string::npos);
    EXPECT_EQ(message(""), "read");
}

}  // namespace
}  // namespace rs::compositor
