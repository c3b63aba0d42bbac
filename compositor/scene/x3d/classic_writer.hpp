#pragma once
// Writes X3D elements in the classic encoding as they open and close. Private to the X3D reader.

#include "compositor/scene/vrml/node_table.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rs::compositor::x3d {

using Attributes = std::vector<std::pair<std::string_view, std::string_view>>;

class ClassicWriter {
public:
    /// Call in the order of the text, with its lines; each open() needs its close().
    void open(std::string_view name, const Attributes& attributes, int line);
    void close(int line);

    [[nodiscard]] bool has_root() const { return has_root_; }  // an X3D element was found
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    enum class Context {
        kIgnored,  // with its content
        kRoot,
        kStatements,  // sequence of nodes: a Scene, or the body of a PROTO
        kNode,
        kInstance,
        kProto,
        kInterface,
        kConnections,  // IS
        kValue,        // field that contains nodes
    };
    struct Frame {
        Context context = Context::kIgnored;
        const vrml::NodeSpec* spec = nullptr;  // of a node; null if unknown
        const std::map<std::string, vrml::FieldSpec, std::less<>>* interface =
            nullptr;                 // of a PROTO, or of the instance's
        std::string closing = {};    // text written at the end
        std::string proto = {};      // name of a PROTO
        bool has_interface = false;  // PROTO has an interface
        bool has_body = false;
        bool is_empty = true;  // value without content
    };

    Frame open_element(std::string_view name, const Attributes& attributes);
    Frame open_element_of_proto(std::string_view name);
    Frame open_proto(const Attributes& attributes);
    Frame open_field(const Attributes& attributes);
    Frame open_field_value(const Attributes& attributes);
    Frame open_node(std::string_view name, const Attributes& attributes);
    Frame open_value(const vrml::FieldSpec& spec, std::optional<std::string_view> value);
    void write_attributes(const vrml::NodeSpec& spec, const Attributes& attributes);
    void write_value(const vrml::FieldSpec& spec, std::string_view value);
    void begin_child(std::string_view type, const Attributes& attributes);
    void write(std::string_view text);
    void move_to(int line);

    std::string text_;
    int line_ = 1;
    std::vector<Frame> frames_;
    std::map<std::string, std::map<std::string, vrml::FieldSpec, std::less<>>, std::less<>>
        interfaces_;  // [PROTO name]
    bool has_root_ = false;
};

}  // namespace rs::compositor::x3d
