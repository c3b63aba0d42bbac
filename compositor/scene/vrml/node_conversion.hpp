#pragma once
// Conversion of VRML97's nodes to parts of the scene: lights, viewpoints, navigation, fog and background (materials:
// appearance.hpp). Private to the VRML reader; not thread-safe.

#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/scene/vrml/graph.hpp"
#include "compositor/scene/vrml/traversal_state.hpp"

#include <filesystem>
#include <string>

namespace rs::compositor::vrml {

Light light_of(const Node& node, const TraversalState& state);
Viewpoint viewpoint_of(const Node& node, const TraversalState& state);
Navigation navigation_of(const Node& node, const TraversalState& state);
Fog fog_of(const Node& node, const TraversalState& state);
/// \param fault reason why an image is omitted; empty if none is.
Background background_of(const Node& node, const TraversalState& state, const std::filesystem::path& folder,
                         SceneImages& images, std::string& fault);

}  // namespace rs::compositor::vrml
