#pragma once
// The traversal state of VRML 1.0, and the nodes of VRML97 that a shape in it becomes. Private to the reader of VRML
// 1.0; not thread-safe.

#include "compositor/scene/vrml/graph_builder.hpp"
#include "compositor/scene/vrml1/tree.hpp"

#include <glm/glm.hpp>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace rs::compositor::vrml1 {

// The last node of each sort that was met; null where none was.
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

    // True where the node is one of those that are kept here, and has been taken.
    bool take(const TreePointer& node);
};

// A node of VRML97 with its fields, counted by the builder. Fields must be those of its type.
vrml::NodePointer made_node(vrml::GraphBuilder& builder, const char* type, int line, vrml::Fields fields,
                            const std::string& name = {});
vrml::Value numbers(std::vector<double> values);
vrml::Value words(std::string word);
vrml::Value nodes(std::vector<vrml::NodePointer> list);

// Makes each node of VRML97 once for what it is made of: shapes that are used again are the same there, too.
class ShapeMaker {
public:
    explicit ShapeMaker(vrml::GraphBuilder& builder) : builder_(builder) {}

    // The Shapes that a shape's node draws in this state; none for other nodes.
    std::vector<vrml::NodePointer> shapes_of(const TreePointer& node, const State& state);

private:
    // What of several materials is used: for each face or corner one colour, or only the first material.
    struct Colours {
        const char* field = nullptr;  // of the Material node, "diffuseColor" or "emissiveColor"; null: the first counts
        std::string binding;
    };
    [[nodiscard]] static Colours colours_of(const State& state);

    vrml::NodePointer shape(const Tree& node, vrml::NodePointer appearance, vrml::NodePointer geometry);
    vrml::NodePointer appearance_of(const State& state, bool lines, std::size_t part, bool coloured);
    vrml::NodePointer material_of(const TreePointer& material, bool lines, std::size_t part, int line);
    vrml::NodePointer texture_of(const State& state);
    vrml::NodePointer texture_transform_of(const Tree& from);
    vrml::NodePointer list_node(const TreePointer& from, const char* type, const char* field, const char* from_field);

    std::vector<vrml::NodePointer> parted_shapes(const TreePointer& node, const State& state);
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
