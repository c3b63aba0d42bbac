#include "compositor/scene/x3d/classic_writer.hpp"

#include <algorithm>
#include <set>

namespace rs::compositor::x3d {

using vrml::FieldSpec;
using vrml::FieldType;
using vrml::NodeSpec;

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

std::string_view attribute(const Attributes& attributes, std::string_view name) {
    for (const auto& [key, value] : attributes) {
        if (key == name) return value;
    }
    return {};
}

bool is_reserved(std::string_view word) {
    static const std::set<std::string, std::less<>> kWords = {
        "DEF",     "EXTERNPROTO", "EXPORT", "FALSE",     "IMPORT", "IS",   "META", "NULL",
        "PROFILE", "PROTO",       "ROUTE",  "COMPONENT", "TO",     "TRUE", "UNIT", "USE"};
    return kWords.contains(word);
}

// Name that is valid in the classic encoding; equal names give equal results.
std::string word_of(std::string_view name) {
    std::string word;
    for (const char c : name)
        word += is_space(c) || std::string_view("#\"[]{}").find(c) != std::string_view::npos ? '_' : c;
    const bool looks_like_number =
        !word.empty() && std::string_view("+-.0123456789").find(word[0]) != std::string_view::npos;
    return looks_like_number || is_reserved(word) ? "_" + word : word;
}

std::string in_quotes(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

// Quoted strings of an attribute, or one string without quotes, which is common.
std::string list_of_texts(std::string_view text) {
    std::size_t at = 0;
    const auto skip_space = [&] {
        while (at < text.size() && is_space(text[at])) ++at;
    };
    skip_space();
    if (at == text.size()) return "[ ]";
    if (text[at] != '"') return in_quotes(text);
    std::string list = "[";
    while (at < text.size() && text[at] == '"') {
        std::string one;
        for (++at; at < text.size() && text[at] != '"'; ++at) {
            if (text[at] == '\\' && at + 1 < text.size()) ++at;
            one += text[at];
        }
        if (at < text.size()) ++at;
        list += " " + in_quotes(one);
        skip_space();
    }
    return list + " ]";
}

bool is_numeric(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        return is_space(c) || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F') || c == 'x' ||
               c == 'X' || c == '+' || c == '-' || c == '.';
    });
}

// Attributes without effect on an image of a static world.
bool is_ignored_attribute(std::string_view name) {
    static const std::set<std::string, std::less<>> kNames = {
        "DEF",     "USE",     "bboxDisplay", "centerOfRotation",    "class", "containerField", "description",
        "enabled", "id",      "metadata",    "retainUserOffsets",   "style", "transitionType", "transitionTime",
        "viewAll", "visible", "autoRefresh", "autoRefreshTimeLimit"};
    return kNames.contains(name) || name.find(':') != std::string_view::npos;
}

// Field of a node that takes nodes of this group, if the file names none. Nodes that it does not take are named by
// their type, for the reader's warning.
std::string_view field_for(const NodeSpec& parent, std::string_view slot, std::string_view type) {
    bool has_children = false;
    for (const auto& [name, field] : parent.fields) {
        if (field.type != FieldType::kNode) continue;
        const bool is_secondary = name == "proxy" || name == "backMaterial" || name == "ambientTexture";
        if (field.slot == slot && !is_secondary) return name;
        has_children = has_children || name == "children" || name == "level" || name == "choice";
    }
    return has_children ? "children" : type;
}

std::ptrdiff_t number_count(std::string_view text) {
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
        count += !is_space(text[i]) && (i == 0 || is_space(text[i - 1])) ? 1 : 0;
    return count;
}

}  // namespace

void ClassicWriter::write(std::string_view text) {
    line_ += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    text_ += text;
    text_ += ' ';
}

void ClassicWriter::move_to(int line) {
    for (; line_ < line; ++line_) text_ += '\n';
}

