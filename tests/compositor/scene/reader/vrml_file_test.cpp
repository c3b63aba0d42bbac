#include "compositor/scene/reader/vrml_file.hpp"

#include "rayspace/image/linear_light.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/temporary_folder.hpp"

#include <zlib.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

namespace rs::compositor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene scene_of(const std::string& body) {
    const Result<Scene> scene = scene_from_vrml("#VRML V2.0 utf8\n" + body, "worlds/hall.wrl");
    EXPECT_TRUE(scene) << scene.error().message;
    return scene ? *scene : Scene{};
}

glm::dvec3 moved(const GeometryNode& node, const glm::dvec3& p) {
    return glm::dvec3(node.world_from_node * glm::dvec4(p, 1));
}

// Area and mean direction of the triangles, from the order of their corners.
glm::dvec3 area_vector(const Mesh& mesh) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position); };
        sum += glm::cross(corner(1) - corner(0), corner(2) - corner(0)) * 0.5;
    }
    return sum;
}

TEST(VrmlFile, TransformsAreChainedInTheOrderOfTheStandard) {
    const Scene scene = scene_of(
        "Transform { translation 1 2 3 rotation 0 0 1 1.5707963 scale 2 1 1 center 1 0 0 children "
        "Transform { scale 1 1 3 translation 0 0 5 children Shape { geometry Box { } } } }");
    ASSERT_EQ(scene.geometry.size(), 1U);
    // (2, 0, 1): scaled to (2, 0, 3), translated to z 8; about the centre (1, 0, 0): (1, 0, 8) scaled to (2, 0, 8),
    // rotated to (0, 2, 8), back (1, 2, 8), translated (2, 4, 11).
    EXPECT_LT(glm::distance(moved(scene.geometry[0], {2, 0, 1}), glm::dvec3(2, 4, 11)), 1e-6);
}

TEST(VrmlFile, ScaleOrientationTurnsTheAxesOfTheScale) {
    const Scene scene =
        scene_of("Transform { scale 2 1 1 scaleOrientation 0 0 1 0.78539816 children Shape { geometry Box { } } }");
    EXPECT_LT(glm::distance(moved(scene.geometry.at(0), {1, 1, 0}), glm::dvec3(2, 2, 0)), 1e-6);
    EXPECT_LT(glm::distance(moved(scene.geometry.at(0), {1, -1, 0}), glm::dvec3(1, -1, 0)), 1e-6);
}

TEST(VrmlFile, ARaySpaceNodeHasItsChainOfTransforms) {
    const Scene scene = scene_of(
        "DEF Stand Transform { translation 1 0 0 rotation 0 1 0 1.5707963 children Transform { translation 0 0 2 "
        "center 0 1 0 "
        "scale 3 3 3 children DEF Vase RaySpace { url [ \"objects/vase.rso\" \"other.rso\" ] size 0.5 standing FALSE } "
        "} }\n"
        "Transform { translation 0 7 0 children USE Vase }");
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].file, "worlds/objects/vase.rso");
    EXPECT_EQ(scene.objects[0].description, "Vase");
    EXPECT_FALSE(scene.objects[0].standing);
    EXPECT_THAT(scene.warnings, IsEmpty());
    // (0, 2, 4) of the object: halved (0, 1, 2), scaled about (0, 1, 0) to (0, 1, 6), translated (0, 1, 8), rotated (8,
    // 1, 0), translated (9, 1, 0).
    const Similarity world_from_object = world_from_node(scene.objects[0].chain);
    EXPECT_LT(glm::distance(world_from_object.point({0, 2, 4}), glm::dvec3(9, 1, 0)), 1e-6);
    EXPECT_DOUBLE_EQ(world_from_object.scale, 1.5);
    EXPECT_LT(glm::distance(world_from_node(scene.objects[1].chain).point({0, 2, 0}), glm::dvec3(0, 8, 0)), 1e-6);
}

