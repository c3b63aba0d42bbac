// Worlds in VRML 1.0 or X3D against the same world in VRML97, by images. Skipped without OpenGL.

#include "compositor/scene/reader/vrml_file.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/compositor/gl_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rs::compositor {
namespace {

const std::string kVrml1 = "#VRML V1.0 ascii\n";
const std::string kVrml97 = "#VRML V2.0 utf8\n";

Scene scene_in_form(const std::string& text) {
    auto scene = scene_from_vrml(text, "world.wrl");
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    if (!scene) return {};
    EXPECT_THAT(scene->warnings, ::testing::IsEmpty());
    return std::move(*scene);
}

std::string world_of_xml(const std::string& nodes) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<X3D profile='Immersive' version='3.0'><head><meta "
           "name='title' content='a world'/></head><Scene>\n" +
           nodes + "\n</Scene></X3D>\n";
}

TEST(VrmlPoints, EachPointHasItsColour) {
    const Scene scene = scene_in_form(kVrml97 +
                                      "Shape { geometry PointSet { coord Coordinate { point [ -1 0 0, 0 0 0, 1 0 0 ] } "
                                      "color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] } } }");
    ASSERT_EQ(scene.geometry.size(), 1U);
    const std::vector<MeshVertex>& points = scene.geometry[0].mesh->vertices;
    ASSERT_EQ(points.size(), 3U);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(points[static_cast<std::size_t>(i)].position, glm::vec3(i - 1, 0, 0));
        EXPECT_FLOAT_EQ(points[static_cast<std::size_t>(i)].colour[i], 1);
        EXPECT_FLOAT_EQ(points[static_cast<std::size_t>(i)].colour[(i + 1) % 3], 0);
    }
}

class Forms : public test::GlTest {
protected:
    static Image<Rgba8> image_of(const Scene& scene, const Camera& camera) {
        auto compositor = FrameCompositor::create(scene, std::vector<PlacedObject>{},
                                                  {.width = camera.width, .height = camera.height});
        RS_CHECK(compositor.ok());
        auto frame = compositor->compose(camera);
        RS_CHECK(frame.ok());
        return std::move(*frame);
    }

    // PSNR over the pixels of both images; checks that they are not empty.
    static double agreement(const std::string& a, const std::string& b) {
        const Scene first = scene_in_form(a);
        const Scene second = scene_in_form(b);
        EXPECT_EQ(first.geometry.size(), second.geometry.size());
        constexpr int kWidth = 160, kHeight = 120;
        Camera camera;
        if (second.viewpoints.empty()) {
            const CameraPose pose = framing_pose(bounds_of(second), 0.8, 4.0 / 3);
            camera = look_at_camera(pose.eye + glm::dvec3(0.3, 0.5, 0) * glm::distance(pose.eye, pose.at), pose.at, 0.8,
                                    kWidth, kHeight);
        } else {
            EXPECT_EQ(first.viewpoints.size(), second.viewpoints.size());
            if (first.viewpoints.empty()) return 0;
            camera = camera_at(first.viewpoints.front(), kWidth, kHeight);
        }
        const Image<Rgba8> seen = image_of(first, camera);
        if (!second.viewpoints.empty()) camera = camera_at(second.viewpoints.front(), kWidth, kHeight);
        const Image<Rgba8> truth = image_of(second, camera);
        double squares = 0;
        int shown = 0;
        for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
            const Rgba8 p = seen.pixels()[i], q = truth.pixels()[i];
            for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b}) squares += d * d;
            shown += q != truth.pixels()[0];
        }
        EXPECT_GT(shown, 400);
        if (squares == 0) return 99;
        return 10 * std::log10(255.0 * 255 * 3 * static_cast<double>(truth.pixels().size()) / squares);
    }
};

constexpr double kFormsAgree_dB = 45;

