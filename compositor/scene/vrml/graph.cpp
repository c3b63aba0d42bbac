#include "compositor/scene/vrml/graph.hpp"

#include "compositor/scene/vrml/field_values.hpp"
#include "compositor/scene/vrml/graph_builder.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/utf8.hpp"

#include <deque>
#include <optional>
#include <utility>

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

namespace {

constexpr std::string_view kHeader = "#VRML V2.0 utf8";

// Names defined so far. PROTO bodies have their own node names, and see the PROTOs of enclosing scopes.
struct Scope {
    struct Named {
        NodePointer node;
        bool open = true;  // still being parsed: a USE would create a cycle
    };
    const Scope* outer = nullptr;
    const Prototype* inside = nullptr;  // PROTO of this body
    std::map<std::string, Named, std::less<>> nodes;
    std::map<std::string, const Prototype*, std::less<>> prototypes;

    [[nodiscard]] const Prototype* find_prototype(std::string_view name) const {
        for (const Scope* scope = this; scope != nullptr; scope = scope->outer) {
            if (const auto found = scope->prototypes.find(name); found != scope->prototypes.end()) return found->second;
        }
        return nullptr;
    }
};

class GraphReader {
public:
    GraphReader(std::string_view text, const std::string& file) : lexer_(text, file) {}

    void check_header(std::string_view text) const {
        if (text.starts_with(kHeader) || text.starts_with("#X3D V3") || text.starts_with("#X3D V4")) return;
        if (is_utf16(text)) throw lexer_.error(1, "is UTF-16 text; save it as UTF-8");
        const std::string_view start = text.substr(0, text.find_first_of("\r\n"));
        if (start.starts_with("#VRML V1") || start.starts_with("#Inventor") || start.starts_with("#X3D")) {
            throw lexer_.error(1, "is " + quote({TokenKind::word, start, 1}) +
                                      ", not VRML97, VRML 1.0 ascii or X3D; convert it to VRML97");
        }
        throw lexer_.error(1, "does not begin with '" + std::string(kHeader) + "'; is it VRML97?");
    }

    Graph read() {
        double visits = 0;
        while (lexer_.peek().kind != TokenKind::end) {
            if (take_statement()) continue;
            NodePointer node = take_node("child");
            if (!node) continue;
            visits += node->visits;
            builder_.check_extent(visits, 0);
            roots_.push_back(std::move(node));
        }
        return {std::move(roots_), builder_.take_warnings()};
    }

private:
    // X3D statements: profile, component, meta.
    bool take_x3d_statement() {
        if (lexer_.take_word("PROFILE") || lexer_.take_word("COMPONENT")) {
            lexer_.expect(TokenKind::word, "a name");
            return true;
        }
        if (lexer_.take_word("META")) {
            lexer_.expect(TokenKind::text, "a text");
            lexer_.expect(TokenKind::text, "a text");
            return true;
        }
        if (!lexer_.take_word("UNIT")) return false;
        lexer_.expect(TokenKind::word, "a category");
        lexer_.expect(TokenKind::word, "a name");
        lexer_.expect(TokenKind::number, "a number");
        return true;
    }

    // Parses a statement that is not a node: PROTO, EXTERNPROTO, ROUTE.
    bool take_statement() {
        const int line = lexer_.peek().line;
        if (take_x3d_statement()) return true;
        if (lexer_.take_word("ROUTE")) {
            lexer_.expect(TokenKind::word, "NODE.event");
            if (!lexer_.take_word("TO")) throw lexer_.error("expected TO, not " + quote(lexer_.peek()));
            lexer_.expect(TokenKind::word, "NODE.event");
            return true;
        }
        if (lexer_.take_word("PROTO")) {
            take_prototype(line);
            return true;
        }
        if (!lexer_.take_word("EXTERNPROTO")) return false;
        const Token name = lexer_.expect(TokenKind::word, "a name");
        skip_to_close(lexer_, lexer_.expect(TokenKind::open_list, "[").line);
        skip_value(lexer_);
        if (find_node(name.text) == nullptr)
            builder_.warn(line, "EXTERNPROTO " + quote(name) + " is not fetched; left out");
        return true;
    }

    [[nodiscard]] static bool fits(const std::string& slot, const Node& node) {
        return slot.empty() || slot == node.spec->slot;
    }

    // Parses a node, DEF, USE or NULL; null if nothing is to be drawn.
    NodePointer take_node(const std::string& slot) {
        const Token first = lexer_.expect(TokenKind::word, "a node");
        if (first.text == "NULL") return nullptr;
        if (first.text == "USE") return take_use(slot);
        if (first.text != "DEF") return take_body(first, {}, slot);
        const Token name = lexer_.expect(TokenKind::word, "a name");
        return take_body(lexer_.expect(TokenKind::word, "a node"), std::string(name.text), slot);
    }

