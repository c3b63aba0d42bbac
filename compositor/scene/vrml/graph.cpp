#include "compositor/scene/vrml/graph.hpp"

#include "compositor/scene/vrml/coin_pointer.hpp"
#include "compositor/scene/vrml/coin_session.hpp"
#include "compositor/scene/vrml/node_table.hpp"
#include "compositor/scene/vrml/shape_lists.hpp"
#include "compositor/scene/vrml/triangulate.hpp"
#include "rayspace/base/check.hpp"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/VRMLnodes/SoVRMLGroup.h>
#include <Inventor/fields/SoFields.h>
#include <Inventor/nodes/SoGroup.h>

#include <string>

namespace rs::compositor::vrml {
namespace {

constexpr double kMaxWork = 1e9;  // of all shapes of a file (ShapeCheck::work): about 10 s

// An instance of a PROTO is a group around its first node; a node that stands for nothing is null.
SoNode* without_wrapping(SoNode* node) {
    while (node != nullptr && node->getTypeId() == SoGroup::getClassTypeId()) {
        auto* group = static_cast<SoGroup*>(node);
        node = group->getNumChildren() > 0 ? group->getChild(0) : nullptr;
    }
    return node;
}

// The type's name in VRML97; empty where Coin has put a node of its own there, such as the definition of a PROTO.
std::string type_of(const SoNode& node) {
    const std::string name = node.getTypeId().getName().getString();
    for (const char* prefix : {"VRML", "Rs"}) {
        if (name.rfind(prefix, 0) == 0 && find_node(name.substr(std::string(prefix).size())) != nullptr) {
            return name.substr(std::string(prefix).size());
        }
    }
    return "";
}

template <class Field, class Put>
bool put_all(const SoField& field, const Put& put) {
    if (field.getTypeId() != Field::getClassTypeId()) return false;
    const auto& list = static_cast<const Field&>(field);
    for (int i = 0; i < list.getNum(); ++i) put(list[i]);
    return true;
}

template <class Field, class Put>
bool put_single(const SoField& field, const Put& put) {
    if (field.getTypeId() != Field::getClassTypeId()) return false;
    put(static_cast<const Field&>(field).getValue());
    return true;
}

// What a field holds, nodes excepted.
Value value_of(const SoField& field) {
    Value value;
    std::vector<double>& numbers = value.numbers;
    const auto scalar = [&](auto number) { numbers.push_back(static_cast<double>(number)); };
    const auto text = [&](const SbString& string) { value.texts.emplace_back(string.getString()); };
    const auto pair = [&](const SbVec2f& v) { numbers.insert(numbers.end(), {v[0], v[1]}); };
    const auto triple = [&](const SbVec3f& v) { numbers.insert(numbers.end(), {v[0], v[1], v[2]}); };
    const auto turn = [&](const SbRotation& rotation) {
        SbVec3f axis;
        float angle = 0;
        rotation.getValue(axis, angle);
        numbers.insert(numbers.end(), {axis[0], axis[1], axis[2], angle});
    };
    put_single<SoSFBool>(field, scalar) || put_single<SoSFInt32>(field, scalar) ||
        put_single<SoSFFloat>(field, scalar) || put_single<SoSFVec2f>(field, pair) ||
        put_single<SoSFVec3f>(field, triple) || put_single<SoSFColor>(field, triple) ||
        put_single<SoSFRotation>(field, turn) || put_single<SoSFString>(field, text) ||
        put_all<SoMFInt32>(field, scalar) || put_all<SoMFFloat>(field, scalar) || put_all<SoMFVec2f>(field, pair) ||
        put_all<SoMFVec3f>(field, triple) || put_all<SoMFColor>(field, triple) || put_all<SoMFRotation>(field, turn) ||
        put_all<SoMFString>(field, text);
    if (field.getTypeId() == SoSFImage::getClassTypeId()) {
        SbVec2s size;
        int components = 0;
        const unsigned char* bytes = static_cast<const SoSFImage&>(field).getValue(size, components);
        const std::ptrdiff_t count = bytes == nullptr ? 0 : std::ptrdiff_t{size[0]} * size[1] * components;
        numbers = {static_cast<double>(size[0]), static_cast<double>(size[1]), static_cast<double>(components)};
        numbers.insert(numbers.end(), bytes, bytes + count);
    }
    return value;
}

// The nodes of one reading.
class GraphReader {
public:
    GraphReader(const CleanVrml& clean, const std::string& file) : clean_(clean), file_(file) {}

