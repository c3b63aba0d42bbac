// Conversion of X3D's additional shapes to those of VRML97.

#include "compositor/scene/vrml/shapes.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor::vrml {
namespace {

using Indices = std::vector<double>;

std::shared_ptr<Node> new_node(const char* type, int line) {
    auto node = std::make_shared<Node>();
    node->type = type;
    node->spec = find_node(type);
    node->line = line;
    return node;
}

Value value_of(Indices numbers) {
    Value value;
    value.numbers = std::move(numbers);
    return value;
}

// Colours without alpha; null if there are none.
NodePointer opaque_colours(const Node& geometry) {
    const NodePointer colours = geometry.has("color") ? geometry.node("color") : nullptr;
    if (!colours || colours->type != "ColorRGBA") return nullptr;
    auto plain = new_node("Color", colours->line);
    const Indices& given = colours->field("color").numbers;
    Indices& kept = plain->fields["color"].numbers;
    for (std::size_t i = 0; i + 3 < given.size(); i += 4)
        kept.insert(kept.end(), {given[i], given[i + 1], given[i + 2]});
    return plain;
}

// 0, 1, ... per point.
Indices all_points(const Node& geometry) {
    const NodePointer points = geometry.node("coord");
    Indices indices(points ? points->field("point").numbers.size() / 3 : 0);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<double>(i);
    return indices;
}

// Consecutive runs of the given lengths, each followed by -1.
Indices make_runs(const Indices& points, const Indices& counts) {
    Indices made;
    std::size_t next = 0;
    for (const double count : counts) {
        if (!(count > 0) || count > static_cast<double>(points.size() - next)) break;
        const auto first = points.begin() + static_cast<std::ptrdiff_t>(next);
        made.insert(made.end(), first, first + static_cast<std::ptrdiff_t>(count));
        made.push_back(-1);
        next += static_cast<std::size_t>(count);
    }
    return made;
}

// Faces of `corners` consecutive indices.
Indices faces_of(const Indices& list, std::size_t corners) {
    Indices faces;
    for (std::size_t i = 0; i + corners <= list.size(); i += corners) {
        const auto first = list.begin() + static_cast<std::ptrdiff_t>(i);
        faces.insert(faces.end(), first, first + static_cast<std::ptrdiff_t>(corners));
        faces.push_back(-1);
    }
    return faces;
}

// Triangles of strips or fans, which end with -1.
Indices triangles_of(const Indices& list, bool fans) {
    Indices faces;
    for (std::size_t begin = 0; begin < list.size();) {
        std::size_t end = begin;
        while (end < list.size() && list[end] >= 0) ++end;
        for (std::size_t i = begin; i + 2 < end; ++i) {
            // Every other triangle of a strip has the opposite orientation.
            const bool odd = (i - begin) % 2 != 0;
            const double a = fans ? list[begin] : list[odd ? i + 1 : i];
            const double b = fans ? list[i + 1] : list[odd ? i : i + 1];
            faces.insert(faces.end(), {a, b, list[i + 2], -1});
        }
        begin = end + 1;
    }
    return faces;
}

Indices face_list(const Node& geometry) {
    const std::string& type = geometry.type;
    const bool indexed = geometry.has("index");
    const Indices points = indexed ? geometry.field("index").numbers : all_points(geometry);
    if (type.ends_with("QuadSet")) return faces_of(points, 4);
    if (type.ends_with("TriangleSet")) return faces_of(points, 3);
    const bool fans = type.ends_with("FanSet");
    if (indexed) return triangles_of(points, fans);
    return triangles_of(make_runs(points, geometry.field(fans ? "fanCount" : "stripCount").numbers), fans);
}

NodePointer rectangle(const Node& geometry) {
    const glm::dvec2 half = geometry.pair("size") * 0.5;
    auto points = new_node("Coordinate", geometry.line);
    points->fields["point"] =
        value_of({-half.x, -half.y, 0, half.x, -half.y, 0, half.x, half.y, 0, -half.x, half.y, 0});
    auto places = new_node("TextureCoordinate", geometry.line);
    places->fields["point"] = value_of({0, 0, 1, 0, 1, 1, 0, 1});
    auto faces = new_node("IndexedFaceSet", geometry.line);
    faces->fields["coordIndex"] = value_of({0, 1, 2, 3, -1});
    faces->fields["coord"].nodes = {std::move(points)};
    faces->fields["texCoord"].nodes = {std::move(places)};
    faces->fields["solid"] = geometry.field("solid");
    return faces;
}

}  // namespace

NodePointer to_vrml97(const Node& geometry) {
    if (geometry.type == "Rectangle2D") return rectangle(geometry);
    const NodePointer colours = opaque_colours(geometry);
    const bool is_line_set = geometry.type == "LineSet";
    const bool is_faces = geometry.type.ends_with("TriangleSet") || geometry.type.ends_with("FanSet") ||
                          geometry.type.ends_with("StripSet") || geometry.type.ends_with("QuadSet");
    if (!is_line_set && !is_faces && !colours) return nullptr;
    auto made = std::make_shared<Node>(geometry);
    if (is_line_set) {
        made->type = "IndexedLineSet";
        made->fields.erase("vertexCount");
        made->fields["coordIndex"] = value_of(make_runs(all_points(geometry), geometry.field("vertexCount").numbers));
    } else if (is_faces) {
        made->type = "IndexedFaceSet";
        for (const char* field : {"index", "fanCount", "stripCount"}) made->fields.erase(field);
        made->fields["coordIndex"] = value_of(face_list(geometry));
        // Shared points share a normal; separate triangles share none.
        const bool smooth =
            geometry.flag("normalPerVertex") && geometry.type != "TriangleSet" && geometry.type != "QuadSet";
        made->fields["creaseAngle"] = value_of({smooth ? kPi : 0});
    }
    made->spec = find_node(made->type);
    if (colours) made->fields["color"].nodes = {colours};
    return made;
}

}  // namespace rs::compositor::vrml