TEST(VrmlFile, RoomsHaveTheirObjectsAndBoxes) {
    const Scene scene = scene_of(
        "RaySpace { url \"fountain.rso\" }\n"
        "Transform { translation 10 0 0 children RaySpaceRoom { description \"hall\" bboxCenter 0 1 0 bboxSize 4 2 6 "
        "children [ RaySpace { url \"a.rso\" } DEF Cabinet RaySpaceRoom { children [ Shape { geometry Box { } } "
        "Transform { translation 0 3 0 children RaySpace { url \"b.rso\" size 0.5 } } ] } ] } }\n"
        "RaySpace { url \"c.rso\" }");
    EXPECT_THAT(scene.warnings, IsEmpty());
    ASSERT_EQ(scene.rooms.size(), 2U);
    ASSERT_EQ(scene.objects.size(), 4U);
    EXPECT_FALSE(scene.objects[0].room);
    EXPECT_EQ(scene.objects[1].room, 0U);
    EXPECT_EQ(scene.objects[2].room, 1U);
    EXPECT_FALSE(scene.objects[3].room);
    EXPECT_EQ(scene.rooms[0].description, "hall");
    EXPECT_EQ(scene.rooms[0].box.lowest, glm::dvec3(8, 0, -3));
    EXPECT_EQ(scene.rooms[0].box.highest, glm::dvec3(12, 2, 3));
    EXPECT_EQ(scene.rooms[1].description, "Cabinet");
    EXPECT_EQ(scene.rooms[1].box.lowest, glm::dvec3(9, -1, -1)) << "of what it holds";
    EXPECT_EQ(scene.rooms[1].box.highest, glm::dvec3(11, 3.5, 1));
    EXPECT_EQ(scene.geometry.size(), 1U);
}

TEST(VrmlFile, ARaySpaceNodeThatCannotBeShownIsSaid) {
    const Scene scene = scene_of(
        "RaySpace { }\nRaySpace { url \"a.rso\" size 0 }\nRaySpace { url \"http://a/b.rso\" }\n"
        "Transform { scale 1 2 1 children RaySpace { url \"a.rso\" } }");
    EXPECT_EQ(scene.objects.size(), 1U);
    EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("line 2: RaySpace: has no url of a local file"),
                                            HasSubstr("line 3: RaySpace: its size"),
                                            HasSubstr("line 4: RaySpace: has no url of a local file"),
                                            HasSubstr("line 5: RaySpace: is stretched")));
}

TEST(VrmlFile, MaterialsAreLinearLight) {
    const Scene scene = scene_of(
        "Shape { appearance Appearance { material Material { diffuseColor 0.5 0 1 specularColor 0.25 0.25 0.25 "
        "emissiveColor 0 0.1 0 "
        "ambientIntensity 0.4 shininess 0.7 transparency 0.25 } } geometry Box { } } Shape { geometry Box { } }");
    ASSERT_EQ(scene.geometry.size(), 2U);
    const Material& material = scene.geometry[0].material;
    EXPECT_FLOAT_EQ(material.diffuse.r, linear_from_srgb(0.5F));
    EXPECT_FLOAT_EQ(material.specular.g, linear_from_srgb(0.25F));
    EXPECT_FLOAT_EQ(material.emissive.g, linear_from_srgb(0.1F));
    EXPECT_FLOAT_EQ(material.ambient, 0.4F);
    EXPECT_FLOAT_EQ(material.shininess, 0.7F);
    EXPECT_FLOAT_EQ(material.opacity, 0.75F);
    EXPECT_TRUE(material.lit);
    // Without a material: white, unlit.
    EXPECT_FALSE(scene.geometry[1].material.lit);
    EXPECT_EQ(scene.geometry[1].material.diffuse, glm::vec3(1));
}

