#pragma once
// Contents of glTF 2.0 nodes that Assimp drops: `extras` for image-based objects, cameras, and lights
// (KHR_lights_punctual). Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rs::compositor::model {

struct GltfContents {
    bool has_meshes = false;
};
/// Appends objects, viewpoints and lights to the scene, and warnings. Errors name the node.
/// \param bytes text of the .gltf, or the .glb.
/// \param path file name for messages; object files are relative to its folder.
Result<GltfContents> read_gltf_nodes(std::span<const std::byte> bytes, const std::filesystem::path& path, Scene& scene);

}  // namespace rs::compositor::model
