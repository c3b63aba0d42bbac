#pragma once
// Builds completed nodes, counts them, and instantiates PROTOs. Private to the VRML reader; not thread-safe.

#include "compositor/scene/vrml/graph.hpp"
#include "compositor/scene/vrml/lexer.hpp"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

using Fields = std::map<std::string, Value, std::less<>>;

struct Prototype {
    NodePointer root;  // only the first node of a body is drawn; may be null
    FieldSpecs fields;
    std::set<std::string, std::less<>> events;  // eventIn, eventOut: ignored
};

/// Node in the body of a PROTO that depends on the instance's fields.
struct Pattern {
    NodePointer node;
    std::map<std::string, std::string> is;   // its fields -> fields of the enclosing PROTO
    const Prototype* instance_of = nullptr;  // for an instance: the node's fields are its arguments
};

/// Guards the nesting depth of the text or of PROTO expansion.
class NestingGuard {
public:
    NestingGuard(const Lexer& lexer, int& depth, int limit, int line) : depth_(depth) {
        if (depth >= limit) {
            throw lexer.error(line,
                              "nodes nest more than " + std::to_string(limit) + " deep, PROTO followed; flatten them");
        }
        ++depth_;
    }
    NestingGuard(const NestingGuard&) = delete;
    NestingGuard& operator=(const NestingGuard&) = delete;
    ~NestingGuard() { --depth_; }

private:
    int& depth_;
};

class GraphBuilder {
public:
    /// \param lexer locates errors; must outlive the builder.
    explicit GraphBuilder(const Lexer& lexer) : lexer_(lexer) {}

    /// Registers a node with all of its fields.
    /// \param pattern within a PROTO: fields that depend on the PROTO's.
    /// Throws MalformedVrml if limits (graph.hpp) are exceeded, as the other functions do.
    NodePointer finish_node(const std::shared_ptr<Node>& node, Pattern pattern);
    /// Instantiates a PROTO; null if nothing is to be drawn.
    NodePointer instantiate(const Prototype& prototype, const Fields& arguments);
    /// True if a node in its fields depends on the enclosing PROTO.
    [[nodiscard]] bool has_patterns(const Node& node) const;

    /// Counts a value of the text against the limits.
    void count(const Value& value);
    void check_extent(double visits, int height) const;

    void warn(int line, const std::string& what);
    std::vector<std::string> take_warnings();

private:
    struct InstantiationState;
    NodePointer copy_node(const NodePointer& from, InstantiationState& copies);

    const Lexer& lexer_;
    std::map<const Node*, Pattern> patterns_;
    std::vector<std::string> warnings_;
    int more_warnings_ = 0;
    int unfolding_ = 0;
    double nodes_ = 0;
    double values_ = 0;
};

}  // namespace rs::compositor::vrml
