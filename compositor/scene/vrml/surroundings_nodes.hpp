#pragma once
// VRML97's lights, viewpoints, navigation, fog and background nodes. Private to the VRML reader.

#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/scene/vrml/place.hpp"

#include <filesystem>
#include <string>

namespace rs::compositor::vrml {

Light light_of(const Node& node, const Place& place);
Viewpoint viewpoint_of(const Node& node, const Place& place);
Navigation navigation_of(const Node& node, const Place& place);
Fog fog_of(const Node& node, const Place& place);
// `fault` states why an image is left out; empty where none is.
Background background_of(const Node& node, const Place& place, const std::filesystem::path& folder, SceneImages& images,
                         std::string& fault);

}  // namespace rs::compositor::vrml