TEST(VrmlFile, DirectionalLightsShineOnTheirGroupOnly) {
    const Scene scene = scene_of(
        "Group { children [ Shape { geometry Box { } } DirectionalLight { direction 0 -2 0 intensity 0.5 "
        "ambientIntensity 0.25 } "
        "Group { children Shape { geometry Cone { } } } ] } Shape { geometry Sphere { } } DEF lamp PointLight { } "
        "DirectionalLight { on FALSE }");
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_FALSE(scene.lights[0].everywhere);
    EXPECT_EQ(scene.lights[0].towards, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene.lights[0].colour, glm::vec3(0.5F));
    EXPECT_EQ(scene.lights[0].ambient, glm::vec3(0.25F));
    EXPECT_TRUE(scene.lights[1].everywhere);
    EXPECT_EQ(scene.lights[0].name, "");
    EXPECT_EQ(scene.lights[1].name, "lamp");
    ASSERT_EQ(scene.geometry.size(), 3U);
    EXPECT_THAT(scene.geometry[0].lights, ElementsAre(0U));
    EXPECT_THAT(scene.geometry[1].lights, ElementsAre(0U));
    EXPECT_THAT(scene.geometry[2].lights, IsEmpty());
}

TEST(VrmlFile, LightsOfX3DAreGlobalOrShineOnTheirGroup) {
    const Scene scene = scene_of(
        "Group { children [ Shape { geometry Box { } } DirectionalLight { global TRUE } PointLight { global FALSE } ] "
        "} "
        "Shape { geometry Sphere { } }");
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.lights[0].kind, LightKind::kPoint);
    EXPECT_FALSE(scene.lights[0].everywhere);
    EXPECT_EQ(scene.lights[1].kind, LightKind::kDirectional);
    EXPECT_TRUE(scene.lights[1].everywhere);
    EXPECT_THAT(scene.geometry[0].lights, ElementsAre(0U));
    EXPECT_THAT(scene.geometry[1].lights, IsEmpty());
}

TEST(VrmlFile, LightsAreMovedAndScaledWithTheirParents) {
    const Scene scene = scene_of(
        "Transform { translation 1 0 0 scale 2 2 2 children SpotLight { location 0 1 0 direction 1 0 0 radius 10 "
        "attenuation 1 1 1 cutOffAngle 0.5 beamWidth 0.25 } }");
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_LT(glm::distance(scene.lights[0].location, glm::dvec3(1, 2, 0)), 1e-9);
    EXPECT_DOUBLE_EQ(scene.lights[0].radius, 20);
    EXPECT_LT(glm::distance(scene.lights[0].attenuation, glm::vec3(1, 0.5F, 0.25F)), 1e-6F);
}

TEST(VrmlFile, TheSurroundingsAreRead) {
    const Scene scene = scene_of(
        "Background { skyColor [ 0 0 1, 1 1 1 ] skyAngle 1.2 groundColor [ 0 1 0, 1 0 0 ] groundAngle 1.5 }\n"
        "Background { skyColor 1 0 0 }\nFog { color 1 1 1 fogType \"EXPONENTIAL\" visibilityRange 30 }\n"
        "NavigationInfo { headlight FALSE type [ \"FLY\" ] speed 3 }\n"
        "Transform { translation 0 0 5 scale 2 2 2 children [ Viewpoint { description \"a\" position 0 1 0 orientation "
        "0 1 0 1.5707963 "
        "fieldOfView 1 } ] } Viewpoint { description \"b\" }");
    EXPECT_THAT(scene.background.sky, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(1, 1, 1)));
    EXPECT_EQ(background_colour(scene.background, {0, 1, 0}), glm::vec3(0, 0, 1));
    EXPECT_EQ(background_colour(scene.background, {0, -1, 0}), glm::vec3(0, 1, 0));
    const glm::vec3 halfway = background_colour(scene.background, {std::sin(0.6), std::cos(0.6), 0});
    EXPECT_LT(glm::distance(halfway, glm::vec3(0.5F, 0.5F, 1)), 1e-5F);
    ASSERT_TRUE(scene.fog);
    EXPECT_EQ(scene.fog->kind, FogKind::kExponential);
    EXPECT_EQ(scene.fog->visibility, 30);
    EXPECT_FALSE(scene.navigation.headlight);
    EXPECT_EQ(scene.navigation.speed, 3);
    ASSERT_EQ(scene.viewpoints.size(), 2U);
    EXPECT_EQ(scene.viewpoints[0].description, "a");
    EXPECT_EQ(scene.viewpoints[0].field_of_view_rad, 1);
    EXPECT_LT(glm::distance(glm::dvec3(scene.viewpoints[0].world_from_camera[3]), glm::dvec3(0, 2, 5)), 1e-6);
    // The view direction is -X.
    EXPECT_LT(glm::distance(-glm::dvec3(scene.viewpoints[0].world_from_camera[2]), glm::dvec3(-1, 0, 0)), 1e-6);
    EXPECT_LT(glm::distance(glm::dvec3(scene.viewpoints[1].world_from_camera[3]), glm::dvec3(0, 0, 10)), 1e-6);
    EXPECT_TRUE(scene_of("").navigation.headlight);
}

