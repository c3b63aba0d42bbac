// Geometry of VRML 1.0 shapes in their state; materials are in appearances.cpp.

#include "compositor/scene/vrml1/state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rs::compositor::vrml1 {

using vrml::Fields;
using vrml::NodePointer;

namespace {

double flag(bool yes) {
    return yes ? 1 : 0;
}

std::string binding_of(const TreePointer& node) {
    return node ? node->text("value") : std::string("DEFAULT");
}

// An index field that contains only -1 is not given.
bool is_given(const std::vector<double>& indices) {
    return !indices.empty() && !(indices.size() == 1 && indices.front() == -1);
}

double has_hint(const TreePointer& hints, const char* field, const char* word) {
    return hints && hints->text(field) == word ? 1 : 0;
}

// Number of faces or lines, including those without corners, as the VRML97 reader counts them.
std::size_t count_faces(const std::vector<double>& indices) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < indices.size(); ++i) count += indices[i] < 0 || i + 1 == indices.size() ? 1 : 0;
    return count;
}

// 0, 1, 2, ... per corner, -1 at the end of each face: for lists with one value per corner.
std::vector<double> corner_indices(const std::vector<double>& indices, std::size_t available) {
    std::vector<double> made;
    std::size_t next = 0;
    for (const double index : indices) {
        made.push_back(index < 0 ? -1.0 : static_cast<double>(next++ % std::max<std::size_t>(available, 1)));
    }
    return made;
}

std::vector<double> face_indices(const std::vector<double>& indices, std::size_t available) {
    std::vector<double> made;
    for (std::size_t i = 0; i < count_faces(indices); ++i) {
        made.push_back(static_cast<double>(i % std::max<std::size_t>(available, 1)));
    }
    return made;
}

// Box corners by face, for boxes with one material per face: front, back, left, right, top, bottom.
constexpr std::array<std::array<int, 4>, 6> kCubeFaces{
    {{0, 1, 3, 2}, {5, 4, 6, 7}, {4, 0, 2, 6}, {1, 5, 7, 3}, {2, 3, 7, 6}, {4, 5, 1, 0}}};

}  // namespace

ShapeBuilder::Colours ShapeBuilder::colours_of(const State& state) {
    const std::string binding = binding_of(state.material_binding);
    if (!state.material || binding == "DEFAULT" || binding == "OVERALL") return {};
    for (const char* field : {"diffuseColor", "emissiveColor"}) {
        if (state.material->field(field).numbers.size() > 3) return {field, binding};
    }
    return {};
}

std::vector<NodePointer> ShapeBuilder::shapes_of(const TreePointer& node, const State& state) {
    const std::string& type = node->type;
    const Colours colours = colours_of(state);
    const auto one = [&](NodePointer geometry, bool lines, bool coloured) -> std::vector<NodePointer> {
        if (!geometry) return {};
        return {shape(*node, appearance_of(state, lines, 0, coloured), std::move(geometry))};
    };
    if (type == "IndexedFaceSet") return one(faces_of(node, state, colours), false, colours.field != nullptr);
    if (type == "IndexedLineSet") return one(lines_of(node, state, colours), true, colours.field != nullptr);
    if (type == "PointSet") return one(points_of(node, state), true, false);
    if (type == "AsciiText") return one(text_of(node, state), false, false);
    if (type == "Sphere" || type == "Cone" || type == "Cylinder" || type == "Cube") return split_shapes(node, state);
    return {};
}

NodePointer ShapeBuilder::shape(const Tree& node, NodePointer appearance, NodePointer geometry) {
    Fields fields{{"geometry", nodes({std::move(geometry)})}};
    if (appearance) fields["appearance"] = nodes({std::move(appearance)});
    return make_node(builder_, "Shape", node.line, std::move(fields), node.name);
}

NodePointer ShapeBuilder::list_node(const TreePointer& from, const char* type, const char* field,
                                    const char* from_field) {
    if (!from || from->field(from_field).numbers.empty()) return nullptr;
    NodePointer& known = lists_[{from, std::string(type) + from_field}];
    if (!known) known = make_node(builder_, type, from->line, {{field, from->field(from_field)}});
    return known;
}

