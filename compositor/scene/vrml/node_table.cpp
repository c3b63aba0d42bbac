#include "compositor/scene/vrml/node_table.hpp"

#include "compositor/scene/vrml/field_values.hpp"
#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace rs::compositor::vrml {
namespace {

// Type, group, then per field: name, type, default value; for node fields the required group.
constexpr const char* kNodes[] = {
    "Group child children MFNode child bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "Transform child children MFNode child center SFVec3f 0 0 0 rotation SFRotation 0 0 1 0 scale SFVec3f 1 1 1 "
    "scaleOrientation SFRotation 0 0 1 0 translation SFVec3f 0 0 0 bboxCenter SFVec3f 0 0 0 "
    "bboxSize SFVec3f -1 -1 -1",
    "Anchor child children MFNode child description SFString \"\" url MFString [ ] parameter MFString [ ] "
    "bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "Billboard child children MFNode child axisOfRotation SFVec3f 0 1 0 bboxCenter SFVec3f 0 0 0 "
    "bboxSize SFVec3f -1 -1 -1",
    "Collision child children MFNode child collide SFBool TRUE proxy SFNode child "
    "bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "LOD child level MFNode child center SFVec3f 0 0 0 range MFFloat [ ]",
    "Switch child choice MFNode child whichChoice SFInt32 -1",
    "Inline child url MFString [ ] load SFBool TRUE bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "InlineLoadControl child url MFString [ ] load SFBool TRUE bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "RaySpace child url MFString [ ] size SFFloat 1 standing SFBool TRUE description SFString \"\"",
    "RaySpaceRoom child children MFNode child bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1 "
    "description SFString \"\"",
    "Shape child appearance SFNode appearance geometry SFNode geometry",
    "Appearance appearance alphaCutoff SFFloat 0.5 alphaMode SFString \"AUTO\" backMaterial SFNode material "
    "material SFNode material texture SFNode texture textureTransform SFNode textureTransform",
    "Material material ambientIntensity SFFloat 0.2 diffuseColor SFColor 0.8 0.8 0.8 emissiveColor SFColor 0 0 0 "
    "shininess SFFloat 0.2 specularColor SFColor 0 0 0 transparency SFFloat 0 "
    "ambientTexture SFNode texture ambientTextureMapping SFString \"\" "
    "diffuseTexture SFNode texture diffuseTextureMapping SFString \"\" "
    "emissiveTexture SFNode texture emissiveTextureMapping SFString \"\" "
    "normalScale SFFloat 1 normalTexture SFNode texture normalTextureMapping SFString \"\" "
    "occlusionStrength SFFloat 1 occlusionTexture SFNode texture occlusionTextureMapping SFString \"\" "
    "shininessTexture SFNode texture shininessTextureMapping SFString \"\" "
    "specularTexture SFNode texture specularTextureMapping SFString \"\"",
    "UnlitMaterial material emissiveColor SFColor 1 1 1 emissiveTexture SFNode texture "
    "emissiveTextureMapping SFString \"\" normalScale SFFloat 1 normalTexture SFNode texture "
    "normalTextureMapping SFString \"\" transparency SFFloat 0",
    "PhysicalMaterial material baseColor SFColor 1 1 1 emissiveColor SFColor 0 0 0 metallic SFFloat 1 "
    "roughness SFFloat 1 transparency SFFloat 0 "
    "baseTexture SFNode texture baseTextureMapping SFString \"\" "
    "emissiveTexture SFNode texture emissiveTextureMapping SFString \"\" "
    "metallicRoughnessTexture SFNode texture metallicRoughnessTextureMapping SFString \"\" "
    "normalScale SFFloat 1 normalTexture SFNode texture normalTextureMapping SFString \"\" "
    "occlusionStrength SFFloat 1 occlusionTexture SFNode texture occlusionTextureMapping SFString \"\"",
    "ImageTexture texture url MFString [ ] repeatS SFBool TRUE repeatT SFBool TRUE",
    "PixelTexture texture image SFImage 0 0 0 repeatS SFBool TRUE repeatT SFBool TRUE",
    "TextureTransform textureTransform center SFVec2f 0 0 rotation SFFloat 0 scale SFVec2f 1 1 "
    "translation SFVec2f 0 0",
    "Box geometry size SFVec3f 2 2 2 solid SFBool TRUE",
    "Cone geometry bottomRadius SFFloat 1 height SFFloat 2 side SFBool TRUE bottom SFBool TRUE solid SFBool TRUE",
    "Cylinder geometry bottom SFBool TRUE height SFFloat 2 radius SFFloat 1 side SFBool TRUE top SFBool TRUE "
    "solid SFBool TRUE",
    "Sphere geometry radius SFFloat 1 solid SFBool TRUE",
    "ElevationGrid geometry color SFNode color normal SFNode normal texCoord SFNode texCoord height MFFloat [ ] "
    "ccw SFBool TRUE colorPerVertex SFBool TRUE creaseAngle SFFloat 0 normalPerVertex SFBool TRUE solid SFBool TRUE "
    "xDimension SFInt32 0 xSpacing SFFloat 1 zDimension SFInt32 0 zSpacing SFFloat 1",
    "Extrusion geometry beginCap SFBool TRUE ccw SFBool TRUE convex SFBool TRUE creaseAngle SFFloat 0 "
    "crossSection MFVec2f [ 1 1 1 -1 -1 -1 -1 1 1 1 ] endCap SFBool TRUE orientation MFRotation [ 0 0 1 0 ] "
    "scale MFVec2f [ 1 1 ] solid SFBool TRUE spine MFVec3f [ 0 0 0 0 1 0 ]",
    "IndexedFaceSet geometry color SFNode color coord SFNode coord normal SFNode normal texCoord SFNode texCoord "
    "ccw SFBool TRUE colorIndex MFInt32 [ ] colorPerVertex SFBool TRUE convex SFBool TRUE coordIndex MFInt32 [ ] "
    "creaseAngle SFFloat 0 normalIndex MFInt32 [ ] normalPerVertex SFBool TRUE solid SFBool TRUE "
    "texCoordIndex MFInt32 [ ]",
    "IndexedLineSet geometry color SFNode color coord SFNode coord colorIndex MFInt32 [ ] "
    "colorPerVertex SFBool TRUE coordIndex MFInt32 [ ]",
    "PointSet geometry color SFNode color coord SFNode coord",
    "Text geometry string MFString [ ] fontStyle SFNode fontStyle length MFFloat [ ] maxExtent SFFloat 0",
    "FontStyle fontStyle family MFString \"SERIF\" horizontal SFBool TRUE justify MFString \"BEGIN\" "
    "language SFString \"\" leftToRight SFBool TRUE size SFFloat 1 spacing SFFloat 1 style SFString \"PLAIN\" "
    "topToBottom SFBool TRUE",
    "Coordinate coord point MFVec3f [ ]",
    "ColorRGBA color color MFColorRGBA [ ]",
    "Color color color MFColor [ ]",
    "Normal normal vector MFVec3f [ ]",
    "TextureCoordinate texCoord point MFVec2f [ ]",
    "DirectionalLight child ambientIntensity SFFloat 0 color SFColor 1 1 1 direction SFVec3f 0 0 -1 "
    "global SFBool FALSE intensity SFFloat 1 on SFBool TRUE",
    "PointLight child ambientIntensity SFFloat 0 attenuation SFVec3f 1 0 0 color SFColor 1 1 1 global SFBool TRUE "
    "intensity SFFloat 1 location SFVec3f 0 0 0 on SFBool TRUE radius SFFloat 100",
    "SpotLight child ambientIntensity SFFloat 0 attenuation SFVec3f 1 0 0 beamWidth SFFloat 1.570796 "
    "color SFColor 1 1 1 cutOffAngle SFFloat 0.785398 direction SFVec3f 0 0 -1 global SFBool TRUE "
    "intensity SFFloat 1 location SFVec3f 0 0 0 on SFBool TRUE radius SFFloat 100",
    "Viewpoint child fieldOfView SFFloat 0.785398 jump SFBool TRUE orientation SFRotation 0 0 1 0 "
    "position SFVec3f 0 0 10 description SFString \"\"",
    "NavigationInfo child avatarSize MFFloat [ 0.25 1.6 0.75 ] headlight SFBool TRUE speed SFFloat 1 "
    "type MFString [ \"WALK\" \"ANY\" ] visibilityLimit SFFloat 0",
    "Fog child color SFColor 1 1 1 fogType SFString \"LINEAR\" visibilityRange SFFloat 0",
    "Background child groundAngle MFFloat [ ] groundColor MFColor [ ] skyAngle MFFloat [ ] skyColor MFColor [ ] "
    "backUrl MFString [ ] bottomUrl MFString [ ] frontUrl MFString [ ] leftUrl MFString [ ] rightUrl MFString [ ] "
    "topUrl MFString [ ]",
    "StaticGroup child children MFNode child bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "CADLayer child children MFNode child bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "CADAssembly child children MFNode child bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "CADPart child children MFNode child center SFVec3f 0 0 0 rotation SFRotation 0 0 1 0 scale SFVec3f 1 1 1 "
    "scaleOrientation SFRotation 0 0 1 0 translation SFVec3f 0 0 0 bboxCenter SFVec3f 0 0 0 "
    "bboxSize SFVec3f -1 -1 -1",
    "CADFace child shape SFNode child bboxCenter SFVec3f 0 0 0 bboxSize SFVec3f -1 -1 -1",
    "LineSet geometry color SFNode color coord SFNode coord vertexCount MFInt32 [ ]",
    "Rectangle2D geometry size SFVec2f 2 2 solid SFBool FALSE",
    "WorldInfo child info MFString [ ] title SFString \"\"",
};

// X3D's face sets differ in one field, which groups points into faces.
constexpr const char* kFaceSets[] = {
    "IndexedTriangleSet index",      "TriangleSet",
    "IndexedTriangleFanSet index",   "TriangleFanSet fanCount",
    "IndexedTriangleStripSet index", "TriangleStripSet stripCount",
    "IndexedQuadSet index",          "QuadSet",
};
constexpr const char* kFaceSetFields =
    "geometry color SFNode color coord SFNode coord normal SFNode normal texCoord SFNode texCoord ccw SFBool TRUE "
    "colorPerVertex SFBool TRUE normalPerVertex SFBool TRUE solid SFBool TRUE";

// The first name of a type is used in messages; the others are X3D's.
constexpr std::array<std::pair<const char*, FieldType>, 16> kTypes = {{
    {"Bool", FieldType::kBool},
    {"Int32", FieldType::kInt32},
    {"Float", FieldType::kFloat},
    {"Time", FieldType::kTime},
    {"Vec2f", FieldType::kVec2f},
    {"Vec3f", FieldType::kVec3f},
    {"Color", FieldType::kColor},
    {"Rotation", FieldType::kRotation},
    {"String", FieldType::kString},
    {"Image", FieldType::kImage},
    {"Node", FieldType::kNode},
    {"Double", FieldType::kFloat},
    {"Vec2d", FieldType::kVec2f},
    {"Vec3d", FieldType::kVec3f},
    {"ColorRGBA", FieldType::kRotation},
    {"Vec4f", FieldType::kRotation},
}};

std::map<std::string, NodeSpec, std::less<>> parse_table() {
    std::map<std::string, NodeSpec, std::less<>> table;
    std::vector<std::string> rows(std::begin(kNodes), std::end(kNodes));
    for (const std::string set : kFaceSets) {
        const std::size_t space = set.find(' ');
        rows.push_back(set.substr(0, space) + " " + kFaceSetFields);
        if (space != std::string::npos) rows.back() += set.substr(space) + " MFInt32 [ ]";
    }
    for (const std::string& row : rows) {
        Lexer lexer(row, "node table");
        NodeSpec& spec = table[std::string(lexer.take().text)];
        spec.slot = lexer.take().text;
        while (lexer.peek().kind != TokenKind::end) {
            const std::string name(lexer.take().text);
            FieldSpec& field = spec.fields[name];
            RS_CHECK(parse_field_type(lexer.take().text, field));
            if (field.type == FieldType::kNode) {
                field.slot = lexer.take().text;
            } else {
                field.initial = read_value(lexer, field, name);
            }
        }
    }
    return table;
}

}  // namespace

