#include "compositor/scene/vrml1/graph.hpp"

#include "compositor/scene/vrml/traversal_state.hpp"
#include "compositor/scene/vrml1/state.hpp"
#include "rayspace/base/conventions.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace rs::compositor::vrml1 {
namespace {

using vrml::Fields;
using vrml::MalformedVrml;
using vrml::NodePointer;

constexpr std::size_t kMaxPlacedNodes = 100'000;  // number of shapes, lights and cameras: the limit of a scene's draws
constexpr double kUnlimitedRadius = 1e9;          // of lights with unlimited range

vrml::Value triple_of(const glm::dvec3& v) {
    return numbers({v.x, v.y, v.z});
}

// matrix = translation * rotation * (scaleOrientation * scale * scaleOrientation^-1), rotations as axis and angle.
struct Placement {
    glm::dvec3 translation{0};
    glm::dvec4 rotation{0, 0, 1, 0};
    glm::dvec3 scale{1};
    glm::dvec4 scale_orientation{0, 0, 1, 0};
};

glm::dmat4 moved(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    m[3] = glm::dvec4(by, 1);
    return m;
}

glm::dmat4 scaled(const glm::dvec3& by) {
    glm::dmat4 m(1.0);
    for (int axis = 0; axis < 3; ++axis) m[axis][axis] = by[axis];
    return m;
}

glm::dmat4 turned(const Tree& node, const char* key) {
    const std::vector<double>& n = node.field(key).numbers;
    return vrml::rotation_matrix({n.at(0), n.at(1), n.at(2), n.at(3)});
}

glm::dvec4 axis_and_angle(const glm::dmat3& rotation) {
    const glm::dquat q = glm::normalize(glm::quat_cast(rotation));
    const glm::dvec3 axis(q.x, q.y, q.z);
    const double sine = glm::length(axis);
    if (!(sine > 1e-12)) return {0, 0, 1, 0};
    return {axis / sine, 2 * std::atan2(sine, q.w)};
}

// Nearest rotation to an invertible matrix without mirroring: Newton's iteration.
glm::dmat3 nearest_rotation(glm::dmat3 m) {
    for (int i = 0; i < 100; ++i) {
        const glm::dmat3 back = glm::transpose(glm::inverse(m));
        // Scaling by the ratio of sizes makes it converge in a few steps.
        const double size = std::sqrt(std::cbrt(std::abs(glm::determinant(back) / glm::determinant(m))));
        const glm::dmat3 next = 0.5 * (size * m + back / size);
        double change = 0;
        for (int c = 0; c < 3; ++c) change += glm::length(next[c] - m[c]);
        m = next;
        if (change < 1e-15) break;
    }
    return m;
}

// Axes of a symmetric matrix by Jacobi rotations; `m` becomes diagonal.
glm::dmat3 principal_axes(glm::dmat3& m) {
    glm::dmat3 axes(1.0);
    for (int sweep = 0; sweep < 30; ++sweep) {
        for (const auto& [p, q] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
            if (std::abs(m[p][q]) <= 1e-12 * (std::abs(m[p][p]) + std::abs(m[q][q]))) continue;
            const double angle = 0.5 * std::atan2(2 * m[p][q], m[p][p] - m[q][q]);
            glm::dmat3 turn(1.0);
            turn[p][p] = turn[q][q] = std::cos(angle);
            turn[p][q] = std::sin(angle);
            turn[q][p] = -std::sin(angle);
            m = glm::transpose(turn) * m * turn;
            axes = axes * turn;
        }
    }
    return axes;
}

// Matrix of a Transform, Translation, Rotation, Scale or MatrixTransform; nullopt for other nodes.
std::optional<glm::dmat4> matrix_of(const Tree& node) {
    if (node.type == "Translation") return moved(node.triple("translation"));
    if (node.type == "Rotation") return turned(node, "rotation");
    if (node.type == "Scale") return scaled(node.triple("scaleFactor"));
    if (node.type == "MatrixTransform") {
        // VRML 1.0 transforms row vectors, so its rows are our columns.
        const std::vector<double>& n = node.field("matrix").numbers;
        glm::dmat4 m(1.0);
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = n.at(static_cast<std::size_t>(i));
        for (int column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1 : 0;
        return m;
    }
    if (node.type != "Transform") return std::nullopt;
    const glm::dmat4 stretch = turned(node, "scaleOrientation");
    return moved(node.triple("translation") + node.triple("center")) * turned(node, "rotation") * stretch *
           scaled(node.triple("scaleFactor")) * glm::transpose(stretch) * moved(-node.triple("center"));
}

// The fields of VRML97's Transform for a matrix; nullopt if the matrix is singular.
std::optional<Placement> placement_of(const glm::dmat4& matrix) {
    glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    const double size = glm::length(linear[0]) + glm::length(linear[1]) + glm::length(linear[2]);
    if (!std::isfinite(determinant) || !std::isfinite(glm::length(glm::dvec3(matrix[3]))) ||
        !(std::abs(determinant) > 1e-12 * size * size * size) || !(std::abs(determinant) > 1e-30)) {
        return std::nullopt;
    }
    const double sign = determinant < 0 ? -1 : 1;
    const glm::dmat3 rotation = nearest_rotation(sign * linear);
    glm::dmat3 stretch = glm::transpose(rotation) * linear;
    stretch = 0.5 * (stretch + glm::transpose(stretch));
    const glm::dmat3 axes = principal_axes(stretch);
    Placement placement;
    placement.translation = glm::dvec3(matrix[3]);
    placement.rotation = axis_and_angle(rotation);
    placement.scale = {stretch[0][0], stretch[1][1], stretch[2][2]};
    placement.scale_orientation = axis_and_angle(axes);
    return placement;
}

class GraphConverter {
public:
    GraphConverter(std::string_view text, const std::string& file) : lexer_(text, file) {}

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

    // A directional light applies to the nodes after it up to the end of its separator, which form a group.
    void open_scope(NodePointer light) {
        scopes_.emplace_back();
        emit(std::move(light));
    }
    void close_scopes(std::size_t left) {
        while (scopes_.size() > left) {
            std::vector<NodePointer> children = std::move(scopes_.back());
            scopes_.pop_back();
            const int line = children.front()->line;
            emit(make_node(builder_, "Group", line, {{"children", nodes(std::move(children))}}));
        }
    }

    void walk(const TreePointer& node, State& state) {
        if (++visits_ > vrml::kMaxVisits) throw lexer_.error(node->line, "USE expands to too many nodes; use it less");
        const vrml::NestingGuard guard(lexer_, depth_, vrml::kMaxHeight, node->line);
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
            if (!node->children.empty()) walk_separator({node->children.front()}, state);
        } else if (type == "WWWInline") {
            if (node->text("name").empty()) return;
            place(*node, state, {make_node(builder_, "Inline", node->line, {{"url", words(node->text("name"))}})});
        } else if (type == "Info") {
            walk_info(*node);
        } else if (type.ends_with("Camera")) {
            add_camera(*node, state);
        } else if (type.ends_with("Light")) {
            add_light(*node, state);
        } else if (!node->children.empty()) {
            walk_separator(node->children, state);  // Separator, WWWAnchor, and unknown nodes
        } else if (std::vector<NodePointer> shapes = shapes_.shapes_of(node, state); !shapes.empty()) {
            place(*node, state, std::move(shapes));
        }
    }

    void walk_separator(const std::vector<TreePointer>& children, const State& state) {
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

    // Emits nodes in the coordinates of the state.
    void place(const Tree& node, const State& state, std::vector<NodePointer> children) {
        placed_ += children.size();
        if (placed_ > kMaxPlacedNodes) throw lexer_.error(node.line, "USE expands to too many nodes; use it less");
        if (state.matrix == glm::dmat4(1.0)) {
            for (NodePointer& child : children) emit(std::move(child));
            return;
        }
        const std::optional<Placement> at = placement_of(state.matrix);
        if (!at) return builder_.warn(node.line, node.type + ": is below a scale of 0; left out");
        const auto quadruple = [](const glm::dvec4& v) { return numbers({v.x, v.y, v.z, v.w}); };
        Fields fields{{"translation", triple_of(at->translation)},
                      {"rotation", quadruple(at->rotation)},
                      {"scale", triple_of(at->scale)},
                      {"scaleOrientation", quadruple(at->scale_orientation)},
                      {"children", nodes(std::move(children))}};
        emit(make_node(builder_, "Transform", node.line, std::move(fields)));
    }

    void walk_info(const Tree& node) {
        if (node.name != "BackgroundColor" || !backgrounds_.empty()) return;
        std::istringstream text(node.text("string"));
        text.imbue(std::locale::classic());
        glm::dvec3 colour(0);
        if (!(text >> colour.r >> colour.g >> colour.b)) return;
        backgrounds_ = {
            make_node(builder_, "Background", node.line, {{"skyColor", triple_of(glm::clamp(colour, 0.0, 1.0))}})};
    }

    void add_camera(const Tree& node, const State& state) {
        if (!node.kind->known) return;
        const bool flat = node.type == "OrthographicCamera";
        const double angle =
            flat ? 2 * std::atan(node.number("height") / 2 / std::max(node.number("focalDistance"), 1e-6))
                 : node.number("heightAngle");
        place(node, state,
              {make_node(builder_, "Viewpoint", node.line,
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
            return open_scope(make_node(builder_, "DirectionalLight", node.line, std::move(fields)));
        }
        fields["location"] = node.field("location");
        fields["radius"] = numbers({kUnlimitedRadius});
        if (node.type == "SpotLight") {
            const double cut_off = std::clamp(node.number("cutOffAngle"), 0.0, kPi / 2);
            const double drop_off = std::clamp(node.number("dropOffRate"), 0.0, 1.0);
            // Inventor's falloff is cos^(128 * rate): VRML97's beam width is set where it reaches one half.
            const double half = drop_off > 0 ? std::acos(std::pow(0.5, 1 / (128 * drop_off))) : cut_off;
            fields["direction"] = node.field("direction");
            fields["cutOffAngle"] = numbers({cut_off});
            fields["beamWidth"] = numbers({std::min(half, cut_off)});
        }
        place(node, state, {make_node(builder_, node.type.c_str(), node.line, std::move(fields))});
    }

    Lexer lexer_;
    vrml::GraphBuilder builder_{lexer_};
    ShapeBuilder shapes_{builder_};
    std::vector<std::vector<NodePointer>> scopes_;  // results by the directional light that applies to them
    std::vector<NodePointer> backgrounds_;          // at most one
    double visits_ = 0;
    std::size_t placed_ = 0;
    int depth_ = 0;
};

}  // namespace

Result<vrml::Graph> read_graph(std::string_view text, const std::string& file) {
    try {
        return GraphConverter(text, file).make();
    } catch (const MalformedVrml& malformed) {
        return Error{malformed.message};
    }
}

}  // namespace rs::compositor::vrml1
