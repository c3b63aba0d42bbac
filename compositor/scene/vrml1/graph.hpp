#pragma once
// VRML 1.0 text -> the graph of nodes that the same world has in VRML97. Private to the reader of scenes.
//
//     text -> tree.hpp -> a walk that keeps what VRML 1.0 calls the traversal state -> vrml/graph.hpp -> Scene
//
// In VRML 1.0 a shape is what the nodes before it have made of the state: transformations, coordinates, normals,
// materials, textures, hints. The walk gives each shape all of it: a Transform (by polar decomposition, K. Shoemake and
// T. Duff, "Matrix animation and polar decomposition", 1992) with a Shape.

#include "compositor/scene/vrml/graph.hpp"
#include "rayspace/base/result.hpp"

#include <string>
#include <string_view>

namespace rs::compositor::vrml1 {

inline constexpr std::string_view kHeader = "#VRML V1.0 ascii";

// Of what has no form in VRML97: lines and points are drawn in their diffuse colour where they have no emissive one;
// of several materials only the colours differ; point and spot lights shine on all there is; an orthographic camera
// becomes a perspective one that shows as much at its focal distance; the first level of an LOD is shown; the camera
// that a Switch shows comes before its others. `DEF BackgroundColor Info { string "R G B" }` is heard. Left out with a
// warning are unknown nodes (their children stay), unknown fields, USE of names that are not known, and shapes below a
// scale of 0. Limits are those of vrml/graph.hpp. `file` names the text in messages; an error names the line. Pure;
// thread-safe.
Result<vrml::Graph> read_graph(std::string_view text, const std::string& file);

}  // namespace rs::compositor::vrml1
