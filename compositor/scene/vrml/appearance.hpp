#pragma once
// Materials of Appearance nodes: VRML97's and X3D's Material (Phong), X3D 4's UnlitMaterial and PhysicalMaterial, with
// their textures. The latter two become the materials of glTF's KHR_materials_unlit and metallic-roughness model.
// Private to the VRML reader; not thread-safe.

#include "compositor/scene/material.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/vrml/graph.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace rs::compositor::vrml {

/// Receives what is left out of a node.
using NodeWarning = std::function<void(const Node& node, const std::string& what)>;

/// \param appearance may be null.
/// \param folder of the file, for textures.
Material material_of(const Node* appearance, Topology topology, const std::filesystem::path& folder,
                     SceneImages& images, const NodeWarning& warn);

/// Linear light of an SFColor, which is sRGB.
glm::vec3 linear_colour(const glm::dvec3& srgb);

}  // namespace rs::compositor::vrml