    NodePointer take_use(const std::string& slot) {
        const Token name = lexer_.expect(TokenKind::word, "a name");
        const auto found = scope_->nodes.find(name.text);
        std::string fault;
        if (found == scope_->nodes.end()) {
            fault = ": this name is not defined before";
        } else if (found->second.open) {
            fault = " is inside of that node itself";
        } else if (found->second.node && !fits(slot, *found->second.node)) {
            fault = ": is no " + slot + " node";
        } else {
            return found->second.node;
        }
        builder_.warn(name.line, "USE " + quote(name) + fault + "; left out");
        return nullptr;
    }

    NodePointer take_body(const Token& type, const std::string& name, const std::string& slot) {
        const int open_line = lexer_.expect(TokenKind::open_body, "{").line;
        if (is_behaviour(type.text)) {
            skip_to_close(lexer_, open_line);
            return nullptr;
        }
        const NestingGuard guard(lexer_, nesting_, kMaxNesting, type.line);
        std::string shown_type(type.text);
        const NodeSpec* spec = find_node(type.text);
        const Prototype* prototype = spec == nullptr ? scope_->find_prototype(type.text) : nullptr;
        const bool known = spec != nullptr || prototype != nullptr;
        if (!known) {
            builder_.warn(type.line, quote(type) + " is an unknown node; " +
                                         (slot == "child" ? "only its children are drawn" : "left out"));
            shown_type = "Group";
        }
        if (!name.empty()) scope_->nodes[name] = {};
        auto node = std::make_shared<Node>();
        node->type = shown_type;
        node->name = name;
        node->line = type.line;
        NodePointer made =
            prototype != nullptr ? take_instance(*prototype, node, open_line) : take_fields(node, open_line, known);
        if (!name.empty()) scope_->nodes[name] = {made, false};
        if (!made || fits(slot, *made)) return made;
        if (known) builder_.warn(type.line, quote(type) + " is not allowed as " + slot + "; left out");
        return nullptr;
    }

    // Name of the next field in a body; nullopt at its end.
    std::optional<Token> next_field(int open_line) {
        while (true) {
            if (lexer_.take_kind(TokenKind::close_body)) return std::nullopt;
            if (lexer_.peek().kind == TokenKind::end) throw lexer_.error(open_line, "the { is not closed; add a }");
            if (!take_statement()) return lexer_.expect(TokenKind::word, "a field or }");
        }
    }

    // Parses fields of `specs` up to the closing bracket. `ignores` selects unknown fields that give no warning.
    template <class Ignores>
    void take_given(const FieldSpecs& specs, int open_line, Node& node, Pattern& pattern, const Ignores& ignores) {
        while (const auto field = next_field(open_line)) {
            auto found = specs.find(field->text);
            // X3D uses `children` for VRML97's level and choice.
            for (const char* older : {"level", "choice"}) {
                if (found == specs.end() && field->text == "children") found = specs.find(older);
            }
            if (found == specs.end()) {
                if (!ignores(*field)) {
                    builder_.warn(field->line, node.type + " has no field " + quote(*field) + "; left out");
                }
                skip_value(lexer_);
                continue;
            }
            const int line = lexer_.peek().line;
            if (lexer_.take_word("IS")) {
                take_is(found->first, found->second, line, pattern);
            } else {
                Value value = take_value(found->second, found->first);
                Value& known = node.fields[found->first];
                // X3D's XML lists children one by one.
                if (!found->second.many || found->second.type != FieldType::kNode) known.nodes.clear();
                value.nodes.insert(value.nodes.begin(), known.nodes.begin(), known.nodes.end());
                known = std::move(value);
            }
        }
    }

    NodePointer take_fields(const std::shared_ptr<Node>& node, int open_line, bool known) {
        node->spec = find_node(node->type);
        Pattern pattern;
        take_given(node->spec->fields, open_line, *node, pattern, [&](const Token&) {
            return !known || (lexer_.peek().kind == TokenKind::word && lexer_.peek().text == "IS");
        });
        return builder_.finish_node(node, std::move(pattern));
    }

    // Instances whose arguments depend on the enclosing PROTO are created with that one's instances.
    NodePointer take_instance(const Prototype& prototype, const std::shared_ptr<Node>& node, int open_line) {
        Pattern pattern;
        take_given(prototype.fields, open_line, *node, pattern,
                   [&](const Token& field) { return prototype.events.contains(field.text); });
        if (!prototype.root) return nullptr;
        if (pattern.is.empty() && !builder_.has_patterns(*node)) return builder_.instantiate(prototype, node->fields);
        node->type = prototype.root->type;
        node->spec = prototype.root->spec;
        pattern.instance_of = &prototype;
        return builder_.finish_node(node, std::move(pattern));
    }

