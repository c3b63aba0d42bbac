#pragma once
// The tree of nodes that VRML 1.0 text describes (The Virtual Reality Modeling Language, version 1.0 specification).
// What a node means depends on those before it: graph.hpp turns the tree into the graph of VRML97. Private to the
// readers of VRML.

#include "compositor/scene/vrml/lexer.hpp"
#include "compositor/scene/vrml/node_table.hpp"

#include <glm/glm.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml1 {

using vrml::Lexer;
using vrml::Value;

enum class FieldKind {
    kBool,     // 0 or 1
    kInteger,  // one or a list
    kNumbers,  // `each` of them, or a list of as many
    kText,     // one or a list; quotes may be missing
    kWords,    // an enumeration, or a bit mask: (SIDES | TOP)
    kImage,    // width, height, components, pixels
};

struct Field {
    FieldKind kind = FieldKind::kNumbers;
    std::size_t each = 1;  // numbers in one value
    bool many = false;
    Value initial = {};
};

struct NodeKind {
    std::map<std::string, Field, std::less<>> fields = {};
    bool known = true;
};

struct Tree;
using TreePointer = std::shared_ptr<const Tree>;

// A node; where the text has USE the same one stands twice.
struct Tree {
    std::string type;
    const NodeKind* kind = nullptr;
    std::string name = {};  // of its DEF
    int line = 0;
    std::map<std::string, Value, std::less<>> fields = {};  // those that the text gives
    std::vector<TreePointer> children = {};

    // For fields that the kind has.
    [[nodiscard]] const Value& field(std::string_view key) const;
    [[nodiscard]] double number(std::string_view key) const { return field(key).numbers.at(0); }
    [[nodiscard]] glm::dvec3 triple(std::string_view key) const;
    [[nodiscard]] const std::string& text(std::string_view key) const { return field(key).texts.at(0); }
    // Of a kWords field: whether it has the word, or ALL.
    [[nodiscard]] bool has_part(std::string_view key, std::string_view word) const;
};

// Null where the node is not known.
const NodeKind* find_kind(std::string_view type);

// A value as the text has it. Throws MalformedVrml.
Value read_value(Lexer& lexer, const Field& field, const std::string& name);

// All nodes of the text behind its header. Unknown nodes stay with their children; unknown fields and USE of names that
// are not known go to `warn`. Throws MalformedVrml for broken syntax, wrong types and nodes that nest too deep.
using Warn = std::function<void(int line, const std::string& what)>;
std::vector<TreePointer> read_trees(Lexer& lexer, const Warn& warn);

}  // namespace rs::compositor::vrml1
