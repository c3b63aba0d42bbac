#pragma once
// Converts the materials of an Assimp scene and loads their textures. Part of mesh_file.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/models/model_material.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

struct aiScene;

namespace rs::capture {

// Loads the images named by the materials of an Assimp scene, each one once. Names are relative to the folder of
// `file`, the file of the scene, or refer to images embedded in it. Errors name the image and `file`.
class MeshTextures {
public:
    /// Appends to `textures`. Keeps references to all three.
    MeshTextures(const aiScene& source, const std::filesystem::path& file, std::vector<Texture>& textures)
        : source_(source), file_(file), textures_(textures) {}

    /// Loads a colour image and returns its index in `textures`.
    Result<int> colours(const ModelTexture& from);

    /// Mean red, green and blue of a linear (not sRGB) image of values 0..1.
    Result<glm::vec3> mean_numbers(const std::string& name);

private:
    const aiScene& source_;
    const std::filesystem::path& file_;
    std::vector<Texture>& textures_;
    std::map<std::tuple<std::string, float, bool, bool>, int> loaded_;  // by the fields of ModelTexture
};

/// Appends the materials in order to scene.materials and their textures to scene.textures.
/// \param file the file of `source`
Status convert_materials(const aiScene& source, const std::filesystem::path& file, Scene& scene);

}  // namespace rs::capture
