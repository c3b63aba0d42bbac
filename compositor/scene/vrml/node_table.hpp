#pragma once
// Supported nodes and fields of VRML97, and those of ray space. Pure; thread-safe.

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml {

struct Node;
using NodePointer = std::shared_ptr<const Node>;

/// Field value in one of the lists. Vectors, colours and rotations take one number per component, TRUE and FALSE are 1
/// and 0, an image is width, height, components, then one number per pixel.
struct Value {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::vector<NodePointer> nodes;  // not null
};

enum class FieldType {
    kBool,
    kInt32,
    kFloat,
    kTime,
    kVec2f,
    kVec3f,
    kColor,
    kRotation,
    kString,
    kImage,
    kNode,
};

/// Numbers of one value; 1 for values that are no numbers.
int numbers_in(FieldType type);

struct FieldSpec {
    FieldType type = FieldType::kFloat;
    bool many = false;  // MF...
    std::string slot;   // node fields: required group of nodes; empty: any
    Value initial;      // default value

    [[nodiscard]] bool same_type(const FieldSpec& other) const { return type == other.type && many == other.many; }
};
using FieldSpecs = std::map<std::string, FieldSpec, std::less<>>;

struct NodeSpec {
    std::string slot;  // group of this node
    FieldSpecs fields;
};

/// All nodes by type.
const std::map<std::string, NodeSpec, std::less<>>& node_table();
/// Types of the nodes that have no effect in static scenes.
const std::set<std::string, std::less<>>& behaviours();

/// Null for unknown nodes. Nodes without effect in static scenes (sensors, interpolators, scripts, sound) are only in
/// is_behaviour().
const NodeSpec* find_node(std::string_view type);
bool is_behaviour(std::string_view type);

/// Parses a type name such as "MFVec3f"; false if there is none.
bool parse_field_type(std::string_view name, FieldSpec& spec);
std::string field_type_name(const FieldSpec& spec);

}  // namespace rs::compositor::vrml
