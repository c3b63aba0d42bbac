#include "compositor/scene/model/model_materials.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/light/metallic_roughness.hpp"
#include "rayspace/models/model_image.hpp"
#include "rayspace/models/model_material.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace rs::compositor::model {
namespace {

constexpr float kMaxBumpScale = 1000;

glm::vec3 vec(const aiColor3D& c) {
    return glm::clamp(glm::vec3(c.r, c.g, c.b), glm::vec3(0), glm::vec3(1));
}

}  // namespace

ModelMaterials::ModelMaterials(const aiScene& model, std::filesystem::path file)
    : model_(model), file_(std::move(file)) {}

const MaterialWithSides& ModelMaterials::at(unsigned index) {
    const auto known = converted_.find(index);
    if (known != converted_.end()) return known->second;
    return converted_.emplace(index, convert(*model_.mMaterials[index])).first->second;
}

std::shared_ptr<const SceneTexture> ModelMaterials::image(const std::string& name, bool repeat_s, bool repeat_t) {
    const auto read = read_model_image(model_, file_, name, [&](const std::filesystem::path& path) {
        return images_.read_file(path, repeat_s, repeat_t);
    });
    if (read) return *read;
    const std::string& message = read.error().message;
    const std::string place = message.starts_with(file_.string()) ? "" : file_.string() + ": ";
    std::string warning = printable(place + message + "; drawn without");
    if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(std::move(warning));
    return nullptr;
}

MaterialWithSides ModelMaterials::convert(const aiMaterial& source) {
    MaterialWithSides result;
    Material& material = result.material;
    material.ambient = 1;
    material.emissive = vec(material_property<aiColor3D>(source, AI_MATKEY_COLOR_EMISSIVE).value_or(aiColor3D(0)));
    result.two_sided = material_property<int>(source, AI_MATKEY_TWOSIDED).value_or(1) != 0;
    bool blends = true;
    if (const auto base = material_property<aiColor4D>(source, AI_MATKEY_BASE_COLOR)) {
        const std::string mode =
            material_property<aiString>(source, AI_MATKEY_GLTF_ALPHAMODE).value_or(aiString("OPAQUE")).C_Str();
        blends = mode != "OPAQUE";
        material.opacity = mode == "BLEND" ? std::clamp(base->a, 0.0F, 1.0F) : 1;
        result.two_sided = material_property<int>(source, AI_MATKEY_TWOSIDED).value_or(0) != 0;
    } else {
        material.diffuse = vec(material_property<aiColor3D>(source, AI_MATKEY_COLOR_DIFFUSE).value_or(aiColor3D(0.8F)));
        material.specular = vec(material_property<aiColor3D>(source, AI_MATKEY_COLOR_SPECULAR).value_or(aiColor3D(0)));
        material.shininess =
            std::clamp(material_property<float>(source, AI_MATKEY_SHININESS).value_or(0) / 128, 0.0F, 1.0F);
        const float exponent = std::max(material_property<float>(source, AI_MATKEY_SHININESS).value_or(0), 0.0F);
        material.phong = PhongTerms{
            vec(material_property<aiColor3D>(source, AI_MATKEY_COLOR_AMBIENT).value_or(aiColor3D(0))), exponent};
        if (material.shininess == 0) material.specular = glm::vec3(0);
        material.opacity = std::clamp(material_property<float>(source, AI_MATKEY_OPACITY).value_or(1), 0.0F, 1.0F);
    }
    const int shading = material_property<int>(source, AI_MATKEY_SHADING_MODEL).value_or(aiShadingMode_Gouraud);
    material.lit = shading != aiShadingMode_Unlit;
    material.normals = relief(source);
    add_surface(source, blends, material);
    return result;
}

void ModelMaterials::add_surface(const aiMaterial& source, bool blends, Material& material) {
    const auto mean_of = [&](const std::string& name) -> Result<glm::vec3> {
        const auto read = image(name, true, true);
        return read ? mean_of_codes(read->image.pixels()) : glm::vec3(1);
    };
    const Result<ModelMaterial> read = read_model_material(source, is_gltf(file_), mean_of);
    if (!read) return;
    if (read->colours) {
        material.texture = colour_texture(*read->colours, blends);
    }
    if (read->metallic_roughness) {
        const bool has_texture = material.texture != nullptr;
        const PhongColours phong =
            phong_colours_of(*read->metallic_roughness,
                             has_texture ? mean_linear_colour(material.texture->image.pixels()) : glm::vec3(1));
        material.diffuse = material.lit ? phong.diffuse : read->surface.colour;
        material.specular = phong.specular;
        material.shininess = phong.exponent / 128;
    }
    if (!material.lit) return;
    material.surface = read->surface;
    if (read->emission && read->surface.emission != glm::vec3(0) && can_place(source, aiTextureType_EMISSIVE)) {
        material.emission_texture = image(read->emission->name, read->emission->repeat_u, read->emission->repeat_v);
    }
    // Glass is blended by raster renderers.
    constexpr float kGlassOpacity = 0.25F;
    if (read->surface.kind == rs::SurfaceKind::glass) material.opacity = std::min(material.opacity, kGlassOpacity);
}

std::shared_ptr<const SceneTexture> ModelMaterials::colour_texture(const ModelTexture& source, bool blends) {
    const auto read = image(source.name, source.repeat_u, source.repeat_v);
    if (!read) return nullptr;
    auto texture = std::make_shared<SceneTexture>(*read);
    texture->modulates = true;
    texture->has_alpha = texture->has_alpha && blends;
    // Pixels below the cutoff of an alpha mask are holes.
    if (texture->has_alpha && source.hole_alpha != kBlendedHoleAlpha) {
        for (Rgba8& p : texture->image.pixels()) p.a = static_cast<float>(p.a) < source.hole_alpha * 255 ? 0 : 255;
    }
    return texture;
}

// Meshes have one set of coordinates (leading_texture). OBJ files have only one.
bool ModelMaterials::can_place(const aiMaterial& source, aiTextureType type) {
    if (!is_gltf(file_) || !has_other_coordinates(source, type)) return true;
    warnings.push_back(printable(file_.string() + ": material \"" + source.GetName().C_Str() + "\": the " +
                                 (type == aiTextureType_NORMALS ? "normal" : "emission") +
                                 " texture has other coordinates than the color texture; drawn without"));
    return false;
}

// glTF's normal texture, MTL's norm, or MTL's bump map. Normals take precedence over heights.
std::shared_ptr<const NormalMap> ModelMaterials::relief(const aiMaterial& source) {
    for (const aiTextureType type : {aiTextureType_NORMALS, aiTextureType_HEIGHT}) {
        const auto texture = texture_of(source, {type});
        if (!texture || !can_place(source, type)) continue;
        const auto read = image(texture->name, texture->repeat_u, texture->repeat_v);
        if (!read) continue;
        float strength = material_property<float>(source, AI_MATKEY_GLTF_TEXTURE_SCALE(type, 0)).value_or(1);
        strength = material_property<float>(source, AI_MATKEY_OBJ_BUMPMULT(type, 0)).value_or(strength);
        strength = std::isfinite(strength) ? std::clamp(strength, -kMaxBumpScale, kMaxBumpScale) : 1;
        return type == aiTextureType_HEIGHT ? normal_map_of_heights(*read, strength) : normal_map(*read, strength);
    }
    return nullptr;
}

}  // namespace rs::compositor::model