TEST_F(Forms, Vrml1SolidsTransformsAndMaterials) {
    EXPECT_GE(agreement(kVrml1 + R"(
Separator {
  DEF BackgroundColor Info { string "0.2 0.3 0.4" }
  PerspectiveCamera { position 0 1 8 orientation 1 0 0 -0.1 heightAngle 0.7 }
  Material { diffuseColor 1 0.5 0 specularColor 0.4 0.4 0.4 shininess 0.6 }
  Translation { translation -2 0 0 }
  Cube { width 1 height 2 depth 0.5 }
  Separator {
    Transform { translation 1.5 0 0 rotation 0 1 0 0.6 scaleFactor 1 2 0.5 scaleOrientation 0 0 1 0.4 center 0.2 0 0 }
    DEF ball Sphere { radius 0.6 }
  }
  Rotation { rotation 0 0 1 0.5 }
  Scale { scaleFactor 1 0.5 2 }
  Translation { translation 3 0 0 }
  Material { diffuseColor 0 0.5 1 transparency 0.2 }
  Cone { parts SIDES bottomRadius 0.7 height 2 }
  MatrixTransform { matrix 0 1 0 0  -1 0 0 0  0 0 1.5 0  1.5 0.5 0.2 1 }
  Cylinder { parts (SIDES | TOP) radius 0.4 height 1 }
  Translation { translation 0 -2 0 }
  USE ball
})",
                        kVrml97 + R"(
Background { skyColor 0.2 0.3 0.4 }
Viewpoint { position 0 1 8 orientation 1 0 0 -0.1 fieldOfView 0.7 }
Transform { translation -2 0 0 children [
  Shape { appearance DEF orange Appearance { material Material { diffuseColor 1 0.5 0 specularColor 0.4 0.4 0.4 shininess 0.6 } }
          geometry Box { size 1 2 0.5 } }
  Transform { translation 1.5 0 0 rotation 0 1 0 0.6 scale 1 2 0.5 scaleOrientation 0 0 1 0.4 center 0.2 0 0
              children Shape { appearance USE orange geometry DEF ball Sphere { radius 0.6 } } }
  Transform { rotation 0 0 1 0.5 children Transform { scale 1 0.5 2 children Transform { translation 3 0 0 children [
    Shape { appearance DEF blue Appearance { material Material { diffuseColor 0 0.5 1 transparency 0.2 } }
            geometry Cone { bottom FALSE bottomRadius 0.7 height 2 } }
    Transform { translation 1.5 0.5 0.2 rotation 0 0 1 1.5707963 scale 1 1 1.5 children [
      Shape { appearance USE blue geometry Cylinder { bottom FALSE radius 0.4 height 1 } }
      Transform { translation 0 -2 0 children Shape { appearance USE blue geometry USE ball } } ] } ] } } } ] })"),
              kFormsAgree_dB);
}

