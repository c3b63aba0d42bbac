#include "rayspace/light/irradiance_harmonics.hpp"

#include "rayspace/light/capture_irradiance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs {
namespace {

// An order 2 polynomial of a cosine lobe is within 7 % of its peak.
TEST(IrradianceHarmonics, ALightIsACosineLobe) {
    IrradianceHarmonics irradiance;
    const glm::vec3 light = glm::normalize(glm::vec3(1, 2, -2));
    irradiance.add_direction(light, {3.14159265F, 0, 0});
    for (const glm::vec3& n : {light, -light, glm::vec3(0, 1, 0), glm::vec3(0.6F, 0, 0.8F)}) {
        EXPECT_NEAR(irradiance.at(n).r, std::max(glm::dot(n, light), 0.0F), 0.07F);
        EXPECT_EQ(irradiance.at(n).g, 0);
    }
}

TEST(IrradianceHarmonics, AFitIsExactForConstantsAndCloseForQuadrics) {
    const IrradianceHarmonics constant = fit_harmonics([](const glm::vec3&) { return glm::vec3(2, 0.5F, 0); });
    const auto quadric = [](const glm::vec3& n) { return glm::vec3(1 + 0.5F * n.x + 0.3F * n.y * n.z); };
    const IrradianceHarmonics fit = fit_harmonics(quadric);
    for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(0.6F, 0, -0.8F), glm::normalize(glm::vec3(1, 1, 1))}) {
        EXPECT_LT(glm::distance(constant.at(n), glm::vec3(2, 0.5F, 0)), 1e-5F);
        EXPECT_NEAR(fit.at(n).r, quadric(n).r, 0.01F);
    }
}

TEST(IrradianceHarmonics, JsonKeepsThemAndRefusesOtherValues) {
    IrradianceHarmonics irradiance;
    irradiance.add_direction({0, 0.6F, 0.8F}, {1, 2, 3});
    const nlohmann::json json = irradiance_to_json(irradiance);
    EXPECT_EQ(irradiance_from_json(json, "x")->factors, irradiance.factors);
    nlohmann::json eight = json, text = json, flat = json;
    eight.erase(8);
    text[3][1] = "bright";
    flat[0] = 1;
    for (const nlohmann::json& wrong : {eight, text, flat, nlohmann::json(1), nlohmann::json()}) {
        const auto read = irradiance_from_json(wrong, "set: key");
        ASSERT_FALSE(read);
        EXPECT_TRUE(read.error().message.starts_with("set: key: must be 9 arrays"));
    }
}

}  // namespace
}  // namespace rs
