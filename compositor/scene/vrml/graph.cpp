#include "compositor/scene/vrml/graph.hpp"

#include "rayspace/base/check.hpp"

namespace rs::compositor::vrml {

const Value& Node::field(std::string_view key) const {
    if (const auto given = fields.find(key); given != fields.end()) return given->second;
    const auto known = spec->fields.find(key);
    RS_CHECK(known != spec->fields.end());
    return known->second.initial;
}

glm::dvec2 Node::pair(std::string_view key) const {
    const std::vector<double>& n = field(key).numbers;
    return {n.at(0), n.at(1)};
}

glm::dvec3 Node::triple(std::string_view key) const {
    const std::vector<double>& n = field(key).numbers;
    return {n.at(0), n.at(1), n.at(2)};
}

glm::dvec4 Node::quadruple(std::string_view key) const {
    const std::vector<double>& n = field(key).numbers;
    return {n.at(0), n.at(1), n.at(2), n.at(3)};
}

NodePointer Node::node(std::string_view key) const {
    const Value& value = field(key);
    return value.nodes.empty() ? nullptr : value.nodes.front();
}

}  // namespace rs::compositor::vrml
