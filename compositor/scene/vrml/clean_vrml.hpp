#pragma once
// The first of the two steps in which VRML97 is read: text -> text that Coin reads without stumbling.
//
//   file -> clean_vrml -> Coin (graph.hpp) -> flatten.hpp -> Scene
//
// Coin gives a whole file up at an unknown field and can be crashed by hostile text. So everything is checked here:
// the syntax, the type of each value, where each node stands, each USE, each IS. Left out with a warning are unknown
// nodes (of those that group others the children stay) and unknown fields, nodes that stand where they may not, USE of
// a name that is not known or that holds the USE itself, EXTERNPROTO. Left out, since time stands still, are ROUTEs,
// scripts, sensors, interpolators and sound. Broken syntax and wrong types refuse the file.
//
// Names are replaced by "nK"; K counts the entries of `nodes`.

#include "rayspace/base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor::vrml {

constexpr int kMaxNesting = 200;         // brackets of the text
constexpr int kMaxHeight = 1000;         // of the graph, PROTO and USE followed
constexpr double kMaxVisits = 1e6;       // nodes that a walk over the graph meets, PROTO and USE followed
constexpr double kMaxValues = 32 << 20;  // numbers and texts, those of each instance of a PROTO counted

struct SourceNode {
    std::string name;  // of its DEF; empty where it has none
    int line = 0;
};

struct CleanVrml {
    std::string text;
    std::vector<SourceNode> nodes;
    std::vector<std::string> warnings;  // "FILE: line N: ..."; at most kMaxWarnings and one that counts the rest
};
constexpr std::size_t kMaxWarnings = 50;

// `file` names the text in messages. An error names the line. Pure; thread-safe.
Result<CleanVrml> clean_vrml(std::string_view text, const std::string& file);

}  // namespace rs::compositor::vrml
