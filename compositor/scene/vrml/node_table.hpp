#pragma once
// The nodes and fields of VRML97 that are read, and those of ray space. Pure; thread-safe.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml {

struct Node;
using NodePointer = std::shared_ptr<const Node>;

// The value of a field; one of the lists is used. A vector, colour or rotation takes as many numbers as it has parts,
// TRUE and FALSE are 1 and 0, an image is its width, height and components and then a number for each pixel.
struct Value {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    std::vector<NodePointer> nodes;  // none of them null
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

struct FieldSpec {
    FieldType type = FieldType::kFloat;
    bool many = false;  // MF...
    std::string slot;   // of node fields: the group of nodes that may stand here; empty: any
    Value initial;      // where a node does not give it

    [[nodiscard]] bool same_type(const FieldSpec& other) const { return type == other.type && many == other.many; }
};
using FieldSpecs = std::map<std::string, FieldSpec, std::less<>>;

struct NodeSpec {
    std::string slot;  // the group that this node belongs to
    FieldSpecs fields;
};

// Null where the node is not known. Nodes that only matter when time passes (sensors, interpolators, scripts, sound)
// are not here but in is_behaviour().
const NodeSpec* find_node(std::string_view type);
bool is_behaviour(std::string_view type);

// Of a name such as "MFVec3f"; false where there is none.
bool parse_field_type(std::string_view name, FieldSpec& spec);
std::string field_type_name(const FieldSpec& spec);

}  // namespace rs::compositor::vrml
