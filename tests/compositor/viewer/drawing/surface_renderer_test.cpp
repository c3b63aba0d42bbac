// Colours of lit geometry against the formula of ISO/IEC 14772-1, 4.14.4, computed in linear light. Skipped without
// OpenGL.

#include "compositor/scene/reader/vrml_file.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/compositor/gl_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace rs::compositor {
namespace {

constexpr int kImage_px = 65;  // odd, so that the central pixel is centred
const glm::dvec3 kEye(0, 0, 5);

glm::dvec3 linear(const glm::dvec3& srgb) {
    return {linear_from_srgb(static_cast<float>(srgb.r)), linear_from_srgb(static_cast<float>(srgb.g)),
            linear_from_srgb(static_cast<float>(srgb.b))};
}

class Surfaces : public test::GlTest {
protected:
    Image<Rgba8> image_of(const std::string& body, const glm::dvec3& eye = kEye, bool wire_frame = false) {
        const Result<Scene> scene = scene_from_vrml("#VRML V2.0 utf8\n" + body, "test.wrl");
        RS_CHECK(scene.ok());
        EXPECT_THAT(scene->warnings, ::testing::IsEmpty());
        auto compositor = FrameCompositor::create(
            *scene, {}, {.width = kImage_px, .height = kImage_px, .samples = 4, .wire_frame = wire_frame});
        RS_CHECK(compositor.ok());
        Result<Image<Rgba8>> image =
            compositor->compose(look_at_camera(eye, {0, 0, 0}, radians(60), kImage_px, kImage_px));
        RS_CHECK(image.ok());
        statistics_ = compositor->statistics();
        return std::move(*image);
    }

    static Rgba8 middle(const Image<Rgba8>& image) { return image(kImage_px / 2, kImage_px / 2); }

    static void expect_colour(Rgba8 pixel, const glm::dvec3& light, const std::string& what) {
        const auto code = [](double l) { return int{srgb8_from_linear(static_cast<float>(l))}; };
        EXPECT_NEAR(pixel.r, code(light.r), 2) << what;
        EXPECT_NEAR(pixel.g, code(light.g), 2) << what;
        EXPECT_NEAR(pixel.b, code(light.b), 2) << what;
    }

    FrameStatistics statistics_;
};

// Square facing +Z through the origin, viewed from (0, 0, 5) by default.
std::string square(const std::string& appearance, const std::string& more = "") {
    return "Shape { appearance Appearance { " + appearance +
           " } geometry IndexedFaceSet { coord Coordinate { point [ -2 -2 0, 2 -2 0, 2 2 0, -2 2 0 ] } coordIndex [ 0 "
           "1 2 3 ] " +
           more + " } }\n";
}
constexpr const char* kNoHeadlight = "NavigationInfo { headlight FALSE }\n";
constexpr const char* kMaterial =
    "material Material { diffuseColor 0.8 0.4 0.2 specularColor 0.5 0.5 0.6 emissiveColor 0.1 0.2 0 ambientIntensity "
    "0.5 "
    "shininess 0.1 }";
const glm::dvec3 kDiffuse = linear({0.8, 0.4, 0.2});
const glm::dvec3 kSpecular = linear({0.5, 0.5, 0.6});
const glm::dvec3 kEmissive = linear({0.1, 0.2, 0});
constexpr double kExponent = 12.8;

// Contribution of one light at the origin of the square; vectors are of unit length.
glm::dvec3 reflected(const glm::dvec3& to_light, const glm::dvec3& to_eye, double intensity, double ambient) {
    const glm::dvec3 n(0, 0, 1);
    const double facing = std::max(glm::dot(n, to_light), 0.0);
    const glm::dvec3 between = glm::normalize(to_light + to_eye);
    const glm::dvec3 highlight =
        facing > 0 ? kSpecular * std::pow(std::max(glm::dot(n, between), 0.0), kExponent) : glm::dvec3(0);
    return kDiffuse * ambient * 0.5 + intensity * (kDiffuse * facing + highlight);
}

TEST_F(Surfaces, DirectionalLight) {
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(1, 0.5, 1));
    const std::string light = "DirectionalLight { direction -1 -0.5 -1 intensity 0.6 ambientIntensity 0.3 }\n";
    for (const glm::dvec3& eye : {kEye, glm::dvec3(-2, 1, 4)}) {
        expect_colour(middle(image_of(kNoHeadlight + light + square(kMaterial), eye)),
                      kEmissive + reflected(to_light, glm::normalize(eye), 0.6, 0.3), "directional");
    }
}

