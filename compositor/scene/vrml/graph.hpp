#pragma once
// The second of the two steps in which VRML97 is read: Coin reads the text, unfolds PROTO, follows DEF and USE, and
// cuts the shapes into triangles. This header and its source are the only place that knows Coin.

#include "compositor/scene/mesh.hpp"
#include "compositor/scene/vrml/clean_vrml.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

struct Node;
using NodePointer = std::shared_ptr<const Node>;

// The value of a field; one of the lists is used. A vector, colour or rotation takes as many numbers as it has parts,
// TRUE and FALSE are 1 and 0.
struct Value {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::vector<NodePointer> nodes;  // none of them null
};

// A node of the graph. Where the file says USE, the same node stands twice. PROTO instances are their first nodes.
struct Node {
    std::string type;                                  // as in VRML97: "Transform"
    SourceNode source;                                 // name and line; line 0 where nobody asked for it
    std::map<std::string, Value, std::less<>> fields;  // all fields of the type, defaults filled in
    std::shared_ptr<const Mesh> mesh;                  // of a geometry node that can be drawn

    // For fields that the type has (node_table.hpp) and whose type is right.
    [[nodiscard]] const Value& field(std::string_view name) const;
    [[nodiscard]] double number(std::string_view name) const { return field(name).numbers.at(0); }
    [[nodiscard]] bool flag(std::string_view name) const { return number(name) != 0; }
    [[nodiscard]] glm::dvec2 pair(std::string_view name) const;
    [[nodiscard]] glm::dvec3 triple(std::string_view name) const;
    [[nodiscard]] glm::dvec4 quadruple(std::string_view name) const;
    [[nodiscard]] std::string text(std::string_view name) const { return field(name).texts.at(0); }
    // Null where there is none.
    [[nodiscard]] NodePointer node(std::string_view name) const;
};

struct Graph {
    std::vector<NodePointer> roots;
    std::vector<std::string> warnings;  // "FILE: line N: ..."
};

// `file` names the text in messages. Coin keeps state for the whole process: one call works at a time, others wait.
// May be called from any thread.
Result<Graph> read_graph(const CleanVrml& clean, const std::string& file);

}  // namespace rs::compositor::vrml