    // Null where there is nothing.
    NodePointer convert(SoNode* wrapped) {
        SoNode* coin = without_wrapping(wrapped);
        if (coin == nullptr) return nullptr;
        if (const auto known = known_.find(coin); known != known_.end()) return known->second;
        const std::string type = type_of(*coin);
        if (type.empty()) return nullptr;
        auto node = std::make_shared<Node>();
        node->type = type;
        node->source = source_of(*coin, *wrapped);
        const NodeSpec& spec = *find_node(type);
        for (const auto& [name, field_spec] : spec.fields) {
            SoField* field = coin->getField(name.c_str());
            if (field == nullptr) continue;
            node->fields[name] =
                field_spec.type == FieldType::kNode ? nodes_of(*field, field_spec, *node) : value_of(*field);
        }
        if (spec.slot == "geometry") node->mesh = mesh_of(*node);
        known_[coin] = node;
        return node;
    }

    std::vector<std::string> warnings;

private:
    [[nodiscard]] SourceNode source_of(const SoNode& coin, const SoNode& wrapped) const {
        for (const SoNode* node : {&coin, &wrapped}) {
            const std::string name = node->getName().getString();
            if (name.size() < 2 || name[0] != 'n') continue;
            const std::size_t index = std::stoul(name.substr(1));
            if (index < clean_.nodes.size()) return clean_.nodes[index];
        }
        return {};
    }

    void warn(const Node& node, const std::string& what) {
        if (warnings.size() >= kMaxWarnings) return;
        const std::string line = node.source.line > 0 ? "line " + std::to_string(node.source.line) + ": " : "";
        warnings.push_back(file_ + ": " + line + node.type + ": " + what);
    }

    Value nodes_of(const SoField& field, const FieldSpec& spec, const Node& parent) {
        Value value;
        const auto add = [&](SoNode* coin) {
            NodePointer node = convert(coin);
            if (!node) return;
            // The text was checked, but not what comes through the fields of a PROTO.
            if (const NodeSpec* found = find_node(node->type); found->slot != spec.slot) {
                warn(parent, node->type + " cannot stand as " + spec.slot + "; left out");
                return;
            }
            value.nodes.push_back(std::move(node));
        };
        if (field.getTypeId() == SoSFNode::getClassTypeId()) add(static_cast<const SoSFNode&>(field).getValue());
        if (field.getTypeId() == SoMFNode::getClassTypeId()) {
            const auto& list = static_cast<const SoMFNode&>(field);
            for (int i = 0; i < list.getNum(); ++i) add(list[i]);
        }
        return value;
    }

    std::shared_ptr<const Mesh> mesh_of(const Node& node) {
        const ShapeCheck check = check_shape(node);
        if (!check.fault.empty()) {
            warn(node, check.fault + "; left out");
            return nullptr;
        }
        if (check.empty) return nullptr;
        if (work_ + check.work > kMaxWork) {
            warn(node, "cutting it into triangles would take too long; left out");
            return nullptr;
        }
        work_ += check.work;
        for (const std::string& field : check.unusable) warn(node, field + " does not fit the shape; left out");
        return triangulate(node, check);
    }

    double work_ = 0;
    const CleanVrml& clean_;
    const std::string& file_;
    std::map<const SoNode*, NodePointer> known_;
};

}  // namespace

const Value& Node::field(std::string_view name) const {
    const auto found = fields.find(name);
    RS_CHECK(found != fields.end());
    return found->second;
}

glm::dvec2 Node::pair(std::string_view name) const {
    const std::vector<double>& n = field(name).numbers;
    return {n.at(0), n.at(1)};
}

glm::dvec3 Node::triple(std::string_view name) const {
    const std::vector<double>& n = field(name).numbers;
    return {n.at(0), n.at(1), n.at(2)};
}

glm::dvec4 Node::quadruple(std::string_view name) const {
    const std::vector<double>& n = field(name).numbers;
    return {n.at(0), n.at(1), n.at(2), n.at(3)};
}

NodePointer Node::node(std::string_view name) const {
    const Value& value = field(name);
    return value.nodes.empty() ? nullptr : value.nodes.front();
}

Result<Graph> read_graph(const CleanVrml& clean, const std::string& file) {
    const CoinSession session;
    SoInput input;
    input.setBuffer(clean.text.data(), clean.text.size());
    const CoinPointer<SoVRMLGroup> root(SoDB::readAllVRML(&input));
    if (root.get() == nullptr) return Error{file + ": cannot be read: " + CoinSession::complaint()};
    GraphReader reader(clean, file);
    Graph graph;
    const auto add = [&](SoNode* coin) {
        if (NodePointer node = reader.convert(coin)) graph.roots.push_back(std::move(node));
    };
    // A group around all nodes, or the only node itself where that can have children.
    if (root->getTypeId() != SoVRMLGroup::getClassTypeId()) {
        add(root.get());
    } else {
        for (int i = 0; i < root->getNumChildren(); ++i) add(root->getChild(i));
    }
    graph.warnings = std::move(reader.warnings);
    return graph;
}

}  // namespace rs::compositor::vrml
