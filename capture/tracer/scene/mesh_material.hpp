#pragma once
// The materials of an Assimp scene as our own, with the textures they name. Part of mesh_file.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

// The images that the materials of an Assimp scene name. Part of mesh_file.

struct aiScene;

namespace rs::capture {

// Names are relative to the folder of `file`, which `source` was read from, or name an image inside of it. Each
// image is read once. Errors name the image and `file`.
class MeshTextures {
public:
    // Refers to all three; appends to `textures`.
    MeshTextures(const aiScene& source, const std::filesystem::path& file, std::vector<Texture>& textures)
        : source_(source), file_(file), textures_(textures) {}

    // The index of an image of colours in `textures`. What has alpha below `hole_alpha` becomes a hole: nothing for 0,
    // everything for infinity.
    Result<int> colours(const std::string& name, float hole_alpha);

    // The mean red, green and blue of an image of numbers 0..1, which has no sRGB curve.
    Result<glm::vec3> mean_numbers(const std::string& name);

private:
    const aiScene& source_;
    const std::filesystem::path& file_;
    std::vector<Texture>& textures_;
    std::map<std::pair<std::string, float>, int> loaded_;
};

}  // namespace rs::capture

struct aiScene;

namespace rs::capture {

// Appends to scene.materials, index for index, and to scene.textures. `file` is where `source` was read from: textures
// are named relative to its folder, or stand inside of it.
Status convert_materials(const aiScene& source, const std::filesystem::path& file, Scene& scene);

}  // namespace rs::capture
