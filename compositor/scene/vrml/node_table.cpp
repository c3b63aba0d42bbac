#include "compositor/scene/vrml/node_table.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace rs::compositor::vrml {
namespace {

// Type, group, "named" or "-", the type's name for Coin, then fields: name, type, and for nodes the group they must be
// of. Inline, ImageTexture and those of ray space are node classes of our own there: Coin's own would open files.
constexpr const char* kNodes[] = {
    "Group child - Group children MFNode child bboxCenter SFVec3f bboxSize SFVec3f",
    "Transform child - Transform children MFNode child center SFVec3f rotation SFRotation scale SFVec3f "
    "scaleOrientation SFRotation translation SFVec3f bboxCenter SFVec3f bboxSize SFVec3f",
    "Anchor child - Anchor children MFNode child description SFString url MFString parameter MFString "
    "bboxCenter SFVec3f bboxSize SFVec3f",
    "Billboard child - Billboard children MFNode child axisOfRotation SFVec3f bboxCenter SFVec3f bboxSize SFVec3f",
    "Collision child - Collision children MFNode child collide SFBool proxy SFNode child "
    "bboxCenter SFVec3f bboxSize SFVec3f",
    "LOD child - LOD level MFNode child center SFVec3f range MFFloat",
    "Switch child - Switch choice MFNode child whichChoice SFInt32",
    "Inline child named RsInline url MFString load SFBool bboxCenter SFVec3f bboxSize SFVec3f",
    "InlineLoadControl child named RsInline url MFString load SFBool bboxCenter SFVec3f bboxSize SFVec3f",
    "RaySpace child named RsRaySpace url MFString size SFFloat standing SFBool description SFString",
    "RaySpaceRoom child named RsRaySpaceRoom children MFNode child bboxCenter SFVec3f bboxSize SFVec3f "
    "description SFString",
    "Shape child - Shape appearance SFNode appearance geometry SFNode geometry",
    "Appearance appearance - Appearance material SFNode material texture SFNode texture "
    "textureTransform SFNode textureTransform",
    "Material material - Material ambientIntensity SFFloat diffuseColor SFColor emissiveColor SFColor "
    "shininess SFFloat specularColor SFColor transparency SFFloat",
    "ImageTexture texture named RsImageTexture url MFString repeatS SFBool repeatT SFBool",
    "PixelTexture texture named PixelTexture image SFImage repeatS SFBool repeatT SFBool",
    "TextureTransform textureTransform - TextureTransform center SFVec2f rotation SFFloat scale SFVec2f "
    "translation SFVec2f",
    "Box geometry named Box size SFVec3f",
    "Cone geometry named Cone bottomRadius SFFloat height SFFloat side SFBool bottom SFBool",
    "Cylinder geometry named Cylinder bottom SFBool height SFFloat radius SFFloat side SFBool top SFBool",
    "Sphere geometry named Sphere radius SFFloat",
    "ElevationGrid geometry named ElevationGrid color SFNode color normal SFNode normal texCoord SFNode texCoord "
    "height MFFloat ccw SFBool colorPerVertex SFBool creaseAngle SFFloat normalPerVertex SFBool solid SFBool "
    "xDimension SFInt32 xSpacing SFFloat zDimension SFInt32 zSpacing SFFloat",
    "Extrusion geometry named Extrusion beginCap SFBool ccw SFBool convex SFBool creaseAngle SFFloat "
    "crossSection MFVec2f endCap SFBool orientation MFRotation scale MFVec2f solid SFBool spine MFVec3f",
    "IndexedFaceSet geometry named IndexedFaceSet color SFNode color coord SFNode coord normal SFNode normal "
    "texCoord SFNode texCoord ccw SFBool colorIndex MFInt32 colorPerVertex SFBool convex SFBool coordIndex MFInt32 "
    "creaseAngle SFFloat normalIndex MFInt32 normalPerVertex SFBool solid SFBool texCoordIndex MFInt32",
    "IndexedLineSet geometry named IndexedLineSet color SFNode color coord SFNode coord colorIndex MFInt32 "
    "colorPerVertex SFBool coordIndex MFInt32",
    "PointSet geometry named PointSet color SFNode color coord SFNode coord",
    "Text geometry named Text string MFString fontStyle SFNode fontStyle length MFFloat maxExtent SFFloat",
    "FontStyle fontStyle - FontStyle family MFString horizontal SFBool justify MFString language SFString "
    "leftToRight SFBool size SFFloat spacing SFFloat style SFString topToBottom SFBool",
    "Coordinate coord - Coordinate point MFVec3f",
    "Color color - Color color MFColor",
    "Normal normal - Normal vector MFVec3f",
    "TextureCoordinate texCoord - TextureCoordinate point MFVec2f",
    "DirectionalLight child - DirectionalLight ambientIntensity SFFloat color SFColor direction SFVec3f "
    "intensity SFFloat on SFBool",
    "PointLight child - PointLight ambientIntensity SFFloat attenuation SFVec3f color SFColor intensity SFFloat "
    "location SFVec3f on SFBool radius SFFloat",
    "SpotLight child - SpotLight ambientIntensity SFFloat attenuation SFVec3f beamWidth SFFloat color SFColor "
    "cutOffAngle SFFloat direction SFVec3f intensity SFFloat location SFVec3f on SFBool radius SFFloat",
    "Viewpoint child - Viewpoint fieldOfView SFFloat jump SFBool orientation SFRotation position SFVec3f "
    "description SFString",
    "NavigationInfo child - NavigationInfo avatarSize MFFloat headlight SFBool speed SFFloat type MFString "
    "visibilityLimit SFFloat",
    "Fog child - Fog color SFColor fogType SFString visibilityRange SFFloat",
    "Background child named Background groundAngle MFFloat groundColor MFColor skyAngle MFFloat skyColor MFColor "
    "backUrl MFString bottomUrl MFString frontUrl MFString leftUrl MFString rightUrl MFString topUrl MFString",
    "WorldInfo child - WorldInfo info MFString title SFString",
};

constexpr std::array<std::pair<const char*, FieldType>, 11> kTypes = {{
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
}};

std::map<std::string, NodeSpec, std::less<>> parsed_table() {
    std::map<std::string, NodeSpec, std::less<>> table;
    for (const char* row : kNodes) {
        std::istringstream words(row);
        std::string type;
        std::string named;
        NodeSpec spec;
        words >> type >> spec.slot >> named >> spec.coin_name;
        spec.named = named == "named";
        std::string field;
        std::string field_type;
        while (words >> field >> field_type) {
            FieldSpec& entry = spec.fields[field];
            parse_field_type(field_type, entry);
            if (entry.type == FieldType::kNode) words >> entry.slot;
        }
        table.emplace(type, std::move(spec));
    }
    return table;
}

}  // namespace