TEST_F(Forms, Vrml1FacesWithBindings) {
    const std::string points = "point [ -1 -1 1, 1 -1 1, 1 1 1, -1 1 1, -1 -1 -1, 1 -1 -1, 1 1 -1, -1 1 -1 ]";
    const std::string faces = "coordIndex [ 0,1,2,3,-1, 5,4,7,6,-1, 4,0,3,7,-1, 1,5,6,2,-1, 3,2,6,7,-1, 4,5,1,0,-1 ]";
    const std::string colours = "[ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ]";
    EXPECT_GE(
        agreement(kVrml1 + "Separator { Coordinate3 { " + points + " } ShapeHints { vertexOrdering COUNTERCLOCKWISE " +
                      "shapeType SOLID creaseAngle 0 } Material { diffuseColor " + colours +
                      " } MaterialBinding { value PER_FACE } IndexedFaceSet { " + faces +
                      " } Translation { translation 3 0 0 } MaterialBinding { value PER_VERTEX_INDEXED } "
                      "IndexedFaceSet { coordIndex [ 0,1,2,3 ] materialIndex [ 0, 1, 2, 3 ] } "
                      "Translation { translation 0 0 -4 } MaterialBinding { value PER_FACE_INDEXED } "
                      "Normal { vector [ 0.6 0 0.8, 0 0.6 0.8 ] } NormalBinding { value PER_FACE_INDEXED } "
                      "IndexedFaceSet { coordIndex [ 0,1,2,-1, 0,2,3,-1 ] materialIndex [ 4, 5 ] "
                      "normalIndex [ 1, 0 ] } }",
                  kVrml97 +
                      "Shape { appearance Appearance { material Material { } } geometry IndexedFaceSet { coord "
                      "DEF c Coordinate { " +
                      points + " } color DEF colours Color { color " + colours + " } colorPerVertex FALSE " + faces +
                      " } } Transform { translation 3 0 0 children [ Shape { appearance Appearance { material "
                      "Material { } } geometry IndexedFaceSet { coord USE c color USE colours coordIndex [ 0 1 2 "
                      "3 ] colorIndex [ 0 1 2 3 ] } } Transform { translation 0 0 -4 children Shape { appearance "
                      "Appearance { material Material { } } geometry IndexedFaceSet { coord USE c color USE "
                      "colours colorPerVertex FALSE colorIndex [ 4 5 ] normal Normal { vector [ 0.6 0 0.8, 0 0.6 "
                      "0.8 ] } normalPerVertex FALSE normalIndex [ 1 0 ] coordIndex [ 0 1 2 -1 0 2 3 -1 ] } } } "
                      "] }"),
        kFormsAgree_dB);
}

TEST_F(Forms, Vrml1TexturesTextLinesAndLights) {
    const std::string image = "image 2 2 3 0xff0000 0x00ff00 0x0000ff 0xffff00";
    EXPECT_GE(
        agreement(
            kVrml1 +
                "Separator { DirectionalLight { direction 0 -1 -1 color 1 0.8 0.6 } PointLight { location 0 "
                "0 5 intensity 0.5 } Separator { Texture2 { " +
                image +
                " wrapS CLAMP } Texture2Transform { scaleFactor 2 2 translation 0.25 0 } "
                "TextureCoordinate2 { point [ 0 0, 1 0, 1 1, 0 1 ] } Coordinate3 { point [ -1 -1 0, 1 -1 0, "
                "1 1 0, -1 1 0 ] } IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1 ] } } Transform { "
                "translation -1 1.5 0 } FontStyle { size 1 family SANS style BOLD } AsciiText { string [ "
                "\"two\" lines ] justification CENTER } Material { diffuseColor 0 1 0 } Coordinate3 { "
                "point [ -2 0 0, 2 0 0, 0 1 0 ] } IndexedLineSet { coordIndex [ 0, 1, 2, -1 ] } PointSet { "
                "startIndex 1 numPoints 2 } Group { Translation { translation 2 -2 0 } } Cube { } }",
            kVrml97 +
                "DirectionalLight { direction 0 -1 -1 color 1 0.8 0.6 } PointLight { location 0 0 5 "
                "intensity 0.5 radius 1e9 } DEF plain Shape { appearance Appearance { material Material { } texture "
                "PixelTexture { " +
                image +
                " repeatS FALSE } textureTransform TextureTransform { scale 2 2 translation 0.125 0 } } "
                "geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ -1 -1 0, 1 -1 0, 1 1 0, "
                "-1 1 0 ] } texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } coordIndex [ 0 1 2 "
                "3 -1 ] } } Transform { translation -1 1.5 0 children [ Shape { appearance Appearance { "
                "material Material { } } geometry Text { string [ \"two\" \"lines\" ] fontStyle FontStyle { "
                "size 1 family \"SANS\" style \"BOLD\" justify \"MIDDLE\" } } } Shape { appearance DEF green "
                "Appearance { material Material { emissiveColor 0 1 0 } } geometry IndexedLineSet { coord "
                "Coordinate { point [ -2 0 0, 2 0 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 ] } } Shape { "
                "appearance USE green geometry PointSet { coord Coordinate { point [ 2 0 0, 0 1 0 ] } } } "
                "Transform { translation 2 -2 0 children Shape { appearance Appearance { material Material { "
                "diffuseColor 0 1 0 } } geometry Box { } } } ] }"),
        kFormsAgree_dB);
}

