#pragma once
// Node graph of VRML97 text, or of X3D in classic encoding, with PROTO expanded and DEF and USE resolved.
//
//   file -> read_graph -> flatten.hpp (shapes are cut into triangles by Coin: shapes.hpp) -> Scene

#include "compositor/scene/vrml/node_table.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml {

constexpr int kMaxNesting = 200;         // brackets in the text
constexpr int kMaxHeight = 1000;         // graph height after expansion
constexpr double kMaxVisits = 1e6;       // visited nodes in a traversal after expansion
constexpr double kMaxValues = 32 << 20;  // numbers and strings, those of each PROTO instance included
constexpr std::size_t kMaxWarnings = 50;

/// Nodes referenced by USE are shared, as are parts of a PROTO that are equal in all instances.
struct Node {
    std::string type;  // as in VRML97: "Transform"
    const NodeSpec* spec = nullptr;
    std::string name;                                  // DEF name; may be empty
    int line = 0;                                      // in the text
    std::map<std::string, Value, std::less<>> fields;  // fields given in the text
    int height = 0;                                    // height of the subtree below the node
    double visits = 1;                                 // visited nodes in a traversal of the subtree

    [[nodiscard]] bool has(std::string_view key) const { return spec->fields.contains(key); }
    /// Value of a field that the type has, with the matching type.
    [[nodiscard]] const Value& field(std::string_view key) const;
    [[nodiscard]] double number(std::string_view key) const { return field(key).numbers.at(0); }
    [[nodiscard]] bool flag(std::string_view key) const { return number(key) != 0; }
    [[nodiscard]] glm::dvec2 pair(std::string_view key) const;
    [[nodiscard]] glm::dvec3 triple(std::string_view key) const;
    [[nodiscard]] glm::dvec4 quadruple(std::string_view key) const;
    [[nodiscard]] const std::string& text(std::string_view key) const { return field(key).texts.at(0); }
    /// Null if absent.
    [[nodiscard]] NodePointer node(std::string_view key) const;
};

struct Graph {
    std::vector<NodePointer> roots;
    std::vector<std::string>
        warnings;  // "FILE: line N: ..."; at most kMaxWarnings, and one with the number of the others
};

/// Omitted with a warning: unknown nodes (the children of grouping nodes are kept), unknown fields, misplaced nodes,
/// USE of an undefined or enclosing name, EXTERNPROTO. Omitted silently, since scenes are static: ROUTEs, scripts,
/// sensors, interpolators and sound. Syntax errors, wrong types and exceeded limits are errors with their line.
/// \param file file name for messages.
/// Pure; thread-safe.
Result<Graph> read_graph(std::string_view text, const std::string& file);

/// Same for X3D text without header, as x3d/xml_text.hpp produces from XML.
Result<Graph> read_headless_graph(std::string_view text, const std::string& file);

}  // namespace rs::compositor::vrml