const NodeSpec* find_node(std::string_view type) {
    static const std::map<std::string, NodeSpec, std::less<>> kTable = parsed_table();
    const auto found = kTable.find(type);
    return found == kTable.end() ? nullptr : &found->second;
}

bool is_behaviour(std::string_view type) {
    static const std::set<std::string, std::less<>> kTypesOfTime = {
        "AudioClip",
        "ColorInterpolator",
        "CoordinateInterpolator",
        "CylinderSensor",
        "MovieTexture",
        "NormalInterpolator",
        "OrientationInterpolator",
        "PlaneSensor",
        "PositionInterpolator",
        "ProximitySensor",
        "ScalarInterpolator",
        "Script",
        "Sound",
        "SphereSensor",
        "TimeSensor",
        "TouchSensor",
        "VisibilitySensor",
    };
    return kTypesOfTime.contains(type);
}

bool parse_field_type(std::string_view name, FieldSpec& spec) {
    if (name.size() < 3 || (name[0] != 'S' && name[0] != 'M') || name[1] != 'F') return false;
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return name.substr(2) == type.first; });
    if (found == kTypes.end()) return false;
    spec.type = found->second;
    spec.many = name[0] == 'M';
    // These have no other form in VRML97.
    return !(spec.many && (spec.type == FieldType::kBool || spec.type == FieldType::kImage));
}

std::string field_type_name(const FieldSpec& spec) {
    const auto found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& type) { return type.second == spec.type; });
    return std::string(spec.many ? "MF" : "SF") + found->first;
}

}  // namespace rs::compositor::vrml