TEST(VrmlFile, FacesAreCutAndColoured) {
    const std::string coord = "coord Coordinate { point [ 0 0 0, 2 0 0, 2 1 0, 0 1 0 ] }";
    const Scene scene = scene_of("Shape { geometry IndexedFaceSet { " + coord +
                                 " coordIndex [ 0 1 2 3 ] } }\n"
                                 "Shape { geometry IndexedFaceSet { " +
                                 coord +
                                 " coordIndex [ 3 2 1 0 ] ccw FALSE solid FALSE } }\n"
                                 "Shape { geometry IndexedFaceSet { " +
                                 coord +
                                 " coordIndex [ 0 1 2 -1 0 2 3 -1 0 1 ] colorPerVertex FALSE "
                                 "color Color { color [ 1 0 0, 0 0 1, 0 0 0 ] } texCoord TextureCoordinate { point [ 0 "
                                 "0, 0.5 0, 1 1, 0 1 ] } } }");
    ASSERT_EQ(scene.geometry.size(), 3U);
    for (const GeometryNode& node : scene.geometry) {
        EXPECT_EQ(node.mesh->indices.size(), 6U);
        EXPECT_LT(glm::distance(area_vector(*node.mesh), glm::dvec3(0, 0, 2)), 1e-6) << "the front is on the +Z side";
        for (const MeshVertex& vertex : node.mesh->vertices) {
            EXPECT_LT(glm::distance(vertex.normal, glm::vec3(0, 0, 1)), 1e-5F);
        }
    }
    EXPECT_FALSE(scene.geometry[0].mesh->two_sided);
    EXPECT_TRUE(scene.geometry[1].mesh->two_sided);
    EXPECT_FALSE(scene.geometry[0].mesh->has_colours);
    // Without texture coordinates: s along the longer side, 0..1.
    const Mesh& plain = *scene.geometry[0].mesh;
    for (const MeshVertex& vertex : plain.vertices) {
        EXPECT_LT(glm::distance(vertex.texture, glm::vec2(vertex.position) / 2.0F), 1e-5F);
    }
    const Mesh& coloured = *scene.geometry[2].mesh;
    EXPECT_TRUE(coloured.has_colours);
    EXPECT_EQ(glm::vec3(coloured.vertices[coloured.indices[0]].colour), glm::vec3(1, 0, 0));
    EXPECT_EQ(glm::vec3(coloured.vertices[coloured.indices[3]].colour), glm::vec3(0, 0, 1));
    for (const MeshVertex& vertex : coloured.vertices) {
        const bool is_lower_right = vertex.position.x == 2 && vertex.position.y == 0;
        EXPECT_EQ(vertex.texture == glm::vec2(0.5F, 0), is_lower_right);
    }
}