    Value take_value(const FieldSpec& spec, const std::string& name) {
        if (spec.type != FieldType::kNode) {
            Value value = read_value(lexer_, spec, name);
            builder_.count(value);
            return value;
        }
        Value value;
        const auto add = [&] {
            if (NodePointer node = take_node(spec.slot)) value.nodes.push_back(std::move(node));
        };
        const int line = lexer_.peek().line;
        if (!spec.many || !lexer_.take_kind(TokenKind::open_list)) {
            add();
            return value;
        }
        while (!lexer_.take_kind(TokenKind::close_list)) {
            if (take_statement()) continue;
            if (lexer_.peek().kind == TokenKind::end) {
                throw lexer_.error(line, "the list of " + name + " is not closed; add a ]");
            }
            add();
        }
        return value;
    }

    void take_is(const std::string& field, const FieldSpec& spec, int line, Pattern& pattern) {
        const Token name = lexer_.expect(TokenKind::word, "a name");
        const Prototype* prototype = scope_->inside;
        if (prototype == nullptr) return builder_.warn(line, "IS is outside of a PROTO; left out");
        if (prototype->events.contains(name.text)) return;
        const auto found = prototype->fields.find(name.text);
        if (found == prototype->fields.end()) {
            return builder_.warn(line, "the PROTO has no field " + quote(name) + "; left out");
        }
        if (!found->second.same_type(spec)) {
            return builder_.warn(line, quote(name) + " is " + field_type_name(found->second) + " but should be " +
                                           field_type_name(spec) + "; left out");
        }
        pattern.is[field] = found->first;
    }

    void take_prototype(int line) {
        const Token name = lexer_.expect(TokenKind::word, "a name");
        const NestingGuard guard(lexer_, nesting_, kMaxNesting, line);
        Prototype& made = prototypes_.emplace_back();
        Scope own{scope_, nullptr, {}, {}};
        Scope* const outer = std::exchange(scope_, &own);
        take_interface(made, lexer_.expect(TokenKind::open_list, "[").line);
        own = {outer, &made, {}, {}};
        take_prototype_body(made, lexer_.expect(TokenKind::open_body, "{").line);
        scope_ = outer;
        // Worlds may define PROTO RaySpace for browsers without the node.
        if (find_node(name.text) != nullptr) return;
        if (!scope_->prototypes.emplace(std::string(name.text), &made).second) {
            builder_.warn(line, "PROTO " + quote(name) + " is defined twice; the first one is used");
        }
    }

    void take_interface(Prototype& prototype, int open_line) {
        while (!lexer_.take_kind(TokenKind::close_list)) {
            if (lexer_.peek().kind == TokenKind::end) throw lexer_.error(open_line, "the [ is not closed; add a ]");
            const Token kind = lexer_.expect(TokenKind::word, "field, exposedField, eventIn or eventOut");
            const bool is_event = kind.text == "eventIn" || kind.text == "eventOut" || kind.text == "inputOnly" ||
                                  kind.text == "outputOnly";
            if (!is_event && kind.text != "field" && kind.text != "exposedField" && kind.text != "initializeOnly" &&
                kind.text != "inputOutput") {
                throw lexer_.error(kind.line, "expected field, exposedField, eventIn or eventOut, not " + quote(kind));
            }
            const Token type = lexer_.expect(TokenKind::word, "a type");
            const Token name = lexer_.expect(TokenKind::word, "a name");
            FieldSpec spec;
            if (!parse_field_type(type.text, spec))
                throw lexer_.error(type.line, quote(type) + " is not a field type; correct it");
            if (is_event) {
                prototype.events.emplace(name.text);
                continue;
            }
            spec.initial = take_value(spec, std::string(name.text));
            if (!prototype.fields.emplace(std::string(name.text), std::move(spec)).second) {
                throw lexer_.error(name.line, "the PROTO has two fields " + quote(name) + "; rename one");
            }
        }
    }

    void take_prototype_body(Prototype& prototype, int open_line) {
        bool is_first = true;
        while (!lexer_.take_kind(TokenKind::close_body)) {
            if (lexer_.peek().kind == TokenKind::end) throw lexer_.error(open_line, "the { is not closed; add a }");
            if (take_statement()) continue;
            const NodePointer node = take_node("");
            if (std::exchange(is_first, false)) prototype.root = node;
        }
    }

    Lexer lexer_;
    GraphBuilder builder_{lexer_};
    std::vector<NodePointer> roots_;
    Scope top_;
    Scope* scope_ = &top_;
    std::deque<Prototype> prototypes_;
    int nesting_ = 0;
};

}  // namespace

Result<Graph> read_graph(std::string_view text, const std::string& file) {
    try {
        GraphReader reader(text, file);
        reader.check_header(text);
        return reader.read();
    } catch (const MalformedVrml& malformed) {
        return Error{malformed.message};
    }
}

Result<Graph> read_headless_graph(std::string_view text, const std::string& file) {
    try {
        return GraphReader(text, file).read();
    } catch (const MalformedVrml& malformed) {
        return Error{malformed.message};
    }
}

}  // namespace rs::compositor::vrml