TEST_F(Forms, Vrml1SwitchesSeparatorsAndParts) {
    EXPECT_GE(agreement(
                  kVrml1 + "Separator { Switch { whichChild 1 Cube { } Sphere { } } LOD { "
                           "Separator { Translation { translation -3 0 0 } Cube { width 1 } } Sphere { radius 9 } } "
                           "TransformSeparator { Translation { "
                           "translation 3 0 0 } Material { diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] } MaterialBinding { "
                           "value PER_PART } Cylinder { } } "
                           "WWWAnchor { name \"x.wrl\" Translation { translation 0 "
                           "3 0 } Cube { } } Switch { Cube { width 20 } } }",
                  kVrml97 +
                      "Shape { appearance DEF grey Appearance { material Material { } } geometry Sphere { } } "
                      "Transform { translation 3 0 0 children [ Shape { appearance Appearance { material Material "
                      "{ diffuseColor 1 0 0 } } geometry Cylinder { top FALSE bottom FALSE } } Shape { appearance "
                      "Appearance { material Material { diffuseColor 0 1 0 } } geometry Cylinder { side FALSE "
                      "bottom FALSE } } Shape { appearance Appearance { material Material { diffuseColor 0 0 1 } "
                      "} geometry Cylinder { side FALSE top FALSE } } ] } Transform { translation -3 0 0 children "
                      "Shape { appearance DEF plain Appearance { material Material { } } "
                      "geometry Box { size 1 2 2 } } } Transform { translation 0 3 0 children [ " +
                      [] {
                          // The binding persists, as in VRML 1.0: each side of the cube has its own colour.
                          const char* sides[] = {
                              "-1 -1 1, 1 -1 1, 1 1 1, -1 1 1",     "1 -1 -1, -1 -1 -1, -1 1 -1, 1 1 -1",
                              "-1 -1 -1, -1 -1 1, -1 1 1, -1 1 -1", "1 -1 1, 1 -1 -1, 1 1 -1, 1 1 1",
                              "-1 1 1, 1 1 1, 1 1 -1, -1 1 -1",     "-1 -1 -1, 1 -1 -1, 1 -1 1, -1 -1 1"};
                          const char* colours[] = {"1 0 0", "0 1 0", "0 0 1"};
                          std::string all;
                          for (int i = 0; i < 6; ++i) {
                              all += std::string("Shape { appearance Appearance { material Material { diffuseColor ") +
                                     colours[i % 3] + " } } geometry IndexedFaceSet { coord Coordinate { point [ " +
                                     sides[i] + " ] } coordIndex [ 0 1 2 3 ] } } ";
                          }
                          return all;
                      }() +
                      "] }"),
              kFormsAgree_dB);
}

