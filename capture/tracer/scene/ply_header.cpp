#include "capture/tracer/scene/ply_header.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <sstream>

namespace rs::capture {

namespace {

constexpr std::size_t kMaxHeader_bytes = 1 << 16;
constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 31;

using Problem = std::optional<std::string>;

std::optional<PlyScalar> scalar_type(const std::string& name) {
    static const std::map<std::string, PlyScalar> kTypes = {
        {"char", PlyScalar::int8},      {"int8", PlyScalar::int8},       {"uchar", PlyScalar::uint8},
        {"uint8", PlyScalar::uint8},    {"short", PlyScalar::int16},     {"int16", PlyScalar::int16},
        {"ushort", PlyScalar::uint16},  {"uint16", PlyScalar::uint16},   {"int", PlyScalar::int32},
        {"int32", PlyScalar::int32},    {"uint", PlyScalar::uint32},     {"uint32", PlyScalar::uint32},
        {"float", PlyScalar::float32},  {"float32", PlyScalar::float32}, {"double", PlyScalar::float64},
        {"float64", PlyScalar::float64}};
    const auto found = kTypes.find(name);
    return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

Problem parse_property(std::istringstream& words, PlyHeader& header) {
    std::string type;
    PlyProperty property;
    words >> type;
    if (type == "list") {
        std::string count_type;
        words >> count_type >> type;
        property.count_type = scalar_type(count_type);
        if (!property.count_type) return "unknown type \"" + count_type + "\"";
    }
    const auto known = scalar_type(type);
    if (!known) return "unknown type \"" + type + "\"";
    property.type = *known;
    if (!(words >> property.name) || header.elements.empty()) return "a property without name or element";
    PlyElement& element = header.elements.back();
    if (std::ranges::any_of(element.properties, [&](const PlyProperty& p) { return p.name == property.name; })) {
        return "element " + element.name + " has two properties \"" + property.name + "\"";
    }
    element.properties.push_back(property);
    return std::nullopt;
}

Problem parse_element(std::istringstream& words, PlyHeader& header) {
    PlyElement element;
    if (!(words >> element.name >> element.count)) return "an element without name or count";
    if (std::ranges::any_of(header.elements, [&](const PlyElement& e) { return e.name == element.name; })) {
        return "two elements are named \"" + element.name + "\"";
    }
    header.elements.push_back(element);
    return std::nullopt;
}

Problem parse_line(const std::string& line, PlyHeader& header) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "comment") {
        std::string what, file;
        if (words >> what && what == "TextureFile" && std::getline(words >> std::ws, file))
            header.texture_files.push_back(file);
        return std::nullopt;
    }
    if (keyword.empty() || keyword == "obj_info") return std::nullopt;
    if (keyword == "format") {
        std::string name;
        words >> name;
        if (name == "ascii") header.encoding = PlyEncoding::ascii;
        if (name == "binary_little_endian") header.encoding = PlyEncoding::little_endian;
        if (name == "binary_big_endian") header.encoding = PlyEncoding::big_endian;
        return header.encoding ? Problem{} : "unknown format \"" + name + "\"";
    }
    if (keyword == "element") return parse_element(words, header);
    if (keyword == "property") return parse_property(words, header);
    return "unknown header line \"" + keyword.substr(0, 40) + "\"";
}

Problem check_vertex_element(const PlyElement& element) {
    if (element.count > kMaxVertices) return "has more than 2^31 vertices; use a smaller mesh";
    for (const char* name : {"x", "y", "z"}) {
        const auto found = std::ranges::find(element.properties, name, &PlyProperty::name);
        if (found == element.properties.end()) return std::string("vertices have no ") + name;
        if (found->count_type) return std::string("vertex property ") + name + " is a list; it must be one number";
    }
    return std::nullopt;
}

Problem check_face_element(const PlyElement& element) {
    const auto lists = std::ranges::count_if(element.properties, &PlyProperty::is_vertex_list);
    const auto list = std::ranges::find_if(element.properties, &PlyProperty::is_vertex_list);
    if (lists != 1 || !list->count_type || !is_integer(*list->count_type) || !is_integer(list->type)) {
        return "element " + element.name + " needs one integer list named vertex_indices";
    }
    return std::nullopt;
}

Problem check_elements(const PlyHeader& header, bool points_allowed) {
    const auto holds = [&](std::initializer_list<const char*> names) {
        return std::ranges::any_of(header.elements, [&](const PlyElement& element) {
            return element.count > 0 && std::ranges::find(names, element.name) != names.end();
        });
    };
    if (points_allowed && !holds({"vertex"})) return "has no vertices; export it again";
    if (!holds({"vertex"}) || (!points_allowed && !holds({"face", "tristrips"}))) {
        return "has no faces; a mesh with triangles or polygons is needed";
    }
    if (holds({"face"}) && holds({"tristrips"})) return "has both faces and tristrips; keep one of them";
    bool vertices_seen = false;
    for (const PlyElement& element : header.elements) {
        if (element.count == 0) continue;
        if (element.properties.empty()) return "element " + element.name + " has no properties";
        Problem problem;
        if (element.name == "vertex") {
            vertices_seen = true;
            problem = check_vertex_element(element);
        } else if (element.name == "face" || element.name == "tristrips") {
            if (!vertices_seen) return "element " + element.name + " comes before element vertex";
            problem = check_face_element(element);
        }
        if (problem) return problem;
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::string> parse_ply_header(std::string_view file, PlyHeader& header, bool points_allowed) {
    std::size_t at = 0;
    for (bool first = true;; first = false) {
        const std::size_t end = file.find('\n', at);
        if (end == std::string_view::npos || end > kMaxHeader_bytes) return "the header has no end_header line";
        std::string line(file.substr(at, end - at));
        if (!line.empty() && line.back() == '\r') line.pop_back();
        at = end + 1;
        if (first) {
            if (line != "ply") return "is not a PLY file";
        } else if (line == "end_header") {
            header.size_bytes = at;
            return header.encoding ? check_elements(header, points_allowed) : Problem("the header has no format line");
        } else if (Problem problem = parse_line(line, header)) {
            return problem;
        }
    }
}

}  // namespace rs::capture