TEST_F(Surfaces, TheHeadlightGoesAlongWithTheViewer) {
    for (const glm::dvec3& eye : {kEye, glm::dvec3(3, 1, 3)}) {
        const glm::dvec3 to_eye = glm::normalize(eye);
        const glm::dvec3 light = kEmissive + reflected(to_eye, to_eye, 1, 0);
        expect_colour(middle(image_of(square(kMaterial), eye)), light, "headlight");
    }
}

TEST_F(Surfaces, PointLightsFallOffAndEndAtTheirRadius) {
    const glm::dvec3 place(0, 1, 2);
    const double d = glm::length(place);
    const std::string light = "PointLight { location 0 1 2 attenuation 0.5 0.25 0.125 ambientIntensity 0.2 radius ";
    const double strength = 1 / (0.5 + 0.25 * d + 0.125 * d * d);
    expect_colour(middle(image_of(kNoHeadlight + light + "3 }\n" + square(kMaterial))),
                  kEmissive + strength * reflected(place / d, {0, 0, 1}, 1, 0.2), "near");
    expect_colour(middle(image_of(kNoHeadlight + light + "2 }\n" + square(kMaterial))), kEmissive, "beyond its radius");
}

TEST_F(Surfaces, SpotLightsFallOffBetweenBeamAndCutOff) {
    const glm::dvec3 to_light(0, 0, 1);
    for (const double angle : {0.1, 0.4, 0.7}) {
        const std::string light = "SpotLight { location 0 0 3 direction " + std::to_string(std::sin(angle)) + " 0 " +
                                  std::to_string(-std::cos(angle)) + " beamWidth 0.2 cutOffAngle 0.6 }\n";
        const double spot = angle < 0.2 ? 1 : angle > 0.6 ? 0 : (0.6 - angle) / 0.4;
        expect_colour(middle(image_of(kNoHeadlight + light + square(kMaterial))),
                      kEmissive + spot * reflected(to_light, {0, 0, 1}, 1, 0), std::to_string(angle));
    }
    // A beam as wide as the cut-off has a sharp edge.
    expect_colour(middle(image_of(std::string(kNoHeadlight) + "SpotLight { location 0 0 3 direction 0.3 0 -1 }\n" +
                                  square(kMaterial))),
                  kEmissive + reflected(to_light, {0, 0, 1}, 1, 0), "default");
}

TEST_F(Surfaces, ManyLightsAddUp) {
    std::string lights;
    for (int i = 0; i < 40; ++i) lights += "DirectionalLight { direction 0 0 -1 intensity 0.01 }\n";
    expect_colour(middle(image_of(kNoHeadlight + lights + square(kMaterial))),
                  kEmissive + 40.0 * reflected({0, 0, 1}, {0, 0, 1}, 0.01, 0), "sum");
}

TEST_F(Surfaces, LightsOfAnotherGroupDoNotReachIt) {
    const std::string light = "Group { children DirectionalLight { direction 0 0 -1 } }\n";
    expect_colour(middle(image_of(kNoHeadlight + light + square(kMaterial))), kEmissive, "scope");
}

TEST_F(Surfaces, WithoutAMaterialNothingIsLit) {
    expect_colour(middle(image_of(square(""))), {1, 1, 1}, "unlit");
    const std::string colour = "color Color { color [ 0 0.5 1 ] } colorPerVertex FALSE";
    expect_colour(middle(image_of(kNoHeadlight + square("", colour))), linear({0, 0.5, 1}), "its own colour");
}

