#include "compositor/scene/vrml/clean_vrml.hpp"

#include "compositor/scene/vrml/field_values.hpp"
#include "compositor/scene/vrml/name_scope.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace rs::compositor::vrml {
namespace {

constexpr std::string_view kHeader = "#VRML V2.0 utf8";

class Cleaner {
public:
    Cleaner(std::string_view text, const std::string& file) : lexer_(text, file) {
        if (text.substr(0, kHeader.size()) == kHeader) return;
        const std::string_view start = text.substr(0, text.find_first_of("\r\n"));
        if (start.starts_with("#VRML V1") || start.starts_with("#Inventor") || start.starts_with("#X3D")) {
            throw lexer_.wrong(1, "is " + shown({TokenKind::word, start, 1}) + ", not VRML97; convert it to VRML97");
        }
        throw lexer_.wrong(1, "does not begin with '" + std::string(kHeader) + "'; is it VRML97?");
    }

    CleanVrml clean() {
        Extent whole;
        while (lexer_.peek().kind != TokenKind::end) {
            if (take_statement()) continue;
            const bool written = add_node("child", whole);
            check(whole);
            if (written) result_.text += '\n';
        }
        result_.text = std::string(kHeader) + "\n" + prototype_text_ + result_.text;
        if (more_warnings_ > 0) {
            result_.warnings.push_back(lexer_.file() + ": and " + std::to_string(more_warnings_) + " more warnings");
        }
        return std::move(result_);
    }

private:
    void warn(int line, const std::string& what) {
        if (result_.warnings.size() >= kMaxWarnings) {
            ++more_warnings_;
            return;
        }
        result_.warnings.push_back(lexer_.wrong(line, what).message);
    }

    void check(const Extent& extent) const {
        if (extent.height > kMaxHeight) {
            throw lexer_.wrong("the nodes stand more than " + std::to_string(kMaxHeight) +
                               " deep, PROTO and USE followed; flatten them");
        }
        if (extent.visits > kMaxVisits || extent.values > kMaxValues) {
            throw lexer_.wrong("PROTO and USE unfold to too much to be shown; use them less");
        }
    }

    // Takes a statement that is no node: PROTO, EXTERNPROTO, ROUTE.
    bool take_statement() {
        const int line = lexer_.peek().line;
        if (lexer_.take_word("ROUTE")) {
            lexer_.expect(TokenKind::word, "NODE.event");
            if (!lexer_.take_word("TO")) throw lexer_.wrong("TO should stand here, not " + shown(lexer_.peek()));
            lexer_.expect(TokenKind::word, "NODE.event");
            return true;
        }
        if (lexer_.take_word("PROTO")) {
            copy_prototype(line);
            return true;
        }
        if (!lexer_.take_word("EXTERNPROTO")) return false;
        const Token name = lexer_.expect(TokenKind::word, "a name");
        skip_to_close(lexer_, lexer_.expect(TokenKind::open_list, "[").line);
        skip_value(lexer_);
        if (find_node(name.text) == nullptr) warn(line, "EXTERNPROTO " + shown(name) + " is not fetched; left out");
        return true;
    }

    struct Copied {
        Extent extent;
        std::string slot;
    };

    // A node, DEF, USE or NULL. Nothing where nothing was written, which the caller may have to make up for.
    std::optional<Copied> copy_node(const std::string& slot) {
        const Token first = lexer_.expect(TokenKind::word, "a node");
        if (first.text == "NULL") return std::nullopt;
        if (first.text == "USE") return copy_use(slot);
        if (first.text != "DEF") return copy_body(first, {}, slot);
        const Token name = lexer_.expect(TokenKind::word, "a name");
        return copy_body(lexer_.expect(TokenKind::word, "a node"), std::string(name.text), slot);
    }

    [[nodiscard]] static bool fits(const std::string& slot, const std::string& node_slot) {
        return slot.empty() || slot == node_slot;
    }

