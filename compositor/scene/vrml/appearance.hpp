#pragma once
// VRML97's Appearance, Material and texture nodes -> Material. Private to the VRML reader; not thread-safe.

#include "compositor/scene/material.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/scene_images.hpp"
#include "compositor/scene/vrml/graph.hpp"

#include <filesystem>
#include <string>

namespace rs::compositor::vrml {

glm::vec3 linear_colour(const glm::dvec3& srgb);

/// \param appearance may be null.
/// \param fault reason why a texture is omitted; empty if none is.
Material material_of(const Node* appearance, const Mesh& mesh, const std::filesystem::path& folder, SceneImages& images,
                     std::string& fault);

}  // namespace rs::compositor::vrml
