#pragma once
// Materials and textures of a glTF file from those of a scene. Equal materials become one.

#include "compositor/scene/export/glb_document.hpp"
#include "compositor/scene/material.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace rs::compositor {

/// Not thread-safe.
class GltfMaterials {
public:
    explicit GltfMaterials(GlbDocument& document) : document_(document) {}

    /// Index of the material. Highlights of VRML97 become the roughness of a dielectric.
    /// \param coloured the vertices have colours, which replace the diffuse one
    Result<std::size_t> add(const Material& material, bool two_sided, bool coloured);

private:
    struct Written {
        Material material;
        bool two_sided = false;
        bool coloured = false;
        std::size_t index = 0;
    };
    Result<nlohmann::json> convert(const Material& material, bool coloured);
    Result<std::size_t> texture_of(const SceneTexture& texture);
    Result<std::size_t> image_of(const SceneTexture& texture);
    Result<std::size_t> normals_of(const NormalMap& map);
    std::size_t add_image(std::span<const std::byte> file);
    std::size_t add_texture(std::size_t image, bool repeat_s, bool repeat_t);

    GlbDocument& document_;
    std::vector<Written> written_;
    std::map<std::filesystem::path, std::size_t> files_;  // images embedded as they are
    std::map<const void*, std::size_t> images_;           // encoded ones, by their texture
    std::map<std::tuple<std::size_t, bool, bool>, std::size_t> textures_;
};

}  // namespace rs::compositor