void ClassicWriter::write_value(const FieldSpec& spec, std::string_view value) {
    if (spec.type == FieldType::kString) return write(spec.many ? list_of_texts(value) : in_quotes(value));
    if (spec.type == FieldType::kBool) {
        if (value == "true" || value == "TRUE") return write("TRUE");
        if (value == "false" || value == "FALSE") return write("FALSE");
    }
    // The reader reports the error with the whole value.
    const std::ptrdiff_t each = vrml::numbers_in(spec.type), count = number_count(value);
    const bool has_right_count = spec.type == FieldType::kImage || (spec.many ? count % each == 0 : count == each);
    if (!is_numeric(value) || !has_right_count) return write(in_quotes(value));
    write(spec.many ? "[ " + std::string(value) + " ]" : std::string(value));
}

void ClassicWriter::write_attributes(const NodeSpec& spec, const Attributes& attributes) {
    for (const auto& [name, value] : attributes) {
        const auto known = spec.fields.find(name);
        if (known != spec.fields.end() && known->second.type != FieldType::kNode) {
            write(name);
            write_value(known->second, value);
        } else if (known == spec.fields.end() && !is_ignored_attribute(name) && !is_reserved(name)) {
            write(std::string(name) + " 0");  // the reader reports the unknown field
        }
    }
}

// Writes the field of the parent node that takes this node.
void ClassicWriter::begin_child(std::string_view type, const Attributes& attributes) {
    Frame& around = frames_.back();
    around.is_empty = false;
    if (around.context != Context::kNode) return;
    const std::string_view requested = attribute(attributes, "containerField");
    const NodeSpec* own = vrml::find_node(type);
    if (around.spec == nullptr) return write("children");
    const auto named = around.spec->fields.find(requested);
    if (named != around.spec->fields.end() && named->second.type == FieldType::kNode) return write(requested);
    if (own != nullptr || requested.empty())
        return write(field_for(*around.spec, own != nullptr ? own->slot : "child", type));
    const std::string field = word_of(requested);
    write(field.empty() || field == "children" ? field_for(*around.spec, "child", type) : std::string_view(field));
}

ClassicWriter::Frame ClassicWriter::open_node(std::string_view name, const Attributes& attributes) {
    const bool is_instance = name == "ProtoInstance";
    const std::string type = is_instance ? word_of(attribute(attributes, "name")) : std::string(name);
    if (type.empty() || is_reserved(type) || vrml::is_behaviour(type)) return {};
    begin_child(type, attributes);
    if (const std::string use = word_of(attribute(attributes, "USE")); !use.empty()) {
        write("USE " + use);
        return {};
    }
    if (const std::string def = word_of(attribute(attributes, "DEF")); !def.empty()) write("DEF " + def);
    write(type + " {");
    Frame frame{.context = is_instance ? Context::kInstance : Context::kNode, .closing = "}"};
    if (is_instance) {
        if (const auto known = interfaces_.find(type); known != interfaces_.end()) frame.interface = &known->second;
    } else if (frame.spec = vrml::find_node(type); frame.spec != nullptr) {
        write_attributes(*frame.spec, attributes);
    }
    return frame;
}

ClassicWriter::Frame ClassicWriter::open_proto(const Attributes& attributes) {
    const std::string name = word_of(attribute(attributes, "name"));
    if (name.empty()) return {};
    write("PROTO " + name + " [");
    interfaces_[name] = {};
    return {.context = Context::kProto, .proto = name};
}

// Value given by an attribute, or by nodes inside.
ClassicWriter::Frame ClassicWriter::open_value(const FieldSpec& spec, std::optional<std::string_view> value) {
    if (spec.type == FieldType::kNode) {
        if (spec.many) write("[");
        return {.context = Context::kValue, .closing = spec.many ? "]" : ""};
    }
    if (value) {
        write_value(spec, *value);
        return {};
    }
    if (spec.many) {
        write("[ ]");
        return {};
    }
    switch (spec.type) {
        case FieldType::kBool:
            write("FALSE");
            break;
        case FieldType::kString:
            write("\"\"");
            break;
        case FieldType::kVec2f:
            write("0 0");
            break;
        case FieldType::kVec3f:
        case FieldType::kColor:
        case FieldType::kImage:
            write("0 0 0");
            break;
        case FieldType::kRotation:
            write("0 0 1 0");
            break;
        default:
            write("0");
    }
    return {};
}

