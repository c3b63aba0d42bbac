#pragma once
// Conversion of Assimp's materials. Private to the model reader; not thread-safe.

#include "compositor/scene/material.hpp"
#include "compositor/scene/scene_images.hpp"

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
    /// Sets the surface for traced renderers.
    void add_surface(const aiMaterial& source, Material& material);
    std::shared_ptr<const NormalMap> relief(const aiMaterial& source);
    std::shared_ptr<const SceneTexture> image(const std::string& name, bool repeat_s, bool repeat_t);

    const aiScene& model_;
    std::filesystem::path file_;
    SceneImages images_;
    std::map<unsigned, MaterialWithSides> converted_;
};

}  // namespace rs::compositor::model
