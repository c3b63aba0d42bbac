#pragma once
// Finished nodes, counted, and those that a PROTO's instances are made of. Private to the VRML reader; not thread-safe.

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
    NodePointer root;  // only the first node of a body is drawn; null where that is nothing
    FieldSpecs fields;
    std::set<std::string, std::less<>> events;  // eventIn, eventOut: nothing comes through them
};

// A node in the body of a PROTO that is not the same in all of its instances.
struct Pattern {
    NodePointer node;
    std::map<std::string, std::string> is;   // its fields -> those of the PROTO around it
    const Prototype* instance_of = nullptr;  // then the node's fields are arguments for this one
};

// How deep the text, or the PROTOs that it unfolds, have been entered.
class Level {
public:
    Level(const Lexer& lexer, int& depth, int limit, int line) : depth_(depth) {
        if (depth >= limit) {
            throw lexer.wrong(line,
                              "nodes nest more than " + std::to_string(limit) + " deep, PROTO followed; flatten them");
        }
        ++depth_;
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --depth_; }

private:
    int& depth_;
};

class GraphBuilder {
public:
    // `lexer` gives the line of an error, and must outlive the builder.
    explicit GraphBuilder(const Lexer& lexer) : lexer_(lexer) {}

    // The node with all of its fields. Within a PROTO, `pattern` has those that depend on the PROTO's. Throws
    // MalformedVrml where the graph goes beyond its limits (graph.hpp), as do the others.
    NodePointer finished(const std::shared_ptr<Node>& node, Pattern pattern);
    // Null where nothing is to be drawn.
    NodePointer instance(const Prototype& prototype, const Fields& arguments);
    // Whether a node in its fields depends on the PROTO around it.
    [[nodiscard]] bool has_patterns(const Node& node) const;

    // Counts what stands in the text.
    void count(const Value& value);
    void check_extent(double visits, int height) const;

    void warn(int line, const std::string& what);
    std::vector<std::string> take_warnings();

private:
    struct Copies;
    NodePointer copied(const NodePointer& from, Copies& copies);

    const Lexer& lexer_;
    std::map<const Node*, Pattern> patterns_;
    std::vector<std::string> warnings_;
    int more_warnings_ = 0;
    int unfolding_ = 0;
    double nodes_ = 0;
    double values_ = 0;
};

}  // namespace rs::compositor::vrml
