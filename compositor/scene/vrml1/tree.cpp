#include "compositor/scene/vrml1/tree.hpp"

#include "compositor/scene/vrml/field_values.hpp"
#include "compositor/scene/vrml/graph_builder.hpp"
#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <utility>

namespace rs::compositor::vrml1 {

using vrml::MalformedVrml;
using vrml::quote;
using vrml::Token;
using vrml::TokenKind;

namespace {

constexpr std::size_t kMaxString_bytes = 1 << 16;

bool is_name(const Token& token) {
    return token.kind == TokenKind::word || token.kind == TokenKind::number;
}

class ValueReader {
public:
    ValueReader(Lexer& lexer, const Field& field, const std::string& name)
        : lexer_(lexer), field_(field), name_(name) {}

    Value read() {
        const int line = lexer_.peek().line;
        if (!field_.many || !lexer_.take_kind(TokenKind::open_list)) {
            read_single();
            return std::move(value_);
        }
        while (!lexer_.take_kind(TokenKind::close_list)) {
            if (lexer_.peek().kind == TokenKind::end) {
                throw lexer_.error(line, "the list of " + name_ + " is not closed; add a ]");
            }
            read_single();
        }
        return std::move(value_);
    }

private:
    [[nodiscard]] MalformedVrml type_error(const char* what) const {
        return lexer_.error(name_ + " takes " + what + ", not " + quote(lexer_.peek()) + "; correct it");
    }

    void read_single() {
        switch (field_.kind) {
            case FieldKind::kBool:
                return read_bool();
            case FieldKind::kText:
                return read_text();
            case FieldKind::kWords:
                return read_words();
            case FieldKind::kImage:
                value_.numbers = vrml::read_image(lexer_, name_, [&] { return take_integer(); });
                return;
            case FieldKind::kInteger:
                value_.numbers.push_back(static_cast<double>(take_integer()));
                return;
            case FieldKind::kNumbers:
                for (std::size_t i = 0; i < field_.each; ++i) read_number();
        }
    }

    void read_bool() {
        const std::string_view text = lexer_.peek().text;
        const bool yes = text == "TRUE" || text == "1";
        if (!is_name(lexer_.peek()) || (!yes && text != "FALSE" && text != "0")) throw type_error("TRUE or FALSE");
        lexer_.take();
        value_.numbers.push_back(yes ? 1 : 0);
    }

    void read_text() {
        if (lexer_.peek().kind != TokenKind::text && !is_name(lexer_.peek())) throw type_error("a text");
        const Token token = lexer_.take();
        if (token.text.size() > kMaxString_bytes) {
            throw lexer_.error(token.line, "a text of " + std::to_string(token.text.size()) + " bytes; shorten it");
        }
        value_.texts.push_back(token.kind == TokenKind::text ? vrml::unescape(token.text) : std::string(token.text));
    }

    // (A | B), with or without spaces.
    void read_words() {
        bool open = false;
        do {
            if (!is_name(lexer_.peek())) throw type_error("a word");
            std::string word;
            for (const char c : lexer_.take().text) {
                if (c != '(' && c != ')' && c != '|') {
                    word += c;
                    continue;
                }
                if (c != '|') open = c == '(';
                if (!word.empty()) value_.texts.push_back(std::exchange(word, {}));
            }
            if (!word.empty()) value_.texts.push_back(word);
            if (value_.texts.size() > 16) throw lexer_.error(name_ + " has too many words; correct it");
        } while (open);
        if (value_.texts.empty()) throw type_error("a word");
    }

    long take_integer() {
        long value = 0;
        if (lexer_.peek().kind != TokenKind::number || !vrml::parse_integer(lexer_.peek().text, value)) {
            throw type_error("whole numbers");
        }
        lexer_.take();
        return value;
    }

    void read_number() {
        float value = 0;
        if (lexer_.peek().kind != TokenKind::number || !vrml::parse_float(lexer_.peek().text, value)) {
            throw type_error("numbers");
        }
        lexer_.take();
        value_.numbers.push_back(static_cast<double>(value));
    }

    Lexer& lexer_;
    const Field& field_;
    const std::string& name_;
    Value value_;
};

class TreeReader {
public:
    TreeReader(Lexer& lexer, const Warn& warn) : lexer_(lexer), warn_(warn) {}

