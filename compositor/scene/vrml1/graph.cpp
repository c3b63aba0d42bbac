#include "compositor/scene/vrml1/graph.hpp"

#include "compositor/scene/vrml1/placement.hpp"
#include "compositor/scene/vrml1/state.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace rs::compositor::vrml1 {
namespace {

using vrml::Fields;
using vrml::MalformedVrml;
using vrml::NodePointer;

constexpr double kFarRadius = 1e9;  // of lights, which shine as far as they like

vrml::Value triple_of(const glm::dvec3& v) {
    return numbers({v.x, v.y, v.z});
}

class GraphMaker {
public:
    GraphMaker(std::string_view text, const std::string& file) : lexer_(text, file) {}

    vrml::Graph make() {
        const std::vector<TreePointer> roots =
            read_trees(lexer_, [&](int line, const std::string& what) { builder_.warn(line, what); });
        State state;
        scopes_.emplace_back();
        for (const TreePointer& root : roots) walk(root, state);
        close_scopes(1);
        std::vector<NodePointer> made = std::move(backgrounds_);
        std::vector<NodePointer>& rest = scopes_.front();
        made.insert(made.end(), rest.begin(), rest.end());
        double visits = 0;
        for (const NodePointer& root : made) visits += root->visits;
        builder_.check_extent(visits, 0);
        return {std::move(made), builder_.take_warnings()};
    }

private:
    void emit(NodePointer node) { scopes_.back().push_back(std::move(node)); }

    // A directional light shines on what comes behind it, until the separator around it ends: on its own group.
    void open_scope(NodePointer light) {
        scopes_.emplace_back();
        emit(std::move(light));
    }
    void close_scopes(std::size_t left) {
        while (scopes_.size() > left) {
            std::vector<NodePointer> children = std::move(scopes_.back());
            scopes_.pop_back();
            const int line = children.front()->line;
            emit(made_node(builder_, "Group", line, {{"children", nodes(std::move(children))}}));
        }
    }

    void walk(const TreePointer& node, State& state) {
        if (++visits_ > vrml::kMaxVisits)
            throw lexer_.wrong(node->line, "USE unfolds to too much to be shown; use it less");
        const vrml::Level level(lexer_, depth_, vrml::kMaxHeight, node->line);
        if (state.take(node)) return;
        if (const auto matrix = matrix_of(*node)) {
            state.matrix = state.matrix * *matrix;
            return;
        }
        const std::string& type = node->type;
        if (type == "Group") {
            for (const TreePointer& child : node->children) walk(child, state);
        } else if (type == "Switch") {
            walk_switch(*node, state);
        } else if (type == "TransformSeparator") {
            const glm::dmat4 matrix = state.matrix;
            for (const TreePointer& child : node->children) walk(child, state);
            state.matrix = matrix;
        } else if (type == "LOD") {
            if (!node->children.empty()) walk_apart({node->children.front()}, state);
        } else if (type == "WWWInline") {
            if (node->text("name").empty()) return;
            place(*node, state, {made_node(builder_, "Inline", node->line, {{"url", words(node->text("name"))}})});
        } else if (type == "Info") {
            walk_info(*node);
        } else if (type.ends_with("Camera")) {
            add_camera(*node, state);
        } else if (type.ends_with("Light")) {
            add_light(*node, state);
        } else if (!node->children.empty()) {
            walk_apart(node->children, state);  // Separator, WWWAnchor, and what is not known
        } else if (std::vector<NodePointer> shapes = shapes_.shapes_of(node, state); !shapes.empty()) {
            place(*node, state, std::move(shapes));
        }
    }

    void walk_apart(const std::vector<TreePointer>& children, const State& state) {
        State own = state;
        const std::size_t scopes = scopes_.size();
        for (const TreePointer& child : children) walk(child, own);
        close_scopes(scopes);
    }

    void walk_switch(const Tree& node, State& state) {
        const double which = node.number("whichChild");
        const auto count = static_cast<double>(node.children.size());
        if (which >= 0 && which < count) walk(node.children[static_cast<std::size_t>(which)], state);
        for (std::size_t i = 0; i < node.children.size(); ++i) {
            const TreePointer& child = node.children[i];
            const bool chosen = static_cast<double>(i) == which;
            if (which == -3 || (!chosen && child->type.ends_with("Camera"))) walk(child, state);
        }
    }

