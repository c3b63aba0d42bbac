#pragma once
// The graph of nodes that VRML97 text describes, or X3D in its classic encoding: PROTO unfolded, DEF and USE followed.
//
//   file -> read_graph -> flatten.hpp (shapes are cut into triangles by Coin: triangulate.hpp) -> Scene

#include "compositor/scene/vrml/node_table.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml {

constexpr int kMaxNesting = 200;         // brackets of the text
constexpr int kMaxHeight = 1000;         // of the graph, PROTO and USE followed
constexpr double kMaxVisits = 1e6;       // nodes that a walk over the graph meets, PROTO and USE followed
constexpr double kMaxValues = 32 << 20;  // numbers and texts, those of each instance of a PROTO counted
constexpr std::size_t kMaxWarnings = 50;

// Where the file has USE, the same node stands twice; so do parts of a PROTO that are the same in all instances.
struct Node {
    std::string type;  // as in VRML97: "Transform"
    const NodeSpec* spec = nullptr;
    std::string name;                                  // of its DEF; empty where it has none
    int line = 0;                                      // of the text
    std::map<std::string, Value, std::less<>> fields;  // those that the text gives
    int height = 0;                                    // nodes below it, one below the other
    double visits = 1;                                 // that a walk over it and all below takes

    [[nodiscard]] bool has(std::string_view key) const { return spec->fields.contains(key); }
    // For fields that the type has and whose type is right.
    [[nodiscard]] const Value& field(std::string_view key) const;
    [[nodiscard]] double number(std::string_view key) const { return field(key).numbers.at(0); }
    [[nodiscard]] bool flag(std::string_view key) const { return number(key) != 0; }
    [[nodiscard]] glm::dvec2 pair(std::string_view key) const;
    [[nodiscard]] glm::dvec3 triple(std::string_view key) const;
    [[nodiscard]] glm::dvec4 quadruple(std::string_view key) const;
    [[nodiscard]] const std::string& text(std::string_view key) const { return field(key).texts.at(0); }
    // Null where there is none.
    [[nodiscard]] NodePointer node(std::string_view key) const;
};

struct Graph {
    std::vector<NodePointer> roots;
    std::vector<std::string> warnings;  // "FILE: line N: ..."; at most kMaxWarnings and one that counts the rest
};

// Left out with a warning are unknown nodes (of those that group others the children stay) and unknown fields, nodes
// that stand where they may not, USE of a name that is not known or that holds the USE itself, EXTERNPROTO. Left out,
// since time stands still, are ROUTEs, scripts, sensors, interpolators and sound. Broken syntax, wrong types and what
// goes beyond the limits above refuse the text. `file` names it in messages; an error names the line. Pure;
// thread-safe.
Result<Graph> read_graph(std::string_view text, const std::string& file);

// The same of X3D text without its header, as x3d/xml_text.hpp makes it of XML.
Result<Graph> read_headless_graph(std::string_view text, const std::string& file);

}  // namespace rs::compositor::vrml