    bool add_node(const std::string& slot, Extent& parent) {
        const auto child = copy_node(slot);
        if (child) parent.add_child(child->extent);
        return child.has_value();
    }

    std::optional<Copied> copy_use(const std::string& slot) {
        const Token name = lexer_.expect(TokenKind::word, "a name");
        const auto found = scope_->nodes.find(name.text);
        if (found == scope_->nodes.end()) {
            warn(name.line, "USE " + shown(name) + ": no node of this name was shown before; left out");
            return std::nullopt;
        }
        const NamedNode& node = found->second;
        if (node.open) {
            warn(name.line, "USE " + shown(name) + " stands inside of that node itself; left out");
            return std::nullopt;
        }
        if (!fits(slot, node.slot)) {
            warn(name.line, "USE " + shown(name) + ": is no " + slot + " node; left out");
            return std::nullopt;
        }
        result_.text += " USE n" + std::to_string(node.index);
        // What is used is shared, not copied.
        return Copied{{node.extent.height, node.extent.visits, 0}, node.slot};
    }

    std::optional<Copied> copy_body(const Token& type, const std::string& name, const std::string& slot) {
        const int opened = lexer_.expect(TokenKind::open_body, "{").line;
        if (is_behaviour(type.text)) {
            skip_to_close(lexer_, opened);
            return std::nullopt;
        }
        const NodeSpec* spec = find_node(type.text);
        const Prototype* prototype = spec == nullptr ? scope_->find_prototype(type.text) : nullptr;
        const bool known = spec != nullptr || prototype != nullptr;
        if (!known) {
            warn(type.line,
                 shown(type) + " is no known node; " + (slot == "child" ? "only its children are shown" : "left out"));
            spec = find_node("Group");
        }
        const std::string& node_slot = prototype != nullptr ? prototype->slot : spec->slot;
        const std::size_t begin = result_.text.size();
        const std::size_t first_name = result_.nodes.size();
        if (!name.empty() || (spec != nullptr && spec->named)) {
            result_.text += " DEF n" + std::to_string(result_.nodes.size());
            if (!name.empty()) scope_->nodes[name] = {result_.nodes.size(), node_slot, {}, true};
            result_.nodes.push_back({name, type.line});
        }
        result_.text += ' ' + (prototype != nullptr ? prototype->coin_name : spec->coin_name) + " {";
        if (++nesting_ > kMaxNesting) {
            throw lexer_.wrong(type.line,
                               "nodes nest more than " + std::to_string(kMaxNesting) + " deep; flatten them");
        }
        const Extent extent =
            prototype != nullptr ? copy_instance(*prototype, type, opened) : copy_fields(*spec, type, opened, known);
        --nesting_;
        result_.text += " }";
        check(extent);
        if (!name.empty()) {
            NamedNode& entry = scope_->nodes[name];
            entry.extent = extent;
            entry.open = false;
        }
        if (fits(slot, node_slot)) return Copied{extent, node_slot};
        if (known) warn(type.line, shown(type) + " cannot stand as " + slot + "; left out");
        result_.text.resize(begin);
        std::erase_if(scope_->nodes, [&](const auto& entry) { return entry.second.index >= first_name; });
        return std::nullopt;
    }

    // The name of the next field in a body, or of none at its end.
    std::optional<Token> next_field(int opened) {
        while (true) {
            if (lexer_.take_kind(TokenKind::close_body)) return std::nullopt;
            if (lexer_.peek().kind == TokenKind::end) throw lexer_.wrong(opened, "the { is not closed; add a }");
            if (!take_statement()) return lexer_.expect(TokenKind::word, "a field or }");
        }
    }