    std::vector<TreePointer> read() {
        std::vector<TreePointer> roots;
        while (lexer_.peek().kind != TokenKind::end) {
            if (TreePointer root = take_node()) roots.push_back(std::move(root));
        }
        return roots;
    }

private:
    Token take_name(const char* what) {
        if (!is_name(lexer_.peek()))
            throw lexer_.error("expected " + std::string(what) + ", not " + quote(lexer_.peek()));
        return lexer_.take();
    }

    // Null for a USE of an undefined name.
    TreePointer take_node() {
        Token type = take_name("a node");
        std::string name;
        if (type.text == "USE") return take_use();
        if (type.text == "DEF") {
            name = take_name("a name").text;
            type = take_name("a node");
        }
        const vrml::NestingGuard guard(lexer_, nesting_, vrml::kMaxNesting, type.line);
        auto node = std::make_shared<Tree>();
        node->type = type.text;
        node->name = name;
        node->line = type.line;
        node->kind = find_kind(type.text);
        static const NodeKind kUnknown{.known = false};
        if (node->kind == nullptr) {
            warn_(type.line, quote(type) + " is an unknown node; only its children are drawn");
            node->kind = &kUnknown;
        }
        take_body(*node, lexer_.expect(TokenKind::open_body, "{").line);
        if (!name.empty()) named_[name] = node;
        return node;
    }

    TreePointer take_use() {
        const Token name = take_name("a name");
        const auto found = named_.find(std::string(name.text));
        if (found != named_.end()) return found->second;
        warn_(name.line, "USE " + quote(name) + ": this name is not defined before; left out");
        return nullptr;
    }

    // Fields and child nodes: a word is a field if this node's kind has it, otherwise a node.
    void take_body(Tree& node, int open_line) {
        while (!lexer_.take_kind(TokenKind::close_body)) {
            const Token next = lexer_.peek();
            if (next.kind == TokenKind::end) throw lexer_.error(open_line, "the { is not closed; add a }");
            if (!is_name(next)) throw lexer_.error("expected a field, a node or }, not " + quote(next));
            const auto known = node.kind->fields.find(next.text);
            if (known != node.kind->fields.end()) {
                lexer_.take();
                node.fields[known->first] = read_value(lexer_, known->second, known->first);
            } else if (begins_node(next)) {
                if (TreePointer child = take_node()) node.children.push_back(std::move(child));
            } else {
                skip_field(node);
            }
        }
    }

    // Node names begin with a capital, field names do not.
    static bool begins_node(const Token& token) { return token.text.front() >= 'A' && token.text.front() <= 'Z'; }

    void skip_field(const Tree& node) {
        const Token name = lexer_.take();
        // Nodes may declare their own fields, and unknown nodes may contain anything.
        const bool of_itself = name.text == "fields" || name.text == "isA";
        if (node.kind->known && !of_itself) warn_(name.line, node.type + " has no field " + quote(name) + "; left out");
        if (lexer_.peek().kind != TokenKind::word || lexer_.peek().text.front() != '(') return vrml::skip_value(lexer_);
        while (is_name(lexer_.peek()) && lexer_.take().text.back() != ')') {
        }
    }

    Lexer& lexer_;
    const Warn& warn_;
    std::map<std::string, TreePointer> named_;
    int nesting_ = 0;
};

}  // namespace

const Value& Tree::field(std::string_view key) const {
    if (const auto given = fields.find(key); given != fields.end()) return given->second;
    const auto known = kind->fields.find(key);
    RS_CHECK(known != kind->fields.end());
    return known->second.initial;
}

glm::dvec3 Tree::triple(std::string_view key) const {
    const std::vector<double>& n = field(key).numbers;
    return {n.at(0), n.at(1), n.at(2)};
}

bool Tree::has_part(std::string_view key, std::string_view word) const {
    const std::vector<std::string>& words = field(key).texts;
    return std::any_of(words.begin(), words.end(), [&](const std::string& w) { return w == word || w == "ALL"; });
}

Value read_value(Lexer& lexer, const Field& field, const std::string& name) {
    return ValueReader(lexer, field, name).read();
}

std::vector<TreePointer> read_trees(Lexer& lexer, const Warn& warn) {
    return TreeReader(lexer, warn).read();
}

}  // namespace rs::compositor::vrml1
