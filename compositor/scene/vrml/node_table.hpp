#pragma once
// The nodes and fields of VRML97 that are read, and the ray-space node. Pure; thread-safe.

#include <map>
#include <string>
#include <string_view>

namespace rs::compositor::vrml {

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
    std::string slot;   // of node fields: the group of nodes that may stand here
    bool operator==(const FieldSpec& other) const { return type == other.type && many == other.many; }
};

struct NodeSpec {
    std::string slot;       // the group that this node belongs to
    std::string coin_name;  // as the text for Coin calls it
    bool named = false;     // gets a name of ours even where the file gives none, so that messages can tell its line
    std::map<std::string, FieldSpec, std::less<>> fields;
};

// Null where the node is not known. Nodes that only matter when time passes (sensors, interpolators, scripts, sound)
// are not here but in is_behaviour().
const NodeSpec* find_node(std::string_view type);
bool is_behaviour(std::string_view type);

// Of a name such as "MFVec3f"; false where there is none.
bool parse_field_type(std::string_view name, FieldSpec& spec);
std::string field_type_name(const FieldSpec& spec);

}  // namespace rs::compositor::vrml