TEST(VrmlFile, ElevationGridsAreColoured) {
    const auto grid = [](const std::string& fields) {
        return scene_of("Shape { geometry ElevationGrid { xDimension 3 zDimension 3 xSpacing 0.5 zSpacing 2 " + fields +
                        " height [ 0 1 0 0 0 2 0 0 0 ] } }");
    };
    const Scene corners =
        grid("color Color { color [ 0 0 0, 0 0 1, 0 0 0, 0 1 0, 0 0 0, 0 1 1, 1 0 0, 1 0 1, 1 1 0 ] }");
    ASSERT_EQ(corners.geometry.size(), 1U);
    ASSERT_TRUE(corners.geometry[0].mesh->has_colours);
    for (const MeshVertex& vertex : corners.geometry[0].mesh->vertices) {
        const auto i = static_cast<std::size_t>(std::lround(vertex.position.x / 0.5F + 3 * vertex.position.z / 2));
        const std::array<glm::vec3, 9> colours = {glm::vec3{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 1, 0}, {0, 0, 0},
                                                  {0, 1, 1},          {1, 0, 0}, {1, 0, 1}, {1, 1, 0}};
        EXPECT_EQ(glm::vec3(vertex.colour), colours.at(i)) << i;
    }
    const Scene faces = grid("colorPerVertex FALSE color Color { color [ 0 0 1, 0 1 0, 1 0 0, 1 1 1 ] }");
    ASSERT_EQ(faces.geometry.size(), 1U);
    const Mesh& mesh = *faces.geometry[0].mesh;
    EXPECT_EQ(mesh.indices.size(), 24U);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < 3; ++k) middle += mesh.vertices[mesh.indices[i + k]].position / 3.0F;
        const std::array<glm::vec3, 4> colours = {glm::vec3{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}};
        const std::size_t quad = (middle.x > 0.5F ? 1U : 0U) + (middle.z > 2 ? 2U : 0U);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(glm::vec3(mesh.vertices[mesh.indices[i + k]].colour), colours.at(quad));
        }
    }
}

TEST(VrmlFile, NodesOfX3DThatAreNotKnownAreNamed) {
    const auto scene = scene_from_vrml(
        "<X3D version='3.3'><Scene>\n<Shape><ArcClose2D/>\n<Appearance><LineProperties DEF='thick'/><Material/>"
        "</Appearance><Box/></Shape>\n<Wiggle><Shape><Box/></Shape></Wiggle></Scene></X3D>",
        "world.x3d");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->geometry.size(), 2U);
    EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("line 2: Shape has no field 'ArcClose2D'"),
                                             HasSubstr("line 3: Appearance has no field 'LineProperties'"),
                                             HasSubstr("line 4: 'Wiggle' is an unknown node")));
}

// A world in several encodings and line ends; each must be read without a warning.
TEST(VrmlFile, EncodingsLineEndsAndNamespacesAreRead) {
    using namespace std::string_literals;
    const std::string mark = "\xef\xbb\xbf";
    const std::string nodes =
        "<x3d:Scene>\r\n<x3d:Group><x3d:Shape DEF='a'><x3d:Box/></x3d:Shape></x3d:Group>"
        "<x3d:Shape USE='a'/></x3d:Scene></x3d:X3D>";
    const std::string prefixed = "<x3d:X3D xmlns:x3d='http://www.web3d.org/specifications/x3d-4.0.xsd'>" + nodes;
    std::string utf16 = "\xff\xfe";
    for (const char c : prefixed) utf16 += c + "\0"s;
    const std::string body = "DEF a Shape { geometry Box { } }\r\nUSE a\r\n";
    for (const std::string& text :
         {prefixed, mark + prefixed, utf16, mark + "#VRML V2.0 utf8\r\n" + body, "#VRML V2.0 utf8\r" + body,
          mark + "#X3D V4.0 utf8\r\nPROFILE Interactive\r\n" + body,
          mark + "#VRML V1.0 ascii\r\nSeparator { DEF a Cube { }\r\nUSE a }"}) {
        SCOPED_TRACE(text);
        const Result<Scene> scene = scene_from_vrml(text, "hall.wrl");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_THAT(scene->warnings, IsEmpty());
        EXPECT_EQ(scene->geometry.size(), 2U);
    }
}

