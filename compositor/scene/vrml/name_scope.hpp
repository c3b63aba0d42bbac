#pragma once
// The names that a piece of VRML text has defined so far. The body of a PROTO has names of its own, but knows the
// PROTOs around it. Private to the VRML reader.

#include "compositor/scene/vrml/node_table.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml {

// How much a node unfolds to when PROTO and USE are followed.
struct Extent {
    int height = 0;
    double visits = 0;
    double values = 0;

    void add_child(const Extent& child) {
        height = std::max(height, child.height + 1);
        visits += child.visits;
        values += child.values;
    }
};

struct NamedNode {
    std::size_t index = 0;  // in CleanVrml::nodes
    std::string slot;
    Extent extent;
    bool open = true;  // its body is not closed yet: a USE would make the graph a ring
};

struct Prototype {
    std::string coin_name;
    std::string slot;  // of its first node
    Extent body;
    double node_uses = 0;  // how often the body uses fields that hold nodes
    struct Field {
        std::string coin_name;
        FieldSpec spec;
    };
    std::map<std::string, Field, std::less<>> fields;
    std::map<std::string, FieldSpec, std::less<>> events;  // eventIn, eventOut: nothing comes through them
};

struct NameScope {
    NameScope* outer = nullptr;
    Prototype* inside = nullptr;  // whose body this is
    std::map<std::string, NamedNode, std::less<>> nodes;
    std::map<std::string, Prototype, std::less<>> prototypes;

    [[nodiscard]] const Prototype* find_prototype(std::string_view name) const {
        for (const NameScope* scope = this; scope != nullptr; scope = scope->outer) {
            if (const auto found = scope->prototypes.find(name); found != scope->prototypes.end()) {
                return &found->second;
            }
        }
        return nullptr;
    }
};

}  // namespace rs::compositor::vrml
