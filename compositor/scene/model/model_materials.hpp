#pragma once
// Conversion of Assimp's materials. Private to the model reader; not thread-safe.

#include "compositor/scene/material.hpp"
#include "compositor/scene/scene_images.hpp"
#include "rayspace/models/model_material.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

struct aiScene;
struct aiMaterial;

namespace rs::compositor::model {

struct MaterialWithSides {
    Material material;
    bool two_sided = true;
};

class ModelMaterials {
public:
    ModelMaterials(const aiScene& model, std::filesystem::path file);
    /// \param index material of the model; results are cached.
    const MaterialWithSides& at(unsigned index);
    std::vector<std::string> warnings;

private:
    MaterialWithSides convert(const aiMaterial& source);
    /// Sets the textures, and the surface for traced renderers.
    /// \param blends false if the alpha of textures is ignored
    void add_surface(const aiMaterial& source, bool blends, Material& material);
    std::shared_ptr<const SceneTexture> colour_texture(const ModelTexture& source, bool blends);
    bool can_place(const aiMaterial& source, aiTextureType type);
    std::shared_ptr<const NormalMap> relief(const aiMaterial& source);
    std::shared_ptr<const SceneTexture> image(const std::string& name, bool repeat_s, bool repeat_t);

    const aiScene& model_;
    std::filesystem::path file_;
    SceneImages images_;
    std::map<unsigned, MaterialWithSides> converted_;
};

}  // namespace rs::compositor::model
