#pragma once
// Converts materials of glTF and MTL, as Assimp reads them, to surfaces for ray tracing. Thread-safe.

#include "rayspace/base/result.hpp"
#include "rayspace/light/metallic_roughness.hpp"
#include "rayspace/light/surface_properties.hpp"

#include <assimp/material.h>
#include <glm/glm.hpp>

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>

namespace rs {

/// ModelTexture::hole_alpha of blended surfaces and of MTL.
inline constexpr float kBlendedHoleAlpha = 0.5F;

/// Colour texture of a material.
struct ModelTexture {
    std::string name;      // as in the file: relative, embedded or percent-encoded
    bool repeat_u = true;  // else clamped
    bool repeat_v = true;
    float hole_alpha = 0;  // pixels with a smaller alpha are holes: none for 0, all for infinity
};

struct ModelMaterial {
    std::string name;
    SurfaceProperties surface;
    std::optional<MetallicRoughness> metallic_roughness;  // of glTF, with the mean of its texture
    bool two_sided = true;  // false only for emissive surfaces of MTL: lamps that shine to one side
    std::optional<ModelTexture> colours;
    std::optional<ModelTexture> emission;
};

/// Property of a material by Assimp's key macros, such as AI_MATKEY_OPACITY; nullopt if missing or of another type.
template <class T>
std::optional<T> material_property(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
    T value{};
    if (material.Get(key, type, index, value) != AI_SUCCESS) return std::nullopt;
    return value;
}

/// First texture of these types; nullopt if there is none.
std::optional<ModelTexture> texture_of(const aiMaterial& material, std::initializer_list<aiTextureType> types,
                                       float hole_alpha = 0);

/// Mean red, green and blue (0..1) of an image of linear values.
using TextureMean = std::function<Result<glm::vec3>(const std::string& name)>;

/// \param gltf the material is from a glTF file; else from MTL
/// \param mean_of used for metallic-roughness textures, of which only the mean counts
/// \return errors of `mean_of` only
Result<ModelMaterial> read_model_material(const aiMaterial& source, bool gltf, const TextureMean& mean_of);

/// Texture by which the coordinates of a material's meshes are placed (post_process of model_files.hpp): the first one
/// of colour, normals and emission.
aiTextureType leading_texture(const aiMaterial& material);
/// True if the texture of this type has another set of coordinates or another transform than leading_texture().
bool has_other_coordinates(const aiMaterial& material, aiTextureType type);

/// True for names of glTF and GLB files.
bool is_gltf(const std::filesystem::path& file);

}  // namespace rs