    Extent copy_fields(const NodeSpec& spec, const Token& type, int opened, bool known) {
        Extent extent{0, 1, 0};
        // VRML97's default, which Coin does not keep.
        if (spec.coin_name == "Viewpoint") result_.text += " position 0 0 10";
        while (const auto field = next_field(opened)) {
            const auto found = spec.fields.find(field->text);
            if (found == spec.fields.end()) {
                const bool is_event = lexer_.peek().kind == TokenKind::word && lexer_.peek().text == "IS";
                if (known && !is_event) {
                    warn(field->line, std::string(type.text) + " has no field " + shown(*field) + "; left out");
                }
                skip_value(lexer_);
                continue;
            }
            copy_field(found->first, found->first, found->second, extent);
        }
        return extent;
    }

    Extent copy_instance(const Prototype& prototype, const Token& type, int opened) {
        Extent arguments;
        while (const auto field = next_field(opened)) {
            const auto found = prototype.fields.find(field->text);
            if (found == prototype.fields.end()) {
                if (!prototype.events.contains(field->text)) {
                    warn(field->line, std::string(type.text) + " has no field " + shown(*field) + "; left out");
                }
                skip_value(lexer_);
                continue;
            }
            copy_field(found->second.coin_name, found->first, found->second.spec, arguments);
        }
        if (scope_->inside != nullptr) scope_->inside->node_uses += prototype.node_uses;
        Extent extent = prototype.body;
        extent.height += arguments.height + 1;
        extent.visits += arguments.visits * std::max(prototype.node_uses, 1.0);
        extent.values += arguments.values;
        return extent;
    }

    void copy_field(const std::string& coin_name, const std::string& name, const FieldSpec& spec, Extent& extent) {
        std::string& out = result_.text;
        const std::size_t begin = out.size();
        out += ' ' + coin_name;
        const int line = lexer_.peek().line;
        if (lexer_.take_word("IS")) {
            if (!copy_is(spec, line)) out.resize(begin);
            return;
        }
        if (spec.type != FieldType::kNode) {
            extent.values += static_cast<double>(copy_value(lexer_, spec, name, out));
            return;
        }
        if (!spec.many) {
            if (!add_node(spec.slot, extent)) out += " NULL";
            return;
        }
        out += " [";
        if (lexer_.take_kind(TokenKind::open_list)) {
            while (!lexer_.take_kind(TokenKind::close_list)) {
                if (take_statement()) continue;
                if (lexer_.peek().kind == TokenKind::end) {
                    throw lexer_.wrong(line, "the list of " + name + " is not closed; add a ]");
                }
                add_node(spec.slot, extent);
            }
        } else {
            add_node(spec.slot, extent);
        }
        out += " ]";
    }

    // False where nothing is to be written.
    bool copy_is(const FieldSpec& spec, int line) {
        const Token name = lexer_.expect(TokenKind::word, "a name");
        Prototype* prototype = scope_->inside;
        if (prototype == nullptr) {
            warn(line, "IS stands outside of a PROTO; left out");
            return false;
        }
        if (prototype->events.contains(name.text)) return false;
        const auto found = prototype->fields.find(name.text);
        if (found == prototype->fields.end()) {
            warn(line, "the PROTO has no field " + shown(name) + "; left out");
            return false;
        }
        if (!(found->second.spec == spec)) {
            warn(line, shown(name) + " is " + field_type_name(found->second.spec) + " but should be " +
                           field_type_name(spec) + "; left out");
            return false;
        }
        if (spec.type == FieldType::kNode) prototype->node_uses += 1;
        result_.text += " IS " + found->second.coin_name;
        return true;
    }

