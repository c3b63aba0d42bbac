#pragma once
// Syntax tree of VRML 1.0 text (The Virtual Reality Modeling Language, version 1.0 specification). The meaning of a
// node depends on those before it: graph.hpp converts the tree to VRML97's graph. Private to the VRML readers.

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
    kInteger,  // one value or a list
    kNumbers,  // `each` numbers, or a list of such
    kText,     // one value or a list; quotes are optional
    kWords,    // enumeration or bit mask: (SIDES | TOP)
    kImage,    // width, height, components, pixels
};

struct Field {
    FieldKind kind = FieldKind::kNumbers;
    std::size_t each = 1;  // numbers per value
    bool many = false;
    Value initial = {};
};

struct NodeKind {
    std::map<std::string, Field, std::less<>> fields = {};
    bool known = true;
};

struct Tree;
using TreePointer = std::shared_ptr<const Tree>;

/// Node; shared by USE.
struct Tree {
    std::string type;
    const NodeKind* kind = nullptr;
    std::string name = {};  // DEF name
    int line = 0;
    std::map<std::string, Value, std::less<>> fields = {};  // fields given in the text
    std::vector<TreePointer> children = {};

    /// Value of a field that the kind has.
    [[nodiscard]] const Value& field(std::string_view key) const;
    [[nodiscard]] double number(std::string_view key) const { return field(key).numbers.at(0); }
    [[nodiscard]] glm::dvec3 triple(std::string_view key) const;
    [[nodiscard]] const std::string& text(std::string_view key) const { return field(key).texts.at(0); }
    /// kWords field: true if it contains the word or ALL.
    [[nodiscard]] bool has_part(std::string_view key, std::string_view word) const;
};

/// All kinds of nodes by type.
const std::map<std::string, NodeKind, std::less<>>& node_kinds();
/// Null for unknown nodes.
const NodeKind* find_kind(std::string_view type);

/// Parses a value. Throws MalformedVrml.
Value read_value(Lexer& lexer, const Field& field, const std::string& name);

/// Parses all nodes after the header. Unknown nodes are kept with their children; unknown fields and USE of undefined
/// names are reported to `warn`. Throws MalformedVrml for syntax errors, wrong types and excessive nesting.
using Warn = std::function<void(int line, const std::string& what)>;
std::vector<TreePointer> read_trees(Lexer& lexer, const Warn& warn);

}  // namespace rs::compositor::vrml1