TEST(VrmlFile, OtherFormatsOfWorldsAreRefusedByName) {
    for (const auto& [text, message] :
         {std::pair("#Inventor V2.1 ascii\nSeparator { Cube { } }", "is '#Inventor V2.1 ascii', not VRML97"),
          std::pair("#Inventor V2.1 binary\n", "convert it to VRML97"),
          std::pair("\xff\xfe#", "is UTF-16 text; save it as UTF-8"),
          std::pair("<html><body><X3D/></body></html>", "its root is 'html', not X3D; save the X3D element")}) {
        const Result<Scene> scene = scene_from_vrml(text, "hall.iv");
        ASSERT_FALSE(scene);
        EXPECT_THAT(scene.error().message, HasSubstr(message));
    }
}

TEST(VrmlFile, PartsOfCadModelsAreMoved) {
    const auto scene = scene_from_vrml(
        "<X3D version='3.3'><Scene><CADLayer><CADAssembly><CADPart translation='1 2 3'><CADFace><Shape><Box/></Shape>"
        "</CADFace></CADPart></CADAssembly></CADLayer></Scene></X3D>",
        "world.x3d");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_THAT(scene->warnings, IsEmpty());
    ASSERT_EQ(scene->geometry.size(), 1U);
    EXPECT_EQ(moved(scene->geometry[0], {0, 0, 0}), glm::dvec3(1, 2, 3));
}

TEST(VrmlFile, AttributesOfX3DWithTooFewNumbersAreNamed) {
    for (const auto& [attribute, message] :
         {std::pair("specularColor='0.7'", "line 2: specularColor takes SFColor, not '0.7'"),
          std::pair("transparency='0.5 1'", "line 2: transparency takes SFFloat, not '0.5 1'")}) {
        const auto scene = scene_from_vrml("<X3D version='3.3'><Scene>\n<Shape><Appearance><Material " +
                                               std::string(attribute) + "/></Appearance><Box/></Shape></Scene></X3D>",
                                           "world.x3d");
        ASSERT_FALSE(scene) << attribute;
        EXPECT_THAT(scene.error().message, HasSubstr(message));
    }
}

TEST(VrmlFile, AConcaveFaceIsCutInside) {
    const Scene scene = scene_of(
        "Shape { geometry IndexedFaceSet { convex FALSE coord Coordinate { point [ 0 0 0, 4 0 0, 4 4 0, 2 1 0, 0 4 0 ] "
        "} "
        "coordIndex [ 0 1 2 3 4 ] } }");
    ASSERT_EQ(scene.geometry.size(), 1U);
    double area = 0;
    const Mesh& mesh = *scene.geometry[0].mesh;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        Mesh triangle = mesh;
        triangle.indices = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        area += glm::length(area_vector(triangle));
    }
    EXPECT_NEAR(area, 10, 1e-5);
}