TEST_F(Surfaces, OneSidedFacesAreSeenFromTheirFrontOnly) {
    const glm::dvec3 behind(0, 0, -5);
    EXPECT_EQ(middle(image_of(square(""), behind)), (Rgba8{0, 0, 0, 255}));
    EXPECT_EQ(middle(image_of(square("", "ccw FALSE"))), (Rgba8{0, 0, 0, 255}));
    EXPECT_EQ(middle(image_of(square("", "ccw FALSE"), behind)), (Rgba8{255, 255, 255, 255}));
    EXPECT_EQ(middle(image_of(square("", "solid FALSE"), behind)), (Rgba8{255, 255, 255, 255}));
    // Mirroring reverses the corners' order, but front faces stay front faces.
    const std::string mirrored = "Transform { scale -1 1 1 children " + square("") + " }";
    EXPECT_EQ(middle(image_of(mirrored)), (Rgba8{255, 255, 255, 255}));
    EXPECT_EQ(middle(image_of(mirrored, behind)), (Rgba8{0, 0, 0, 255}));
}

TEST_F(Surfaces, BothSidesAreLit) {
    const glm::dvec3 front = kEmissive + reflected({0, 0, 1}, {0, 0, 1}, 1, 0);
    expect_colour(middle(image_of(square(kMaterial, "solid FALSE"), {0, 0, -5})), front, "behind");
}

TEST_F(Surfaces, NormalsFollowUnevenScales) {
    // A plane through the origin whose normal (1, 0, 1) becomes (0.5, 0, 1) when x is doubled.
    const std::string slope = "Transform { scale 2 1 1 children Shape { appearance Appearance { " +
                              std::string(kMaterial) +
                              " } geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ -2 -2 2, 2 -2 -2, 2 "
                              "2 -2, -2 2 2 ] } coordIndex [ 0 1 2 3 ] } } }";
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.5, 0, 1));
    const glm::dvec3 v(0, 0, 1);
    const glm::dvec3 light = kEmissive + kDiffuse * glm::dot(n, v) + kSpecular * std::pow(glm::dot(n, v), kExponent);
    expect_colour(middle(image_of(slope)), light, "slope");
}

TEST_F(Surfaces, ColouredImagesReplaceTheColourAndGreyOnesDarkenIt) {
    const std::string grey = "texture PixelTexture { image 1 1 1 128 }";
    const std::string red = "texture PixelTexture { image 1 1 3 0xff0000 }";
    const std::string matte = "material Material { diffuseColor 0.4 0.8 0.8 }";
    const glm::dvec3 colour = linear({0.4, 0.8, 0.8});
    expect_colour(middle(image_of(square(matte + grey))), colour * double{linear_from_srgb8(128)}, "grey");
    expect_colour(middle(image_of(square(matte + red))), {1, 0, 0}, "red");
}

TEST_F(Surfaces, ImagesStandUprightAndRepeat) {
    // Red below green.
    const std::string image = "texture PixelTexture { image 1 2 3 0xff0000 0x00ff00 repeatT ";
    const auto upright = image_of(square(image + "FALSE }"));
    EXPECT_GT(upright(kImage_px / 2, kImage_px / 4).g, 200);
    EXPECT_GT(upright(kImage_px / 2, kImage_px * 3 / 4).r, 200);
    // Translated by one half and repeated, the colours swap; without repetition the border continues.
    const std::string moved = "textureTransform TextureTransform { translation 0 0.5 }";
    EXPECT_GT(image_of(square(image + "TRUE }" + moved))(kImage_px / 2, kImage_px * 2 / 5).r, 200);
    EXPECT_GT(image_of(square(image + "FALSE }" + moved))(kImage_px / 2, kImage_px * 2 / 5).g, 200);
}

TEST_F(Surfaces, TransparentOnesAreBlendedFromBehindInLinearLight) {
    const auto pane = [](const std::string& colour, double z) {
        return "Transform { translation 0 0 " + std::to_string(z) + " children " +
               square("material Material { diffuseColor 0 0 0 emissiveColor " + colour + " transparency 0.5 }") +
               " }\n";
    };
    const glm::dvec3 expected = 0.5 * glm::dvec3(1, 0, 0) + 0.25 * glm::dvec3(0, 1, 0);
    // Independent of the order in the file; the wall behind both is black.
    expect_colour(middle(image_of(pane("1 0 0", 1) + pane("0 1 0", -1))), expected, "near first");
    expect_colour(middle(image_of(pane("0 1 0", -1) + pane("1 0 0", 1))), expected, "far first");
    const std::string wall = "Transform { translation 0 0 0.5 children " + square("") + " }";
    expect_colour(middle(image_of(pane("0 1 0", -1) + pane("1 0 0", 1) + wall)), {1, 0.5, 0.5}, "a wall between");
}

