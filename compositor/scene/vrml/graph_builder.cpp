#include "compositor/scene/vrml/graph_builder.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor::vrml {

void GraphBuilder::warn(int line, const std::string& what) {
    if (warnings_.size() >= kMaxWarnings) {
        ++more_warnings_;
        return;
    }
    warnings_.push_back(lexer_.error(line, what).message);
}

void GraphBuilder::check_extent(double visits, int height) const {
    if (height > kMaxHeight) {
        throw lexer_.error("the nodes nest more than " + std::to_string(kMaxHeight) +
                           " deep, PROTO and USE followed; flatten them");
    }
    if (visits > kMaxVisits || nodes_ > kMaxVisits || values_ > kMaxValues) {
        throw lexer_.error("PROTO and USE expand to too many nodes; use them less");
    }
}

void GraphBuilder::count(const Value& value) {
    values_ += static_cast<double>(value.numbers.size());
    for (const std::string& text : value.texts) {
        const std::size_t words = text.size() / 8;
        values_ += static_cast<double>(1 + words);
    }
}

bool GraphBuilder::has_patterns(const Node& node) const {
    return std::any_of(node.fields.begin(), node.fields.end(), [&](const auto& field) {
        const std::vector<NodePointer>& nodes = field.second.nodes;
        return std::any_of(nodes.begin(), nodes.end(),
                           [&](const NodePointer& child) { return patterns_.contains(child.get()); });
    });
}

NodePointer GraphBuilder::finish_node(const std::shared_ptr<Node>& node, Pattern pattern) {
    for (const auto& [name, value] : node->fields) {
        for (const NodePointer& child : value.nodes) {
            node->height = std::max(node->height, child->height + 1);
            node->visits += child->visits;
        }
    }
    nodes_ += 1;
    check_extent(node->visits, node->height);
    if (!pattern.is.empty() || pattern.instance_of != nullptr || has_patterns(*node)) {
        pattern.node = node;
        patterns_[node.get()] = std::move(pattern);
    }
    return node;
}

// State while a PROTO is instantiated.
struct GraphBuilder::InstantiationState {
    const Prototype& prototype;
    const Fields& arguments;
    std::map<const Node*, NodePointer> made;

    [[nodiscard]] const Value& argument(const std::string& name) const {
        const auto given = arguments.find(name);
        return given != arguments.end() ? given->second : prototype.fields.find(name)->second.initial;
    }
};

NodePointer GraphBuilder::instantiate(const Prototype& prototype, const Fields& arguments) {
    InstantiationState copies{prototype, arguments, {}};
    return copy_node(prototype.root, copies);
}

NodePointer GraphBuilder::copy_node(const NodePointer& from, InstantiationState& copies) {
    const auto found = patterns_.find(from.get());
    if (found == patterns_.end()) return from;
    if (const auto known = copies.made.find(from.get()); known != copies.made.end()) return known->second;
    const NestingGuard guard(lexer_, unfolding_, kMaxHeight, from->line);
    const Pattern& pattern = found->second;
    auto node = std::make_shared<Node>();
    node->type = from->type;
    node->spec = from->spec;
    node->name = from->name;
    node->line = from->line;
    for (const auto& [name, value] : from->fields) {
        Value& to = node->fields[name];
        to.numbers = value.numbers;
        to.texts = value.texts;
        for (const NodePointer& child : value.nodes) {
            if (NodePointer copy = copy_node(child, copies)) to.nodes.push_back(std::move(copy));
        }
        count(to);
    }
    for (const auto& [name, argument] : pattern.is) {
        Value& to = node->fields[name] = copies.argument(argument);
        count(to);
        if (pattern.instance_of != nullptr) continue;
        const std::string& slot = node->spec->fields.find(name)->second.slot;
        std::erase_if(to.nodes, [&](const NodePointer& child) {
            if (slot.empty() || slot == child->spec->slot) return false;
            warn(node->line, node->type + ": " + child->type + " is not allowed as " + slot + "; left out");
            return true;
        });
    }
    NodePointer made =
        pattern.instance_of != nullptr ? instantiate(*pattern.instance_of, node->fields) : finish_node(node, {});
    copies.made[from.get()] = made;
    return made;
}

std::vector<std::string> GraphBuilder::take_warnings() {
    if (more_warnings_ > 0) {
        warnings_.push_back(lexer_.file() + ": and " + std::to_string(more_warnings_) + " more warnings");
    }
    return std::move(warnings_);
}

}  // namespace rs::compositor::vrml
