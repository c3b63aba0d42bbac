#pragma once
// The materials of an Assimp scene as our own, with the textures they ask for. Part of mesh_file.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>

struct aiScene;

namespace rs::capture {

// Appends to scene.materials, index for index, and to scene.textures. `file` is where `source` was read from: textures
// are named relative to its folder, or stand inside of it.
Status convert_materials(const aiScene& source, const std::filesystem::path& file, Scene& scene);

}  // namespace rs::capture
