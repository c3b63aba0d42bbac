#pragma once
// Traversal state of VRML 1.0, and the VRML97 nodes of a shape in that state. Private to the VRML 1.0 reader; not
// thread-safe.

#include "compositor/scene/vrml/graph_builder.hpp"
#include "compositor/scene/vrml1/tree.hpp"

#include <glm/glm.hpp>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace rs::compositor::vrml1 {

/// Last node of each kind in the traversal; null if none.
struct State {
    glm::dmat4 matrix{1.0};
    TreePointer coordinates;
    TreePointer normals;
    TreePointer texture_coordinates;
    TreePointer material;
    TreePointer material_binding;
    TreePointer normal_binding;
    TreePointer hints;
    TreePointer font;
    TreePointer texture;
    TreePointer texture_transform;

    /// True if the node is one of these kinds; it is then stored.
    bool take(const TreePointer& node);
};

/// Creates a VRML97 node with its fields, counted by the builder. Fields must match the type.
vrml::NodePointer make_node(vrml::GraphBuilder& builder, const char* type, int line, vrml::Fields fields,
                            const std::string& name = {});
vrml::Value numbers(std::vector<double> values);
vrml::Value words(std::string word);
vrml::Value nodes(std::vector<vrml::NodePointer> list);

/// Creates VRML97 nodes with caching, so that shared VRML 1.0 nodes stay shared.
class ShapeBuilder {
public:
    explicit ShapeBuilder(vrml::GraphBuilder& builder) : builder_(builder) {}

    /// Shapes of a shape node in this state; empty for other nodes.
    std::vector<vrml::NodePointer> shapes_of(const TreePointer& node, const State& state);

private:
    // Use of several materials: one colour per face or corner, or only the first material.
    struct Colours {
        const char* field =
            nullptr;  // of the Material node, "diffuseColor" or "emissiveColor"; null: first material only
        std::string binding;
    };
    [[nodiscard]] static Colours colours_of(const State& state);

    vrml::NodePointer shape(const Tree& node, vrml::NodePointer appearance, vrml::NodePointer geometry);
    vrml::NodePointer appearance_of(const State& state, bool lines, std::size_t part, bool coloured);
    vrml::NodePointer material_of(const TreePointer& material, bool lines, std::size_t part, int line);
    vrml::NodePointer texture_of(const State& state);
    vrml::NodePointer texture_transform_of(const Tree& from);
    vrml::NodePointer list_node(const TreePointer& from, const char* type, const char* field, const char* from_field);

    std::vector<vrml::NodePointer> split_shapes(const TreePointer& node, const State& state);
    vrml::NodePointer faces_of(const TreePointer& node, const State& state, const Colours& colours);
    vrml::NodePointer lines_of(const TreePointer& node, const State& state, const Colours& colours);
    vrml::NodePointer points_of(const TreePointer& node, const State& state);
    vrml::NodePointer text_of(const TreePointer& node, const State& state);
    void add_colours(vrml::Fields& fields, const Tree& shape, const State& state, const Colours& colours);
    void add_normals(vrml::Fields& fields, const Tree& shape, const State& state);

    vrml::GraphBuilder& builder_;
    std::map<std::tuple<TreePointer, TreePointer, TreePointer, bool, std::size_t, bool>, vrml::NodePointer>
        appearances_;
    std::map<std::pair<TreePointer, std::string>, vrml::NodePointer> lists_;
    std::map<std::vector<TreePointer>, vrml::NodePointer> geometries_;
};

}  // namespace rs::compositor::vrml1
