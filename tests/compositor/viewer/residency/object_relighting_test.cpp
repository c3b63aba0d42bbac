#include "compositor/viewer/residency/object_relighting.hpp"

#include "rayspace/light/capture_irradiance.hpp"
#include "tests/compositor/objects.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

const std::vector<glm::vec3> kNormals{{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {-0.6F, 0, -0.8F}};

IrradianceHarmonics soft_light() {
    IrradianceHarmonics light;
    light.add_ambient({0.4F, 0.5F, 0.6F});
    light.add_direction({0.6F, 0.8F, 0}, {1, 0.8F, 0.5F});
    return light;
}

PlacedObject drum_with(const std::optional<IrradianceHarmonics>& capture, double angle_rad = 0) {
    auto viewable = std::make_shared<ViewableObject>(make_viewable(test::drum_object()).value());
    viewable->capture_irradiance = capture;
    NodeTransform place;
    place.angle_rad = angle_rad;
    return test::placed_at(viewable, place);
}

TEST(ObjectRelighting, TheLightOfTheCaptureLeavesAnObjectAsItIs) {
    const IrradianceHarmonics gain = relighting_gain(drum_with(soft_light()), soft_light());
    for (const glm::vec3& n : kNormals) EXPECT_LT(glm::distance(gain.at(n), glm::vec3(1)), 0.02F);
}

TEST(ObjectRelighting, UnknownLightIsWhiteFromAllSides) {
    const IrradianceHarmonics gain = relighting_gain(drum_with(std::nullopt), soft_light());
    for (const glm::vec3& n : kNormals) EXPECT_LT(glm::distance(gain.at(n), soft_light().at(n)), 0.02F);
}

TEST(ObjectRelighting, GainsTurnWithTheObjectAndAreLimited) {
    IrradianceHarmonics lamp;
    lamp.add_direction({1, 0, 0}, {3, 3, 3});
    const IrradianceHarmonics turned = relighting_gain(drum_with(std::nullopt, kPi / 2), lamp);
    EXPECT_GT(turned.at({0, 0, 1}).r, 0.9F);  // its +Z side faces +X
    EXPECT_LT(turned.at({1, 0, 0}).r, 0.15F);
    IrradianceHarmonics glaring;
    glaring.add_ambient(glm::vec3(100));
    EXPECT_NEAR(relighting_gain(drum_with(soft_light()), glaring).at({0, 1, 0}).r, 4, 1e-3F);
    EXPECT_EQ(relighting_gain(drum_with(soft_light()), {}).at({0, 1, 0}), glm::vec3(0));
}

TEST(ObjectRelighting, NormalsAreThoseOfAnEllipsoid) {
    const NormalProxy proxy{{0, 2, 0}, {1, 3, 1}};
    EXPECT_LT(glm::distance(proxy.normal({0, 2, 5}, {0, 0, -2}), glm::dvec3(0, 0, 1)), 1e-9);
    EXPECT_LT(glm::distance(proxy.normal({0, 9, 0}, {0, -1, 0}), glm::dvec3(0, 1, 0)), 1e-9);
    const glm::dvec3 missed = proxy.normal({4, 2, 5}, {0, 0, -1});
    EXPECT_LT(glm::distance(missed, glm::dvec3(1, 0, 0)), 1e-9);
}

TEST(ObjectRelighting, TheLightOfACaptureComesFromTheRig) {
    RaySpaceObject object = test::drum_object();
    object.rig_json = nlohmann::json{{kCaptureIrradianceKey, irradiance_to_json(soft_light())}}.dump();
    const Result<ViewableObject> viewable = make_viewable(object);
    ASSERT_TRUE(viewable);
    EXPECT_EQ(viewable->capture_irradiance->factors, soft_light().factors);
    object.rig_json = R"({"capture_irradiance": 3})";
    EXPECT_FALSE(make_viewable(object));
    object.rig_json.clear();
    EXPECT_FALSE(make_viewable(object)->capture_irradiance);
}

TEST(ObjectRelighting, RasterizedLightsAndTheirAmbientPartAddUp) {
    Light lamp = directional_light({0, -1, 0}, glm::vec3(static_cast<float>(kPi)));
    lamp.ambient = glm::vec3(0.25F);
    Light scoped = lamp;
    scoped.everywhere = false;
    const IrradianceHarmonics irradiance = irradiance_of({lamp, scoped}, {0, 0, 0});
    EXPECT_NEAR(irradiance.at({0, 1, 0}).r, 1.25F, 0.07F);
    EXPECT_NEAR(irradiance.at({0, -1, 0}).r, 0.25F, 0.07F);
}

}  // namespace
}  // namespace rs::compositor
