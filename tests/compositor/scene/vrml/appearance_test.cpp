#include "compositor/scene/reader/vrml_file.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Scene of one shape in X3D's classic encoding.
Scene shape_with(const std::string& appearance, const std::string& geometry = "Box { }") {
    const Result<Scene> scene = scene_from_vrml("#X3D V4.0 utf8\nPROFILE Full\nShape { appearance Appearance { " +
                                                    appearance + " } geometry " + geometry + " }",
                                                "world.x3dv");
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? *scene : Scene{};
}

constexpr const char* kTwoPixels = "PixelTexture { image 2 1 4 0x80402000 0xffffffff }";

TEST(Appearance, PhysicalMaterialsAreThoseOfGltf) {
    const Scene scene =
        shape_with(std::string("material PhysicalMaterial { baseColor 0.5 0.25 1 metallic 0 "
                               "roughness 0.5 emissiveColor 0.1 0 0 transparency 0.25 baseTexture ") +
                   kTwoPixels + " emissiveTexture " + kTwoPixels + " normalTexture " + kTwoPixels + " }");
    EXPECT_THAT(scene.warnings, IsEmpty());
    const Material& material = scene.geometry.at(0).material;
    EXPECT_TRUE(material.lit);
    EXPECT_EQ(material.diffuse, glm::vec3(0.5F, 0.25F, 1));
    EXPECT_EQ(material.specular, glm::vec3(0.04F));
    EXPECT_FLOAT_EQ(material.shininess * 128, 30);
    EXPECT_FLOAT_EQ(material.opacity, 0.75F);
    ASSERT_TRUE(material.texture);
    EXPECT_TRUE(material.texture->modulates);
    EXPECT_EQ(material.texture->image(0, 0), (Rgba8{0x80, 0x40, 0x20, 0}));
    EXPECT_TRUE(material.normals);
    EXPECT_TRUE(material.emission_texture);
    ASSERT_TRUE(material.surface);
    EXPECT_EQ(material.surface->kind, rs::SurfaceKind::glossy);
    EXPECT_EQ(material.surface->colour, glm::vec3(0.5F, 0.25F, 1));
    EXPECT_FLOAT_EQ(material.surface->roughness, 0.5F);
    EXPECT_EQ(material.surface->emission, glm::vec3(0.1F, 0, 0));
}

TEST(Appearance, MetallicRoughnessTexturesCountByTheirMean) {
    const Scene scene = shape_with(
        "material PhysicalMaterial { metallicRoughnessTexture PixelTexture { image 1 2 3 0x003300 0x00cc00 } }");
    const Material& material = scene.geometry.at(0).material;
    ASSERT_TRUE(material.surface);
    EXPECT_EQ(material.surface->kind, rs::SurfaceKind::glossy);
    EXPECT_FLOAT_EQ(material.surface->roughness, 0.5F);
    const Scene bare = shape_with("material PhysicalMaterial { }");
    EXPECT_EQ(bare.geometry.at(0).material.surface->kind, rs::SurfaceKind::metal);
}

TEST(Appearance, UnlitMaterialsShowTheirEmissiveColour) {
    const std::string material = "material UnlitMaterial { emissiveColor 0.5 1 0 ";
    const Scene scene = shape_with(material + "emissiveTexture " + kTwoPixels + " }");
    EXPECT_THAT(scene.warnings, IsEmpty());
    const Material& unlit = scene.geometry.at(0).material;
    EXPECT_FALSE(unlit.lit);
    EXPECT_FLOAT_EQ(unlit.diffuse.r, linear_from_srgb(0.5F));
    EXPECT_EQ(unlit.emissive, glm::vec3(0));
    ASSERT_TRUE(unlit.texture);
    EXPECT_TRUE(unlit.texture->modulates);
    const Scene points = shape_with(material + "}", "PointSet { coord Coordinate { point 0 0 0 } }");
    EXPECT_EQ(points.geometry.at(0).material.diffuse, unlit.diffuse);
}

TEST(Appearance, AlphaModesMakeTexturesOpaqueOrCutHoles) {
    const auto texture_with = [](const std::string& mode) {
        return shape_with(mode +
                          " material Material { diffuseTexture PixelTexture { image 2 1 4 0xff000050 "
                          "0xff0000a0 } }")
            .geometry.at(0)
            .material.texture;
    };
    EXPECT_EQ(texture_with("")->image(0, 0).a, 0x50);
    EXPECT_FALSE(texture_with("alphaMode \"OPAQUE\"")->has_alpha);
    const auto mask = texture_with("alphaMode \"MASK\" alphaCutoff 0.4");
    EXPECT_EQ(mask->image(0, 0).a, 0);
    EXPECT_EQ(mask->image(1, 0).a, 255);
    EXPECT_THAT(shape_with("alphaMode \"GLOW\" material Material { }").warnings,
                ElementsAre(HasSubstr("alphaMode 'GLOW' is unknown; AUTO is used")));
}

TEST(Appearance, TexturesThatAreNotDrawnAreNamed) {
    const Scene scene =
        shape_with(std::string("backMaterial Material { } material PhysicalMaterial { ") + "occlusionTexture " +
                   kTwoPixels + " baseTexture ImageTexture { url \"gone.png\" } }");
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("line 3: Appearance: backMaterial is not drawn"),
                                            HasSubstr("line 3: ImageTexture: "),
                                            HasSubstr("PhysicalMaterial: occlusionTexture is not drawn; left out")));
}

TEST(Appearance, NodesInXmlGoToTheFieldsOfTheirContainer) {
    const auto scene = scene_from_vrml(
        "<X3D version='4.0'><Scene><Shape><Appearance><Material/><Material containerField='backMaterial' "
        "diffuseColor='1 0 0'/></Appearance><Box/></Shape><Shape><Appearance><PhysicalMaterial metallic='0'>"
        "<PixelTexture containerField='normalTexture' image='1 1 3 0x8080ff'/><PixelTexture containerField="
        "'baseTexture' image='1 1 3 0x123456'/></PhysicalMaterial></Appearance><Box/></Shape></Scene></X3D>",
        "world.x3d");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("backMaterial is not drawn")));
    EXPECT_EQ(scene->geometry.at(0).material.diffuse, glm::vec3(linear_from_srgb(0.8F)));
    const Material& physical = scene->geometry.at(1).material;
    ASSERT_TRUE(physical.texture);
    EXPECT_EQ(physical.texture->image(0, 0), (Rgba8{0x12, 0x34, 0x56, 255}));
    ASSERT_TRUE(physical.normals);
    EXPECT_EQ(physical.normals->directions(0, 0), (RgbaF{0, 0, 1, 1}));
}

}  // namespace
}  // namespace rs::compositor
