#include "capture/tracer/ply_check.hpp"

#include "rayspace/file_output.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace rs::capture {

namespace {

constexpr std::uint64_t kMaxFile_bytes = std::uint64_t{4} << 30;
constexpr std::size_t kMaxHeader_bytes = 1 << 16;

enum class ScalarType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<ScalarType> scalar_type(const std::string& name) {
    static const std::map<std::string, ScalarType> kTypes = {
        {"char", ScalarType::int8},      {"int8", ScalarType::int8},       {"uchar", ScalarType::uint8},
        {"uint8", ScalarType::uint8},    {"short", ScalarType::int16},     {"int16", ScalarType::int16},
        {"ushort", ScalarType::uint16},  {"uint16", ScalarType::uint16},   {"int", ScalarType::int32},
        {"int32", ScalarType::int32},    {"uint", ScalarType::uint32},     {"uint32", ScalarType::uint32},
        {"float", ScalarType::float32},  {"float32", ScalarType::float32}, {"double", ScalarType::float64},
        {"float64", ScalarType::float64}};
    const auto found = kTypes.find(name);
    return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
    std::string name;
    ScalarType type = ScalarType::float32;
    std::optional<ScalarType> count_type;  // of a list
};
struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};
enum class Encoding { ascii, little_endian, big_endian };
struct Header {
    std::optional<Encoding> encoding;
    std::vector<Element> elements;
    std::size_t size_bytes = 0;
};

// Takes numbers from the body, one after the other.
class Body {
public:
    Body(std::string_view bytes, Encoding encoding) : rest_(bytes), encoding_(encoding) {}

    std::optional<double> next(ScalarType type) {
        return encoding_ == Encoding::ascii ? next_text() : next_binary(type);
    }

private:
    std::optional<double> next_text() {
        const std::size_t begin = rest_.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) return std::nullopt;
        const std::size_t end = std::min(rest_.find_first_of(" \t\r\n", begin), rest_.size());
        const std::string_view token = rest_.substr(begin, end - begin);
        rest_.remove_prefix(end);
        double value = 0;
        const std::size_t sign = token.starts_with('+') ? 1 : 0;
        const auto [stop, error] = std::from_chars(token.data() + sign, token.data() + token.size(), value);
        if (error != std::errc{} || stop != token.data() + token.size()) return std::nullopt;
        return value;
    }

    template <class T>
    std::optional<double> take() {
        if (rest_.size() < sizeof(T)) return std::nullopt;
        char bytes[sizeof(T)];
        const bool swap = encoding_ == Encoding::big_endian;
        for (std::size_t i = 0; i < sizeof(T); ++i) bytes[swap ? sizeof(T) - 1 - i : i] = rest_[i];
        rest_.remove_prefix(sizeof(T));
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return static_cast<double>(value);
    }
    std::optional<double> next_binary(ScalarType type) {
        switch (type) {
            case ScalarType::int8:
                return take<std::int8_t>();
            case ScalarType::uint8:
                return take<std::uint8_t>();
            case ScalarType::int16:
                return take<std::int16_t>();
            case ScalarType::uint16:
                return take<std::uint16_t>();
            case ScalarType::int32:
                return take<std::int32_t>();
            case ScalarType::uint32:
                return take<std::uint32_t>();
            case ScalarType::float32:
                return take<float>();
            case ScalarType::float64:
                return take<double>();
        }
        return std::nullopt;
    }

    std::string_view rest_;
    Encoding encoding_;
};

using Problem = std::optional<std::string>;

Problem parse_property(std::istringstream& words, Header& header) {
    std::string type;
    Property property;
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
    header.elements.back().properties.push_back(property);
    return std::nullopt;
}

Problem parse_header_line(const std::string& line, Header& header) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return std::nullopt;
    if (keyword == "format") {
        std::string name;
        words >> name;
        if (name == "ascii") header.encoding = Encoding::ascii;
        if (name == "binary_little_endian") header.encoding = Encoding::little_endian;
        if (name == "binary_big_endian") header.encoding = Encoding::big_endian;
        return header.encoding ? Problem{} : "unknown format \"" + name + "\"";
    }
    if (keyword == "element") {
        Element element;
        if (!(words >> element.name >> element.count)) return "an element without name or count";
        header.elements.push_back(element);
        return std::nullopt;
    }
    if (keyword == "property") return parse_property(words, header);
    return "unknown header line \"" + keyword.substr(0, 40) + "\"";
}

Problem parse_header(std::string_view file, Header& header) {
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
            return header.encoding ? Problem{} : Problem("the header names no format");
        } else if (Problem problem = parse_header_line(line, header)) {
            return problem;
        }
    }
}

Problem check_list(Body& body, const Property& property, bool vertex_indices, std::uint64_t vertex_count) {
    const auto count = body.next(*property.count_type);
    if (!count || *count < 0 || *count != std::floor(*count)) return "a list has no valid length";
    for (double i = 0; i < *count; ++i) {
        const auto value = body.next(property.type);
        if (!value) return "a list ends too early or holds something that is no number";
        const bool is_vertex = *value >= 0 && *value < static_cast<double>(vertex_count);
        if (vertex_indices && !is_vertex) return "a face names a vertex that does not exist";
    }
    return std::nullopt;
}

Problem check_body(std::string_view bytes, const Header& header) {
    std::uint64_t vertex_count = 0;
    std::uint64_t face_count = 0;
    for (const Element& element : header.elements) {
        if (element.name == "vertex") vertex_count = element.count;
        if (element.name == "face" || element.name == "tristrips") face_count += element.count;
    }
    if (vertex_count == 0 || face_count == 0) return "has no faces; a mesh with triangles or polygons is needed";
    Body body(bytes, *header.encoding);
    for (const Element& element : header.elements) {
        if (element.properties.empty() && element.count > 0) return "element " + element.name + " has no properties";
        for (std::uint64_t i = 0; i < element.count; ++i) {
            const auto place = [&] { return element.name + " " + std::to_string(i) + ": "; };
            for (const Property& property : element.properties) {
                if (property.count_type) {
                    const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
                    if (Problem problem = check_list(body, property, indices, vertex_count)) return place() + *problem;
                } else if (!body.next(property.type)) {
                    return place() + property.name + " is missing or no number; the file may be cut off";
                }
            }
        }
    }
    return std::nullopt;
}

}  // namespace

Status check_ply_file(const std::filesystem::path& path) {
    const auto bytes = read_file(path, kMaxFile_bytes);
    if (!bytes) return bytes.error();
    const std::string_view file(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    Header header;
    Problem problem = parse_header(file, header);
    if (!problem) problem = check_body(file.substr(header.size_bytes), header);
    if (problem) return Error{path.string() + ": cannot be read as a mesh: " + *problem};
    return {};
}

}  // namespace rs::capture