    void copy_prototype(int line) {
        const Token name = lexer_.expect(TokenKind::word, "a name");
        Prototype made;
        made.coin_name = "p" + std::to_string(prototypes_++);
        if (++nesting_ > kMaxNesting) throw lexer_.wrong(line, "PROTOs nest too deep; flatten them");
        // All of them go before the nodes, the inner ones first: Coin does not take them in the midst of a node.
        std::string around = std::exchange(result_.text, "PROTO " + made.coin_name + " [");
        copy_interface(made, lexer_.expect(TokenKind::open_list, "[").line);
        result_.text += " ] {";
        copy_prototype_body(made, lexer_.expect(TokenKind::open_body, "{").line);
        const std::string text = std::exchange(result_.text, std::move(around)) + " }\n";
        --nesting_;
        // Worlds may bring PROTO RaySpace for browsers that do not know the node.
        if (find_node(name.text) != nullptr) return;
        prototype_text_ += text;
        if (!scope_->prototypes.emplace(std::string(name.text), std::move(made)).second) {
            warn(line, "PROTO " + shown(name) + " is there already; the first one counts");
        }
    }

    void copy_interface(Prototype& prototype, int opened) {
        while (!lexer_.take_kind(TokenKind::close_list)) {
            if (lexer_.peek().kind == TokenKind::end) throw lexer_.wrong(opened, "the [ is not closed; add a ]");
            const Token kind = lexer_.expect(TokenKind::word, "field, exposedField, eventIn or eventOut");
            const bool is_event = kind.text == "eventIn" || kind.text == "eventOut";
            if (!is_event && kind.text != "field" && kind.text != "exposedField") {
                throw lexer_.wrong(kind.line,
                                   "field, exposedField, eventIn or eventOut should stand here, not " + shown(kind));
            }
            const Token type = lexer_.expect(TokenKind::word, "a type");
            const Token name = lexer_.expect(TokenKind::word, "a name");
            FieldSpec spec;
            if (!parse_field_type(type.text, spec)) throw lexer_.wrong(type.line, shown(type) + " is no type");
            if (is_event) {
                prototype.events[std::string(name.text)] = spec;
                continue;
            }
            const std::string coin_name = "f" + std::to_string(prototype.fields.size());
            if (!prototype.fields.emplace(std::string(name.text), Prototype::Field{coin_name, spec}).second) {
                throw lexer_.wrong(name.line, "the PROTO has two fields " + shown(name) + "; rename one");
            }
            result_.text += " field " + field_type_name(spec);
            NameScope own{scope_, nullptr, {}, {}};
            scope_ = &own;
            copy_field(coin_name, std::string(name.text), spec, prototype.body);
            scope_ = own.outer;
        }
    }

    // Only the first node of a body is drawn.
    void copy_prototype_body(Prototype& prototype, int opened) {
        NameScope own{scope_, &prototype, {}, {}};
        scope_ = &own;
        std::string& out = result_.text;
        prototype.slot = "";
        while (!lexer_.take_kind(TokenKind::close_body)) {
            if (lexer_.peek().kind == TokenKind::end) throw lexer_.wrong(opened, "the { is not closed; add a }");
            if (take_statement()) continue;
            const std::size_t begin = out.size();
            const auto copied = copy_node("");
            if (prototype.slot.empty()) {
                // Nothing is to be seen of a script or sensor that stands first.
                prototype.slot = copied ? copied->slot : "child";
                prototype.body.add_child(copied ? copied->extent : Extent{1, 1, 0});
                if (!copied) out += " Group { }";
            } else {
                out.resize(begin);
            }
        }
        if (prototype.slot.empty()) {
            prototype.slot = "child";
            out += " Group { }";
        }
        prototype.body.visits += 2;
        scope_ = own.outer;
    }

    Lexer lexer_;
    CleanVrml result_;
    std::string prototype_text_;
    NameScope top_;
    NameScope* scope_ = &top_;
    int nesting_ = 0;
    int prototypes_ = 0;
    int more_warnings_ = 0;
};

}  // namespace

Result<CleanVrml> clean_vrml(std::string_view text, const std::string& file) {
    try {
        return Cleaner(text, file).clean();
    } catch (const MalformedVrml& malformed) {
        return Error{malformed.message};
    }
}

}  // namespace rs::compositor::vrml