// Solids with parts that may have a material each; two-sided, since they may be open.
std::vector<NodePointer> ShapeBuilder::split_shapes(const TreePointer& node, const State& state) {
    const std::string& type = node->type;
    const std::string binding = binding_of(state.material_binding);
    const bool by_part = binding.starts_with("PER_PART") || binding.starts_with("PER_FACE");
    const std::size_t materials = state.material ? state.material->field("diffuseColor").numbers.size() / 3 : 1;
    const bool apart = by_part && materials > 1 && type != "Sphere";
    const auto cut = [&](const char* name, Fields fields, std::size_t material) {
        fields["solid"] = numbers({0});
        NodePointer geometry = apart ? nullptr : geometries_[{node}];
        if (!geometry) geometry = make_node(builder_, name, node->line, std::move(fields));
        if (!apart) geometries_[{node}] = geometry;
        return shape(*node, appearance_of(state, false, material, false), std::move(geometry));
    };
    if (type == "Sphere") return {cut("Sphere", {{"radius", node->field("radius")}}, 0)};
    if (type == "Cube") {
        const glm::dvec3 size(node->number("width"), node->number("height"), node->number("depth"));
        if (!apart) return {cut("Box", {{"size", numbers({size.x, size.y, size.z})}}, 0)};
        std::vector<NodePointer> faces;
        std::vector<double> points;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 at((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                                (corner & 4) != 0 ? -0.5 : 0.5);
            for (int axis = 0; axis < 3; ++axis) points.push_back(at[axis] * size[axis]);
        }
        const NodePointer coordinates = make_node(builder_, "Coordinate", node->line, {{"point", numbers(points)}});
        for (std::size_t face = 0; face < kCubeFaces.size(); ++face) {
            const auto& c = kCubeFaces[face];
            Fields fields{{"coord", nodes({coordinates})},
                          {"coordIndex", numbers({static_cast<double>(c[0]), static_cast<double>(c[1]),
                                                  static_cast<double>(c[2]), static_cast<double>(c[3]), -1})}};
            faces.push_back(cut("IndexedFaceSet", std::move(fields), face % materials));
        }
        return faces;
    }
    const bool is_cone = type == "Cone";
    const auto sizes = [&](const char* shown) {
        Fields fields{{"height", node->field("height")}};
        const char* radius = is_cone ? "bottomRadius" : "radius";
        fields[radius] = node->field(radius);
        const std::string all = shown;
        fields["side"] = numbers({flag(node->has_part("parts", "SIDES") && (all.empty() || all == "SIDES"))});
        fields["bottom"] = numbers({flag(node->has_part("parts", "BOTTOM") && (all.empty() || all == "BOTTOM"))});
        if (!is_cone) fields["top"] = numbers({flag(node->has_part("parts", "TOP") && (all.empty() || all == "TOP"))});
        return fields;
    };
    if (!apart) return {cut(type.c_str(), sizes(""), 0)};
    std::vector<NodePointer> parts;
    std::size_t material = 0;
    for (const char* part : {"SIDES", "TOP", "BOTTOM"}) {
        if (is_cone && std::string_view(part) == "TOP") continue;
        const std::size_t own = material++ % materials;
        if (node->has_part("parts", part)) parts.push_back(cut(type.c_str(), sizes(part), own));
    }
    return parts;
}

void ShapeBuilder::add_colours(Fields& fields, const Tree& shape, const State& state, const Colours& colours) {
    if (colours.field == nullptr) return;
    const std::vector<double>& indices = shape.field("coordIndex").numbers;
    const std::vector<double>& given = shape.field("materialIndex").numbers;
    const std::size_t available = state.material->field(colours.field).numbers.size() / 3;
    const std::string& binding = colours.binding;
    const bool by_corner = binding.starts_with("PER_VERTEX");
    const bool indexed = binding.ends_with("_INDEXED");
    fields["color"] = nodes({list_node(state.material, "Color", "color", colours.field)});
    fields["colorPerVertex"] = numbers({flag(by_corner)});
    if (indexed && is_given(given)) {
        fields["colorIndex"] = numbers(given);
    } else if (!indexed || !by_corner) {
        fields["colorIndex"] =
            numbers(by_corner ? corner_indices(indices, available) : face_indices(indices, available));
    }
}

void ShapeBuilder::add_normals(Fields& fields, const Tree& shape, const State& state) {
    const NodePointer normals = list_node(state.normals, "Normal", "vector", "vector");
    if (!normals) return;
    const std::string binding = binding_of(state.normal_binding);
    const std::vector<double>& indices = shape.field("coordIndex").numbers;
    const std::vector<double>& given = shape.field("normalIndex").numbers;
    const std::size_t available = state.normals->field("vector").numbers.size() / 3;
    fields["normal"] = nodes({normals});
    if (binding == "OVERALL") {
        fields["normalPerVertex"] = numbers({0});
        fields["normalIndex"] = numbers(std::vector<double>(count_faces(indices), 0.0));
    } else if (binding.starts_with("PER_FACE") || binding.starts_with("PER_PART")) {
        const bool indexed = binding.ends_with("_INDEXED") && is_given(given);
        fields["normalPerVertex"] = numbers({0});
        fields["normalIndex"] = numbers(indexed ? given : face_indices(indices, available));
    } else if (binding == "PER_VERTEX") {
        fields["normalIndex"] = numbers(corner_indices(indices, available));
    } else if (is_given(given)) {
        fields["normalIndex"] = numbers(given);
    }
}

