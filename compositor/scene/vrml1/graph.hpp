#pragma once
// Converts VRML 1.0 text to the equivalent node graph of VRML97. Private to the scene reader.
//
//     text -> tree.hpp -> traversal with VRML 1.0's traversal state -> vrml/graph.hpp -> Scene
//
// In VRML 1.0 a shape depends on the state set by the nodes before it: transforms, coordinates, normals, materials,
// textures, hints. The traversal turns each shape into a Transform (by polar decomposition, K. Shoemake and T. Duff,
// "Matrix animation and polar decomposition", 1992) with a Shape.

#include "compositor/scene/vrml/graph.hpp"
#include "rayspace/base/result.hpp"

#include <string>
#include <string_view>

namespace rs::compositor::vrml1 {

inline constexpr std::string_view kHeader = "#VRML V1.0 ascii";

/// Approximations: lines and points have their diffuse colour if their emissive one is black; of several materials only
/// the colours differ; point and spot lights apply to the whole scene; an orthographic camera becomes a perspective one
/// with the same field at its focal distance; LOD displays its first level; the camera selected by a Switch precedes
/// the others. `DEF BackgroundColor Info { string "R G B" }` is supported. Omitted with a warning: unknown nodes
/// (children are kept), unknown fields, USE of undefined names, and shapes below a scale of 0. Limits are those of
/// vrml/graph.hpp; errors name the line.
/// \param file file name for messages.
/// Pure; thread-safe.
Result<vrml::Graph> read_graph(std::string_view text, const std::string& file);

}  // namespace rs::compositor::vrml1
