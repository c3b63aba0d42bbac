#include "compositor/scene/vrml1/tree.hpp"
#include "rayspace/api/types/check.hpp"

#include <utility>

namespace rs::compositor::vrml1 {
namespace {

// Type, then per field: name, type, default value.
constexpr const char* kKinds[] = {
    "AsciiText string MFString [ ] spacing SFFloat 1 justification SFEnum LEFT width MFFloat 0",
    "Cone parts SFBitMask ALL bottomRadius SFFloat 1 height SFFloat 2",
    "Coordinate3 point MFVec3f 0 0 0",
    "Cube width SFFloat 2 height SFFloat 2 depth SFFloat 2",
    "Cylinder parts SFBitMask ALL radius SFFloat 1 height SFFloat 2",
    "DirectionalLight on SFBool TRUE intensity SFFloat 1 color SFColor 1 1 1 direction SFVec3f 0 0 -1",
    "FontStyle size SFFloat 10 family SFEnum SERIF style SFBitMask NONE",
    "Group",
    "IndexedFaceSet coordIndex MFLong 0 materialIndex MFLong -1 normalIndex MFLong -1 textureCoordIndex MFLong -1",
    "IndexedLineSet coordIndex MFLong 0 materialIndex MFLong -1 normalIndex MFLong -1 textureCoordIndex MFLong -1",
    "Info string SFString \"\"",
    "LOD range MFFloat [ ] center SFVec3f 0 0 0",
    ("Material ambientColor MFColor 0.2 0.2 0.2 diffuseColor MFColor 0.8 0.8 0.8 specularColor MFColor 0 0 0 "
     "emissiveColor MFColor 0 0 0 shininess MFFloat 0.2 transparency MFFloat 0"),
    "MaterialBinding value SFEnum DEFAULT",
    "MatrixTransform matrix SFMatrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
    "Normal vector MFVec3f [ ]",
    "NormalBinding value SFEnum DEFAULT",
    ("OrthographicCamera position SFVec3f 0 0 1 orientation SFRotation 0 0 1 0 focalDistance SFFloat 5 height SFFloat "
     "2 "
     "nearDistance SFFloat 0.01 farDistance SFFloat 1000"),
    ("PerspectiveCamera position SFVec3f 0 0 1 orientation SFRotation 0 0 1 0 focalDistance SFFloat 5 "
     "heightAngle SFFloat 0.785398 nearDistance SFFloat 0.01 farDistance SFFloat 1000"),
    "PointLight on SFBool TRUE intensity SFFloat 1 color SFColor 1 1 1 location SFVec3f 0 0 1",
    "PointSet startIndex SFLong 0 numPoints SFLong -1",
    "Rotation rotation SFRotation 0 0 1 0",
    "Scale scaleFactor SFVec3f 1 1 1",
    "Separator renderCulling SFEnum AUTO",
    ("ShapeHints vertexOrdering SFEnum UNKNOWN_ORDERING shapeType SFEnum UNKNOWN_SHAPE_TYPE faceType SFEnum CONVEX "
     "creaseAngle SFFloat 0.5"),
    "Sphere radius SFFloat 1",
    ("SpotLight on SFBool TRUE intensity SFFloat 1 color SFVec3f 1 1 1 location SFVec3f 0 0 1 direction SFVec3f 0 0 -1 "
     "dropOffRate SFFloat 0 cutOffAngle SFFloat 0.785398"),
    "Switch whichChild SFLong -1",
    "Texture2 filename SFString \"\" image SFImage 0 0 0 wrapS SFEnum REPEAT wrapT SFEnum REPEAT",
    "Texture2Transform translation SFVec2f 0 0 rotation SFFloat 0 scaleFactor SFVec2f 1 1 center SFVec2f 0 0",
    "TextureCoordinate2 point MFVec2f 0 0",
    ("Transform translation SFVec3f 0 0 0 rotation SFRotation 0 0 1 0 scaleFactor SFVec3f 1 1 1 "
     "scaleOrientation SFRotation 0 0 1 0 center SFVec3f 0 0 0"),
    "TransformSeparator",
    "Translation translation SFVec3f 0 0 0",
    "WWWAnchor name SFString \"\" description SFString \"\" map SFEnum NONE",
    "WWWInline name SFString \"\" bboxSize SFVec3f 0 0 0 bboxCenter SFVec3f 0 0 0",
};

Field field_of_type(std::string_view type) {
    Field field;
    field.many = type.starts_with("MF");
    const std::string_view what = type.substr(2);
    const std::pair<std::string_view, Field> kinds[] = {
        {"Bool", {.kind = FieldKind::kBool}},
        {"Long", {.kind = FieldKind::kInteger}},
        {"String", {.kind = FieldKind::kText}},
        {"Enum", {.kind = FieldKind::kWords}},
        {"BitMask", {.kind = FieldKind::kWords}},
        {"Image", {.kind = FieldKind::kImage}},
        {"Float", {.each = 1}},
        {"Vec2f", {.each = 2}},
        {"Vec3f", {.each = 3}},
        {"Color", {.each = 3}},
        {"Rotation", {.each = 4}},
        {"Matrix", {.each = 16}},
    };
    for (const auto& [name, kind] : kinds) {
        if (name != what) continue;
        field.kind = kind.kind;
        field.each = kind.each;
        return field;
    }
    RS_CHECK(false);
    return field;
}

std::map<std::string, NodeKind, std::less<>> parse_kinds() {
    std::map<std::string, NodeKind, std::less<>> table;
    for (const char* row : kKinds) {
        Lexer lexer(row, "node table");
        NodeKind& kind = table[std::string(lexer.take().text)];
        while (lexer.peek().kind != vrml::TokenKind::end) {
            const std::string name(lexer.take().text);
            Field& field = kind.fields[name];
            field = field_of_type(lexer.take().text);
            field.initial = read_value(lexer, field, name);
        }
    }
    return table;
}

}  // namespace

const std::map<std::string, NodeKind, std::less<>>& node_kinds() {
    static const std::map<std::string, NodeKind, std::less<>> kTable = parse_kinds();
    return kTable;
}

const NodeKind* find_kind(std::string_view type) {
    const auto found = node_kinds().find(type);
    return found == node_kinds().end() ? nullptr : &found->second;
}

}  // namespace rs::compositor::vrml1