NodePointer ShapeBuilder::faces_of(const TreePointer& node, const State& state, const Colours& colours) {
    NodePointer& known = geometries_[{node, state.coordinates, state.normals, state.normal_binding,
                                      state.texture_coordinates, state.hints, state.texture,
                                      colours.field != nullptr ? state.material : nullptr, state.material_binding}];
    if (known) return known;
    const NodePointer coordinates = list_node(state.coordinates, "Coordinate", "point", "point");
    if (!coordinates) return nullptr;
    const bool ordered = has_hint(state.hints, "vertexOrdering", "COUNTERCLOCKWISE") != 0 ||
                         has_hint(state.hints, "vertexOrdering", "CLOCKWISE") != 0;
    Fields fields{{"coord", nodes({coordinates})},
                  {"coordIndex", node->field("coordIndex")},
                  {"solid", numbers({ordered ? has_hint(state.hints, "shapeType", "SOLID") : 0.0})},
                  {"ccw", numbers({1 - has_hint(state.hints, "vertexOrdering", "CLOCKWISE")})},
                  {"convex", numbers({1 - has_hint(state.hints, "faceType", "UNKNOWN_FACE_TYPE")})},
                  {"creaseAngle", numbers({state.hints ? state.hints->number("creaseAngle") : 0.5})}};
    add_colours(fields, *node, state, colours);
    add_normals(fields, *node, state);
    if (state.texture) {
        if (const NodePointer places = list_node(state.texture_coordinates, "TextureCoordinate", "point", "point")) {
            fields["texCoord"] = nodes({places});
            const std::vector<double>& given = node->field("textureCoordIndex").numbers;
            if (is_given(given)) fields["texCoordIndex"] = numbers(given);
        }
    }
    known = make_node(builder_, "IndexedFaceSet", node->line, std::move(fields));
    return known;
}

NodePointer ShapeBuilder::lines_of(const TreePointer& node, const State& state, const Colours& colours) {
    const TreePointer material = colours.field != nullptr ? state.material : nullptr;
    NodePointer& known = geometries_[{node, state.coordinates, material, state.material_binding}];
    if (known) return known;
    const NodePointer coordinates = list_node(state.coordinates, "Coordinate", "point", "point");
    if (!coordinates) return nullptr;
    Fields fields{{"coord", nodes({coordinates})}, {"coordIndex", node->field("coordIndex")}};
    add_colours(fields, *node, state, colours);
    known = make_node(builder_, "IndexedLineSet", node->line, std::move(fields));
    return known;
}

NodePointer ShapeBuilder::points_of(const TreePointer& node, const State& state) {
    if (!state.coordinates) return nullptr;
    const std::vector<double>& all = state.coordinates->field("point").numbers;
    const std::size_t places = all.size() / 3;
    const auto total = static_cast<double>(places);
    const double begin = std::clamp(node->number("startIndex"), 0.0, total);
    const double given = node->number("numPoints");
    const double count = given < 0 ? total - begin : std::min(given, total - begin);
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(3 * begin);
    const NodePointer points = make_node(builder_, "Coordinate", node->line,
                                         {{"point", numbers({first, first + static_cast<std::ptrdiff_t>(3 * count)})}});
    return make_node(builder_, "PointSet", node->line, {{"coord", nodes({points})}});
}

NodePointer ShapeBuilder::text_of(const TreePointer& node, const State& state) {
    NodePointer& known = geometries_[{node, state.font}];
    if (known) return known;
    static const Tree kDefaultFont{.type = "FontStyle", .kind = find_kind("FontStyle")};
    const Tree& font = state.font ? *state.font : kDefaultFont;
    const std::string& family = font.text("family");
    const std::string style =
        std::string(font.has_part("style", "BOLD") ? "BOLD" : "") + (font.has_part("style", "ITALIC") ? "ITALIC" : "");
    const std::string& justification = node->text("justification");
    Fields font_fields{{"size", font.field("size")},
                       {"spacing", node->field("spacing")},
                       {"family", words(family == "SANS" || family == "TYPEWRITER" ? family : std::string("SERIF"))},
                       {"style", words(style.empty() ? "PLAIN" : style)},
                       {"justify", words(justification == "CENTER"  ? "MIDDLE"
                                         : justification == "RIGHT" ? "END"
                                                                    : "BEGIN")}};
    const NodePointer font_style = make_node(builder_, "FontStyle", node->line, std::move(font_fields));
    Fields fields{{"string", node->field("string")}, {"fontStyle", nodes({font_style})}};
    std::vector<double> widths = node->field("width").numbers;
    if (std::any_of(widths.begin(), widths.end(), [](double w) { return w > 0; })) fields["length"] = numbers(widths);
    known = make_node(builder_, "Text", node->line, std::move(fields));
    return known;
}

}  // namespace rs::compositor::vrml1