TEST(VrmlFile, ListsThatDoNotFitAreSaid) {
    const std::string coord = "coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] }";
    const Scene scene = scene_of("Shape { geometry IndexedFaceSet { " + coord +
                                 " coordIndex [ 0 1 3 ] } }\n"
                                 "Shape { geometry IndexedFaceSet { " +
                                 coord +
                                 " coordIndex [ 0 1 2 ] colorIndex [ 0 1 ] color Color { color [ 1 1 1, 0 0 0 ] } } }\n"
                                 "Shape { geometry IndexedFaceSet { " +
                                 coord +
                                 " coordIndex [ 0 1 2 ] normal Normal { vector [ 0 0 1 ] } } }\n"
                                 "Shape { geometry ElevationGrid { xDimension 100 zDimension 100 height [ 0 ] } }\n"
                                 "Shape { geometry Sphere { radius -1 } }\n"
                                 "Shape { geometry Extrusion { scale [ 1 1, 1 1, 1 1 ] orientation [ ] } }");
    EXPECT_EQ(scene.geometry.size(), 2U);
    EXPECT_THAT(
        scene.warnings,
        ElementsAre(HasSubstr("line 2: IndexedFaceSet: coordIndex names point 3 of 3"),
                    HasSubstr("line 3: IndexedFaceSet: color does not fit"),
                    HasSubstr("line 4: IndexedFaceSet: normal does not fit"), HasSubstr("line 5: ElevationGrid"),
                    HasSubstr("line 6: Sphere: its sizes must be above 0"), HasSubstr("line 7: Extrusion")));
}

TEST(VrmlFile, PrototypesSwitchesAndLevelsAreFollowed) {
    const Scene scene = scene_of(
        "PROTO Ball [ field SFColor paint 1 0 0 field MFNode more [ ] ] { Group { children [ Shape { appearance "
        "Appearance { material "
        "Material { diffuseColor IS paint } } geometry Sphere { } } Group { children IS more } ] } }\n"
        "Ball { } Ball { paint 0 1 0 more [ Ball { paint 0 0 1 } ] } Switch { choice Shape { geometry Box { } } }\n"
        "Switch { whichChoice 0 choice Shape { geometry Box { } } } LOD { level [ Shape { geometry Cone { } } Group { "
        "} ] }");
    ASSERT_EQ(scene.geometry.size(), 5U);
    EXPECT_EQ(scene.geometry[0].material.diffuse, glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.geometry[1].material.diffuse, glm::vec3(0, 1, 0));
    EXPECT_EQ(scene.geometry[2].material.diffuse, glm::vec3(0, 0, 1));
}

class VrmlFolder : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& body) const {
        std::filesystem::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary) << "#VRML V2.0 utf8\n" << body;
    }
    test::TemporaryFolder folder_;
};

TEST_F(VrmlFolder, FilesIncludeEachOtherRelativeToThemselves) {
    write("hall.wrl",
          "Transform { translation 1 0 0 children Inline { url [ \"gone.wrl\" \"parts/a.wrl\" ] } }\nInline { url "
          "\"parts/a%2ewrl\" }");
    write("parts/a.wrl",
          "Transform { translation 0 1 0 children Inline { url \"b.wrl\" } } Viewpoint { } Background { }");
    write("parts/b.wrl",
          "Shape { appearance Appearance { texture ImageTexture { url \"red.png\" } } geometry Box { } }");
    ASSERT_TRUE(write_png(folder_ / "parts/red.png", Image<Rgba8>(4, 2, Rgba8{255, 0, 0, 255})).ok());
    const Result<Scene> scene = read_vrml(folder_ / "hall.wrl");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->geometry.size(), 2U);
    EXPECT_LT(glm::distance(moved(scene->geometry[0], {0, 0, 0}), glm::dvec3(1, 1, 0)), 1e-9);
    ASSERT_TRUE(scene->geometry[0].material.texture);
    EXPECT_EQ(scene->geometry[0].material.texture, scene->geometry[1].material.texture) << "read once";
    EXPECT_EQ(scene->geometry[0].mesh, scene->geometry[1].mesh);
    EXPECT_EQ(scene->viewpoints.size(), 2U);
    EXPECT_THAT(scene->warnings, IsEmpty());
}

