#pragma once
// Elements of X3D as they open and close -> the classic encoding. Private to the reader of X3D.

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
    // In the order of the text, with its lines; each open() has its close().
    void open(std::string_view name, const Attributes& attributes, int line);
    void close(int line);

    [[nodiscard]] bool has_root() const { return has_root_; }  // an X3D element was there
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    enum class Place {
        kIgnored,  // with all that is in it
        kRoot,
        kStatements,  // nodes stand one behind the other: a Scene, or the body of a PROTO
        kNode,
        kInstance,
        kProto,
        kInterface,
        kConnections,  // IS
        kValue,        // a field that holds nodes
    };
    struct Frame {
        Place place = Place::kIgnored;
        const vrml::NodeSpec* spec = nullptr;  // of a node; null where it is not known
        const std::map<std::string, vrml::FieldSpec, std::less<>>* interface = nullptr;  // of a PROTO, or its instance
        std::string closing = {};    // what is written where it ends
        std::string proto = {};      // of a PROTO: its name
        bool has_interface = false;  // of a PROTO
        bool has_body = false;
        bool is_empty = true;  // of a value
    };

    Frame opened(std::string_view name, const Attributes& attributes);
    Frame opened_in_proto(std::string_view name);
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
    std::map<std::string, std::map<std::string, vrml::FieldSpec, std::less<>>, std::less<>> interfaces_;  // by PROTO
    bool has_root_ = false;
};

}  // namespace rs::compositor::x3d
