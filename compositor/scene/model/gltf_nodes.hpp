#pragma once
// What Assimp does not carry over from the nodes of a glTF 2.0 file: `extras` that stand for objects made of images,
// cameras, and lights (KHR_lights_punctual). Pure; thread-safe.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rs::compositor::model {

struct GltfContents {
    bool has_meshes = false;
};
// Appends objects, viewpoints and lights to the scene, and warnings. `bytes` are the .gltf's text or the .glb; `path`
// names them in messages and its folder is where object files are. Errors name the place.
Result<GltfContents> read_gltf_nodes(std::span<const std::byte> bytes, const std::filesystem::path& path, Scene& scene);

}  // namespace rs::compositor::model