const std::map<std::string, NodeSpec, std::less<>>& node_table() {
    static const std::map<std::string, NodeSpec, std::less<>> kTable = parse_table();
    return kTable;
}

const NodeSpec* find_node(std::string_view type) {
    const auto found = node_table().find(type);
    return found == node_table().end() ? nullptr : &found->second;
}

const std::set<std::string, std::less<>>& behaviours() {
    static const std::set<std::string, std::less<>> kTypesOfTime = {
        "AudioClip",
        "BooleanFilter",
        "BooleanSequencer",
        "BooleanToggle",
        "BooleanTrigger",
        "ColorInterpolator",
        "CoordinateInterpolator",
        "CoordinateInterpolator2D",
        "CylinderSensor",
        "IntegerSequencer",
        "IntegerTrigger",
        "KeySensor",
        "LoadSensor",
        "MetadataBoolean",
        "MetadataDouble",
        "MetadataFloat",
        "MetadataInteger",
        "MetadataSet",
        "MetadataString",
        "MovieTexture",
        "NormalInterpolator",
        "OrientationInterpolator",
        "PlaneSensor",
        "PositionInterpolator",
        "PositionInterpolator2D",
        "ProximitySensor",
        "ScalarInterpolator",
        "Script",
        "Sound",
        "SphereSensor",
        "StringSensor",
        "TimeSensor",
        "TimeTrigger",
        "TouchSensor",
        "VisibilitySensor",
    };
    return kTypesOfTime;
}

bool is_behaviour(std::string_view type) {
    return behaviours().contains(type);
}

bool parse_field_type(std::string_view name, FieldSpec& spec) {
    if (name.size() < 3 || (name[0] != 'S' && name[0] != 'M') || name[1] != 'F') return false;
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return name.substr(2) == type.first; });
    if (found == kTypes.end()) return false;
    spec.type = found->second;
    spec.many = name[0] == 'M';
    // VRML97 has no MFBool and MFImage.
    return !(spec.many && (spec.type == FieldType::kBool || spec.type == FieldType::kImage));
}

std::string field_type_name(const FieldSpec& spec) {
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return type.second == spec.type; });
    return std::string(spec.many ? "MF" : "SF") + found->first;
}

int numbers_in(FieldType type) {
    switch (type) {
        case FieldType::kVec2f:
            return 2;
        case FieldType::kVec3f:
        case FieldType::kColor:
            return 3;
        case FieldType::kRotation:
            return 4;
        default:
            return 1;
    }
}

}  // namespace rs::compositor::vrml
