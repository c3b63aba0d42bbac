#pragma once
// Conversion of VRML97's nodes to parts of the scene: materials, lights, viewpoints, navigation, fog and background.
// Private to the VRML reader; not thread-safe.

#include "compositor/scene/material.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/scene/vrml/graph.hpp"
#include "compositor/scene/vrml/traversal_state.hpp"

#include <filesystem>
#include <string>

namespace rs::compositor::vrml {

/// Converts an Appearance with its Material and texture nodes.
/// \param appearance may be null.
/// \param fault reason why a texture is omitted; empty if none is.
Material material_of(const Node* appearance, const Mesh& mesh, const std::filesystem::path& folder, SceneImages& images,
                     std::string& fault);

Light light_of(const Node& node, const TraversalState& state);
Viewpoint viewpoint_of(const Node& node, const TraversalState& state);
Navigation navigation_of(const Node& node, const TraversalState& state);
Fog fog_of(const Node& node, const TraversalState& state);
/// \param fault reason why an image is omitted; empty if none is.
Background background_of(const Node& node, const TraversalState& state, const std::filesystem::path& folder,
                         SceneImages& images, std::string& fault);

}  // namespace rs::compositor::vrml