TEST_F(VrmlFolder, AFileThatIncludesItselfIsShownOnce) {
    write("hall.wrl", "Shape { geometry Box { } }\nInline { url \"other.wrl\" }\nInline { url \"hall.wrl\" }");
    write("other.wrl",
          "Shape { geometry Box { } } Inline { url \"../" + folder_.path().filename().string() + "/hall.wrl\" }");
    const Result<Scene> scene = read_vrml(folder_ / "hall.wrl");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->geometry.size(), 2U);
    EXPECT_THAT(scene->warnings,
                ElementsAre(HasSubstr("includes itself"), HasSubstr("line 4: Inline: the file includes itself")));
}

TEST_F(VrmlFolder, FilesThatIncludeEachOtherTooOftenAreRefused) {
    for (int i = 0; i < 15; ++i) {
        std::string body;
        for (int k = 0; k < 8; ++k) body += "Inline { url \"w" + std::to_string(i + 1) + ".wrl\" }\n";
        write("w" + std::to_string(i) + ".wrl", body);
    }
    write("w15.wrl", "Shape { geometry Box { } }");
    const Result<Scene> scene = read_vrml(folder_ / "w0.wrl");
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("expand to too many nodes"));
}

TEST_F(VrmlFolder, GzipIsUnpackedWhateverTheName) {
    const std::string path = (folder_ / "hall.wrl").string();
    const std::string text = "#VRML V2.0 utf8\nShape { geometry Box { } }";
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    const Result<Scene> scene = read_vrml(path);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->geometry.size(), 1U);
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 9);
    const Result<Scene> cut = read_vrml(path);
    ASSERT_FALSE(cut);
    EXPECT_THAT(cut.error().message, HasSubstr("damaged or truncated gzip"));
}

TEST_F(VrmlFolder, ANameOfTwoLinesIsSaidInOne) {
    write("hall.wrl", "Shape { appearance Appearance { texture ImageTexture { url \"a\nb.png\" } } geometry Box { } }");
    const Result<Scene> scene = read_vrml(folder_ / "hall.wrl");
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->warnings.size(), 1U);
    EXPECT_EQ(scene->warnings[0].find('\n'), std::string::npos) << scene->warnings[0];
    EXPECT_NE(scene->warnings[0].find("a\\x0Ab.png"), std::string::npos) << scene->warnings[0];
}

TEST_F(VrmlFolder, AImageThatCannotBeReadIsSaidWithItsLine) {
    write("hall.wrl",
          "Shape { appearance Appearance {\n texture ImageTexture { url \"gone.png\" } } geometry Box { } }");
    const Result<Scene> scene = read_vrml(folder_ / "hall.wrl");
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->geometry.size(), 1U);
    EXPECT_THAT(scene->warnings, ElementsAre(HasSubstr("line 3: ImageTexture: ")));
}

TEST(VrmlFile, APixelTextureBeginsAtTheLowerLeft) {
    const Scene scene = scene_of(
        "Shape { appearance Appearance { texture PixelTexture { image 2 2 3 0xff0000 0x00ff00 0x0000ff 0xffffff "
        "repeatS FALSE } "
        "textureTransform TextureTransform { scale 2 3 translation 0.5 0 center 1 1 rotation 1.5707963 } } geometry "
        "Box { } }");
    const auto& texture = scene.geometry.at(0).material.texture;
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->image(0, 1), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(texture->image(1, 1), (Rgba8{0, 255, 0, 255}));
    EXPECT_EQ(texture->image(0, 0), (Rgba8{0, 0, 255, 255}));
    EXPECT_FALSE(texture->repeat_s);
    EXPECT_TRUE(texture->repeat_t);
    EXPECT_FALSE(texture->modulates);
    // (0.25, 0.5): translated (0.75, 0.5), by the centre (1.75, 1.5), rotated (-1.5, 1.75), scaled (-3, 5.25), back
    // (-4, 4.25).
    const glm::vec3 st = scene.geometry[0].material.texture_transform * glm::vec3(0.25F, 0.5F, 1);
    EXPECT_LT(glm::distance(st, glm::vec3(-4, 4.25F, 1)), 1e-5F);
}

}  // namespace
}  // namespace rs::compositor