TEST_F(Surfaces, AlphaOfImagesCutsHoles) {
    const std::string hole = "texture PixelTexture { image 2 1 4 0xff0000ff 0x00ff0000 repeatS FALSE }";
    const Image<Rgba8> image = image_of(square(hole));
    EXPECT_EQ(image(kImage_px / 5, kImage_px / 2), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(image(kImage_px * 4 / 5, kImage_px / 2), (Rgba8{0, 0, 0, 255}));
}

TEST_F(Surfaces, FogHidesWhatIsFar) {
    const std::string fog = "Fog { color 0 0 1 visibilityRange 20 fogType ";
    expect_colour(middle(image_of(fog + "\"LINEAR\" }\n" + square(""))), {0.75, 0.75, 1}, "linear");
    const double kept = std::exp(-5.0 / 15);
    expect_colour(middle(image_of(fog + "\"EXPONENTIAL\" }\n" + square(""))), {kept, kept, 1}, "exponential");
    expect_colour(middle(image_of("Fog { color 0 0 1 visibilityRange 5 }\n" + square(""))), {0, 0, 1}, "all");
}

TEST_F(Surfaces, TheBackgroundIsAGradientFromZenithToNadir) {
    const std::string sky =
        "Background { skyColor [ 1 0 0, 0 1 0 ] skyAngle 1.5707963 groundColor [ 0 0 1, 0 0 0 ] groundAngle 1.2 }";
    const glm::dvec3 ahead(0, 0, 5);
    const Image<Rgba8> level = image_of(sky, ahead);
    expect_colour(middle(level), {0, 1, 0}, "horizon");
    // Ray of the topmost row's centre.
    const double up = std::atan(std::tan(radians(30)) * (kImage_px - 1) / kImage_px);
    const double t = (kPi / 2 - up) / (kPi / 2);
    expect_colour(level(kImage_px / 2, 0), {1 - t, t, 0}, "above");
    const double from_nadir = kPi / 2 - up;
    const double g = from_nadir / 1.2;
    expect_colour(level(kImage_px / 2, kImage_px - 1), {0, 0, 1 - g}, "below");
}

TEST_F(Surfaces, WhatIsOutsideOfTheImageIsNotDrawn) {
    image_of(
        "Transform { translation 40 0 0 children Shape { geometry Box { } } }\nTransform { translation 0 0 9 children "
        "Shape "
        "{ geometry Box { } } }\nTransform { translation 2.9 0 0 children Shape { geometry Box { } } }");
    EXPECT_EQ(statistics_.geometry_in_view, 1);
}

TEST_F(Surfaces, LinesAndPointsShowTheirColour) {
    const std::string line =
        "Shape { appearance Appearance { material Material { emissiveColor 1 0 0 } } geometry IndexedLineSet { coord "
        "Coordinate { "
        "point [ -2 0 0, 2 0 0 ] } coordIndex [ 0 1 ] } }";
    EXPECT_GT(middle(image_of(line)).r, 100);
    const std::string point =
        "Shape { geometry PointSet { coord Coordinate { point [ 0 0 0 ] } color Color { color [ 0 1 0 ] } } }";
    EXPECT_GT(middle(image_of(point)).g, 100);
}

TEST_F(Surfaces, AWireFrameHasEdgesOnly) {
    const auto lit_pixels = [](const Image<Rgba8>& image) {
        return std::count_if(image.pixels().begin(), image.pixels().end(), [](Rgba8 pixel) { return pixel.r > 20; });
    };
    const auto solid = lit_pixels(image_of(square("")));
    const auto wire = lit_pixels(image_of(square(""), kEye, true));
    EXPECT_GT(wire, kImage_px);
    EXPECT_LT(wire, solid / 3);
}

}  // namespace
}  // namespace rs::compositor