    // What has its place in the state's coordinates.
    void place(const Tree& node, const State& state, std::vector<NodePointer> children) {
        if (state.matrix == glm::dmat4(1.0)) {
            for (NodePointer& child : children) emit(std::move(child));
            return;
        }
        const std::optional<Placement> at = placement_of(state.matrix);
        if (!at) return builder_.warn(node.line, node.type + ": stands below a scale of 0; left out");
        const auto quadruple = [](const glm::dvec4& v) { return numbers({v.x, v.y, v.z, v.w}); };
        Fields fields{{"translation", triple_of(at->translation)},
                      {"rotation", quadruple(at->rotation)},
                      {"scale", triple_of(at->scale)},
                      {"scaleOrientation", quadruple(at->scale_orientation)},
                      {"children", nodes(std::move(children))}};
        emit(made_node(builder_, "Transform", node.line, std::move(fields)));
    }

    void walk_info(const Tree& node) {
        if (node.name != "BackgroundColor" || !backgrounds_.empty()) return;
        std::istringstream text(node.text("string"));
        text.imbue(std::locale::classic());
        glm::dvec3 colour(0);
        if (!(text >> colour.r >> colour.g >> colour.b)) return;
        backgrounds_ = {
            made_node(builder_, "Background", node.line, {{"skyColor", triple_of(glm::clamp(colour, 0.0, 1.0))}})};
    }

    void add_camera(const Tree& node, const State& state) {
        if (!node.kind->known) return;
        const bool flat = node.type == "OrthographicCamera";
        const double angle =
            flat ? 2 * std::atan(node.number("height") / 2 / std::max(node.number("focalDistance"), 1e-6))
                 : node.number("heightAngle");
        place(node, state,
              {made_node(builder_, "Viewpoint", node.line,
                         {{"position", node.field("position")},
                          {"orientation", node.field("orientation")},
                          {"fieldOfView", numbers({angle})},
                          {"description", words(node.name)}})});
    }

    void add_light(const Tree& node, const State& state) {
        if (!node.kind->known || node.number("on") == 0) return;
        Fields fields{{"intensity", node.field("intensity")}, {"color", node.field("color")}};
        if (node.type == "DirectionalLight") {
            const glm::dvec3 towards = glm::dmat3(state.matrix) * node.triple("direction");
            if (!(glm::length(towards) > 0) || !std::isfinite(glm::length(towards))) return;
            fields["direction"] = triple_of(glm::normalize(towards));
            return open_scope(made_node(builder_, "DirectionalLight", node.line, std::move(fields)));
        }
        fields["location"] = node.field("location");
        fields["radius"] = numbers({kFarRadius});
        if (node.type == "SpotLight") {
            const double cut_off = std::clamp(node.number("cutOffAngle"), 0.0, kPi / 2);
            const double drop_off = std::clamp(node.number("dropOffRate"), 0.0, 1.0);
            // Inventor's cosine to the power of 128 times the rate: as bright as half where VRML97 begins to drop.
            const double half = drop_off > 0 ? std::acos(std::pow(0.5, 1 / (128 * drop_off))) : cut_off;
            fields["direction"] = node.field("direction");
            fields["cutOffAngle"] = numbers({cut_off});
            fields["beamWidth"] = numbers({std::min(half, cut_off)});
        }
        place(node, state, {made_node(builder_, node.type.c_str(), node.line, std::move(fields))});
    }

    Lexer lexer_;
    vrml::GraphBuilder builder_{lexer_};
    ShapeMaker shapes_{builder_};
    std::vector<std::vector<NodePointer>> scopes_;  // what is made, by the directional light that shines on it
    std::vector<NodePointer> backgrounds_;          // one, or none
    double visits_ = 0;
    int depth_ = 0;
};

}  // namespace

Result<vrml::Graph> read_graph(std::string_view text, const std::string& file) {
    try {
        return GraphMaker(text, file).make();
    } catch (const MalformedVrml& malformed) {
        return Error{malformed.message};
    }
}

}  // namespace rs::compositor::vrml1