TEST_F(Forms, X3dNodesFieldsAndNames) {
    EXPECT_GE(agreement(world_of_xml(R"(
<Background skyColor='0.2 0.3 0.4'/>
<Viewpoint description='a "view"' position='0 1 8' orientation='1 0 0 -0.1' fieldOfView='0.7' centerOfRotation='0 0 0'/>
<WorldInfo title='t' info='"a" "b\"c"'/>
<Transform DEF='left' translation='-2 0 0'>
  <Shape><Appearance DEF='orange'><Material diffuseColor='1 0.5 0'/></Appearance><Box size='1 2 0.5'/></Shape>
</Transform>
<Transform translation='2 0 0' rotation='0 1 0 0.5'>
  <Shape><Sphere radius='0.6'/><Appearance USE='orange'/></Shape>
  <Switch whichChoice='1'><Shape><Cone/></Shape><Shape><Cylinder side='true' top='false' height='3' radius='0.2'/></Shape></Switch>
  <LOD range='5'><Shape><Text string='"X3D" "text"'><FontStyle justify='"MIDDLE" "END"' size='0.5'/></Text></Shape><Group/></LOD>
</Transform>
<TimeSensor DEF='clock'/><ROUTE fromNode='clock' fromField='time' toNode='left' toField='translation'/>
<Transform translation='0 2 0'><Transform USE='left'/></Transform>)"),
                        kVrml97 + R"(
Background { skyColor 0.2 0.3 0.4 }
Viewpoint { position 0 1 8 orientation 1 0 0 -0.1 fieldOfView 0.7 }
DEF left Transform { translation -2 0 0 children Shape { appearance DEF orange Appearance { material Material { diffuseColor 1 0.5 0 } } geometry Box { size 1 2 0.5 } } }
Transform { translation 2 0 0 rotation 0 1 0 0.5 children [
  Shape { appearance USE orange geometry Sphere { radius 0.6 } } Shape { geometry Cylinder { top FALSE height 3 radius 0.2 } }
  Shape { geometry Text { string [ "X3D" "text" ] fontStyle FontStyle { justify [ "MIDDLE" "END" ] size 0.5 } } } ] }
Transform { translation 0 2 0 children USE left })"),
              kFormsAgree_dB);
}

TEST_F(Forms, X3dSetsOfFaces) {
    const auto shape97 = [](const std::string& index, const std::string& rest) {
        return "Shape { appearance Appearance { material Material { } } geometry IndexedFaceSet { solid FALSE " + rest +
               " coordIndex [ " + index +
               " ] coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0.2, 0 1 0, 2 0.5 0, 2 1.5 0.4 ] } } } ";
    };
    const auto shape = [](const std::string& open, const std::string& colour) {
        const std::string type = open.substr(0, open.find(' '));
        return "<Shape><Appearance><Material/></Appearance><" + open +
               " solid='false'><Coordinate point='0 0 0, 1 0 0, 1 1 0.2, 0 1 0, 2 0.5 0, 2 1.5 0.4'/>" + colour + "</" +
               type + "></Shape>";
    };
    const std::string rgba = "<ColorRGBA color='1 0 0 1 0 1 0 0.5 0 0 1 1 1 1 0 1 0 1 1 1 1 0 1 1'/>";
    const std::string rgb = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] }";
    const std::string smooth = " creaseAngle 3.1416 ";
    EXPECT_GE(
        agreement(
            world_of_xml(
                "<Group>" + shape("IndexedTriangleSet index='0 1 2 0 2 3'", rgba) + "<Transform translation='3 0 0'>" +
                shape("TriangleStripSet stripCount='4'", "") + "</Transform><Transform translation='0 2 0'>" +
                shape("IndexedTriangleFanSet index='0 1 2 3 -1 1 4 5 2 -1'", rgba) +
                "</Transform><Transform translation='3 2 0'>" + shape("TriangleSet", "") +
                "</Transform><Transform translation='6 2 0'>" + shape("QuadSet", "") +
                "</Transform><Transform translation='6 0 0'><Shape><Rectangle2D size='2 1'/></Shape></Transform>"
                "</Group>"),
            kVrml97 + shape97("0 1 2 -1 0 2 3 -1", rgb + smooth) + "Transform { translation 3 0 0 children " +
                shape97("0 1 2 -1 2 1 3 -1", smooth) + "} Transform { translation 0 2 0 children " +
                shape97("0 1 2 -1 0 2 3 -1 1 4 5 -1 1 5 2 -1", rgb + smooth) +
                "} Transform { translation 3 2 0 children " + shape97("0 1 2 -1 3 4 5 -1", "") +
                "} Transform { translation 6 2 0 children " + shape97("0 1 2 3 -1", "") +
                "} Transform { translation 6 0 0 children Shape { geometry IndexedFaceSet { solid FALSE "
                "coordIndex [ 0 1 2 3 ] coord Coordinate { point [ -1 -0.5 0, 1 -0.5 0, 1 0.5 0, -1 0.5 0 "
                "] } } } }"),
        kFormsAgree_dB);
}