ClassicWriter::Frame ClassicWriter::open_field(const Attributes& attributes) {
    const std::string name = word_of(attribute(attributes, "name"));
    const std::string_view type = attribute(attributes, "type");
    const std::string_view access = attribute(attributes, "accessType");
    FieldSpec spec;
    if (name.empty() || !vrml::parse_field_type(type, spec)) return {};
    if (access == "inputOnly" || access == "outputOnly") {
        write((access == "inputOnly" ? "eventIn " : "eventOut ") + std::string(type) + " " + name);
        return {};
    }
    auto& interface = interfaces_[frames_.back().proto];
    if (!interface.emplace(name, spec).second) return {};
    write("field " + std::string(type) + " " + name);
    const bool given =
        std::any_of(attributes.begin(), attributes.end(), [](const auto& a) { return a.first == "value"; });
    return open_value(spec, given ? std::optional(attribute(attributes, "value")) : std::nullopt);
}

ClassicWriter::Frame ClassicWriter::open_field_value(const Attributes& attributes) {
    const std::string name = word_of(attribute(attributes, "name"));
    const auto* interface = frames_.back().interface;
    if (name.empty() || interface == nullptr) return {};
    const auto known = interface->find(name);
    write(name);
    if (known == interface->end()) {
        write("0");  // the reader reports the unknown field
        return {};
    }
    return open_value(known->second, attribute(attributes, "value"));
}

ClassicWriter::Frame ClassicWriter::open_element_of_proto(std::string_view name) {
    Frame& proto = frames_.back();
    if (name == "ProtoInterface" && !proto.has_interface && !proto.has_body) {
        proto.has_interface = true;
        return {.context = Context::kInterface, .proto = proto.proto};
    }
    if (name != "ProtoBody" || proto.has_body) return {};
    proto.has_body = true;
    write("] {");
    return {.context = Context::kStatements};
}

ClassicWriter::Frame ClassicWriter::open_element(std::string_view name, const Attributes& attributes) {
    if (frames_.empty()) {
        has_root_ = name == "X3D";
        return {.context = has_root_ ? Context::kRoot : Context::kIgnored};
    }
    const Context context = frames_.back().context;
    if (context == Context::kIgnored) return {};
    if (context == Context::kRoot) return {.context = name == "Scene" ? Context::kStatements : Context::kIgnored};
    if (context == Context::kProto) return open_element_of_proto(name);
    if (context == Context::kInterface) return name == "field" ? open_field(attributes) : Frame{};
    if (context == Context::kInstance) return name == "fieldValue" ? open_field_value(attributes) : Frame{};
    if (context == Context::kConnections) {
        const std::string from = word_of(attribute(attributes, "nodeField"));
        const std::string to = word_of(attribute(attributes, "protoField"));
        if (name == "connect" && !from.empty() && !to.empty()) write(from + " IS " + to);
        return {};
    }
    if (name == "IS") return {.context = context == Context::kNode ? Context::kConnections : Context::kIgnored};
    if (name == "ROUTE" || name == "field" || name == "fieldValue" || name == "connect" || name == "Scene") return {};
    if (name == "ProtoDeclare") return context == Context::kValue ? Frame{} : open_proto(attributes);
    if (name == "ExternProtoDeclare") {
        const std::string proto = word_of(attribute(attributes, "name"));
        if (!proto.empty() && context != Context::kValue) write("EXTERNPROTO " + proto + " [ ] [ ]");
        return {};
    }
    return open_node(name, attributes);
}

void ClassicWriter::open(std::string_view name, const Attributes& attributes, int line) {
    move_to(line);
    frames_.push_back(open_element(name, attributes));
}

void ClassicWriter::close(int line) {
    move_to(line);
    const Frame frame = std::move(frames_.back());
    frames_.pop_back();
    if (frame.context == Context::kProto) {
        write(frame.has_body ? "}" : "] { }");
    } else if (frame.context == Context::kValue && frame.closing.empty() && frame.is_empty) {
        write("NULL");
    } else if (!frame.closing.empty()) {
        write(frame.closing);
    }
}

}  // namespace rs::compositor::x3d
