// Relit objects in rasterized and traced frames: dark in a dark room, red in red light, unchanged in the light of their
// capture. Skipped without OpenGL.

#include "capture/tracer/session/capture_set.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/viewer/drawing/compositing.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

constexpr Rgba8 kGrey{128, 128, 128, 255};

// The light of a studio: bright from the right.
EnvironmentLight studio(const glm::vec3& tint) {
    Image<RgbaF> pixels(32, 16);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            const glm::vec3 p = tint * (x > 20 && x < 28 && y < 10 ? 3.0F : 0.6F);
            pixels(x, y) = {p.r, p.g, p.b, 1};
        }
    }
    return {std::make_shared<const Image<RgbaF>>(std::move(pixels))};
}

Scene lit_by(std::optional<EnvironmentLight> environment) {
    Scene scene;
    scene.lights.clear();  // the default light
    scene.environment = std::move(environment);
    scene.background.sky = {glm::vec3(0)};
    return scene;
}

// A drum that was captured in the white studio.
PlacedObject captured_drum() {
    capture::Scene scene;
    scene.environment.pixels = *studio(glm::vec3(1)).pixels;
    auto viewable = std::make_shared<ViewableObject>(make_viewable(test::drum_object(kGrey)).value());
    viewable->capture_irradiance = capture::capture_irradiance(scene).value();
    return test::placed_at(viewable);
}

class RelightingTest : public Compositing {
protected:
    // Linear colour in the middle of a frame; rasterized without a method.
    glm::vec3 shown(const Scene& scene, std::optional<TracedMethod> method, Relighting relighting = Relighting::kOn) {
        const std::vector<PlacedObject> objects{captured_drum()};
        auto frames = FrameCompositor::create(
            scene, objects, {.width = kFrameWidth, .height = kFrameHeight, .samples = 1, .relighting = relighting});
        RS_CHECK(frames.ok());
        if (method) {
            auto tracer = TracedRenderer::create(scene, objects, {.method = *method, .relighting = relighting});
            RS_CHECK(tracer.ok());
            tracer->begin_image(kFront);
            tracer->add_pass();
            frames->set_traced(std::make_shared<const Image<Rgba8>>(tracer->image()), tracer->object_irradiance());
        }
        const Rgba8 pixel = middle(frames->compose(kFront).value());
        return {linear_from_srgb8(pixel.r), linear_from_srgb8(pixel.g), linear_from_srgb8(pixel.b)};
    }
};

constexpr std::array<std::optional<TracedMethod>, 4> kMethods{std::nullopt, TracedMethod::kWhitted,
                                                              TracedMethod::kRadiosity, TracedMethod::kPath};

TEST_F(RelightingTest, AnObjectIsDarkInADarkRoom) {
    for (const auto& method : kMethods) EXPECT_EQ(shown(lit_by(std::nullopt), method), glm::vec3(0));
}

TEST_F(RelightingTest, AnObjectIsRedInRedLight) {
    for (const auto& method : kMethods) {
        const glm::vec3 colour = shown(lit_by(studio({1, 0.25F, 0.25F})), method);
        EXPECT_GT(colour.r, 0.15F);
        EXPECT_NEAR(colour.g, 0.25F * colour.r, 0.02F * colour.r);
        EXPECT_NEAR(colour.b, colour.g, 1e-3F);
    }
}

TEST_F(RelightingTest, TheLightOfTheCaptureLeavesAnObjectAsItIs) {
    const glm::vec3 captured = shown(lit_by(std::nullopt), std::nullopt, Relighting::kOff);
    for (const auto& method : kMethods) {
        const glm::vec3 colour = shown(lit_by(studio(glm::vec3(1))), method);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(colour[i], captured[i], 0.02F * captured[i]) << i;
    }
}

TEST_F(RelightingTest, ItIsOffOrByMethod) {
    const Scene dark = lit_by(std::nullopt);
    const auto is_dark = [&](std::optional<TracedMethod> method, Relighting relighting) {
        return shown(dark, method, relighting) == glm::vec3(0);
    };
    for (const auto& method : kMethods) {
        EXPECT_FALSE(is_dark(method, Relighting::kOff));
        EXPECT_EQ(is_dark(method, Relighting::kTraced), method.has_value());
    }
    EXPECT_FALSE(is_dark(TracedMethod::kToon, Relighting::kTraced));
    EXPECT_TRUE(is_dark(TracedMethod::kToon, Relighting::kOn));
    Scene headlit = dark;
    headlit.navigation.headlight = true;
    EXPECT_GT(shown(headlit, std::nullopt).r, 0.1F);
    EXPECT_GT(shown(headlit, TracedMethod::kPath).r, 0.1F);
}

// Lights that change give the same irradiance as a tracer that begins with them.
TEST_F(RelightingTest, IrradianceFollowsLightsAndMethod) {
    const std::vector<PlacedObject> objects{captured_drum()};
    const Scene red = lit_by(studio({1, 0.25F, 0.25F}));
    const TracedOptions options{.exposure_ev = 1, .relighting = Relighting::kTraced};
    auto edited = TracedRenderer::create(lit_by(std::nullopt), objects, options);
    const auto made = TracedRenderer::create(red, objects, options);
    ASSERT_TRUE(edited && made);
    edited->set_lights(red, 1);
    ASSERT_TRUE(edited->object_irradiance());
    EXPECT_EQ(edited->object_irradiance()->front().irradiance.factors,
              made->object_irradiance()->front().irradiance.factors);
    edited->set_method(TracedMethod::kToon);
    EXPECT_FALSE(edited->object_irradiance());
}

}  // namespace
}  // namespace rs::compositor