TEST_F(Forms, X3dPrototypes) {
    EXPECT_GE(agreement(world_of_xml(R"(
<ProtoDeclare name='Post'>
  <ProtoInterface>
    <field accessType='inputOutput' type='SFColor' name='colour' value='1 0 0'/>
    <field accessType='initializeOnly' type='SFFloat' name='size' value='1'/>
    <field accessType='inputOnly' type='SFBool' name='ignored'/>
    <field accessType='initializeOnly' type='MFNode' name='more'><Shape><Sphere radius='0.5'/></Shape></field>
  </ProtoInterface>
  <ProtoBody>
    <Group>
      <Shape><Cylinder><IS><connect nodeField='height' protoField='size'/></IS></Cylinder>
        <Appearance><Material><IS><connect nodeField='diffuseColor' protoField='colour'/></IS></Material></Appearance></Shape>
      <Transform translation='0 2 0'><IS><connect nodeField='children' protoField='more'/></IS></Transform>
    </Group>
  </ProtoBody>
</ProtoDeclare>
<ProtoInstance name='Post'/>
<Transform translation='3 0 0'><ProtoInstance name='Post' DEF='blue'>
  <fieldValue name='colour' value='0 0 1'/><fieldValue name='size' value='3'/>
  <fieldValue name='more'><Shape><Box/></Shape><Shape><Cone height='4'/></Shape></fieldValue>
</ProtoInstance></Transform>)"),
                        kVrml97 + R"(
Shape { appearance Appearance { material Material { diffuseColor 1 0 0 } } geometry Cylinder { height 1 } }
Transform { translation 0 2 0 children Shape { geometry Sphere { radius 0.5 } } }
Transform { translation 3 0 0 children [ Shape { appearance Appearance { material Material { diffuseColor 0 0 1 } } geometry Cylinder { height 3 } }
  Transform { translation 0 2 0 children [ Shape { geometry Box { } } Shape { geometry Cone { height 4 } } ] } ] })"),
              kFormsAgree_dB);
}

// The highlight of a rough metal covers all of it.
TEST_F(Forms, RoughMetalsHaveTheirVertexColours) {
    const Scene scene = scene_in_form(
        "#X3D V4.0 utf8\nPROFILE Full\nShape { appearance Appearance { material PhysicalMaterial { } } geometry "
        "TriangleSet { coord Coordinate { point [ -9 -9 0, 9 -9 0, 0 9 0 ] } color Color { color [ 1 0 0, 1 0 0, 1 0 "
        "0 ] } } }");
    ASSERT_EQ(scene.geometry.size(), 1U);
    const Image<Rgba8> image = image_of(scene, look_at_camera({0, 0, 5}, {0, 0, 0}, 0.8, 16, 16));
    EXPECT_GT(image(8, 8).r, 150);
    EXPECT_LT(image(8, 8).g, 30);
}

TEST_F(Forms, X3dInItsClassicEncoding) {
    EXPECT_GE(
        agreement(R"(#X3D V3.0 utf8
PROFILE Interchange
COMPONENT Geometry2D:1
META "title" "classic"
UNIT length metre 1
Switch { whichChoice 0 children [ Shape { geometry Box { size 1 1 1 } } ] }
Transform { translation 2 0 0 children Shape { geometry Sphere { } } }
)",
                  kVrml97 + "Shape { geometry Box { size 1 1 1 } } Transform { translation 2 0 0 children Shape { "
                            "geometry Sphere { } } }"),
        kFormsAgree_dB);
}

}  // namespace
}  // namespace rs::compositor
