#include "rayspace/models/model_material.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>

#include <algorithm>
#include <limits>

namespace rs {
namespace {

glm::vec3 to_vec(const aiColor3D& c) {
    return {c.r, c.g, c.b};
}

glm::vec3 as_reflectance(const glm::vec3& c) {
    return glm::clamp(c, glm::vec3(0.0F), glm::vec3(1.0F));
}

glm::vec3 colour_property(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
    return to_vec(material_property<aiColor3D>(material, key, type, index).value_or(aiColor3D(0.0F)));
}

// Alpha threshold for holes of the base colour texture (glTF 2.0, 3.9.4).
float hole_alpha_of(const aiMaterial& source) {
    const std::string mode =
        material_property<aiString>(source, AI_MATKEY_GLTF_ALPHAMODE).value_or(aiString("OPAQUE")).C_Str();
    if (mode == "BLEND") return kBlendedHoleAlpha;
    if (mode != "MASK") return 0.0F;
    const float cutoff = material_property<float>(source, AI_MATKEY_GLTF_ALPHACUTOFF).value_or(0.5F);
    const float factor = material_property<aiColor4D>(source, AI_MATKEY_BASE_COLOR).value_or(aiColor4D(1.0F)).a;
    if (cutoff <= 0.0F) return 0.0F;
    return factor > 0.0F ? cutoff / factor : std::numeric_limits<float>::infinity();
}

Status read_gltf(const aiMaterial& source, const TextureMean& mean_of, ModelMaterial& material) {
    MetallicRoughness factors{SurfaceProperties{}.colour};
    if (const auto base = material_property<aiColor4D>(source, AI_MATKEY_BASE_COLOR)) {
        factors.base = {base->r, base->g, base->b};
    }
    factors.metallic = material_property<float>(source, AI_MATKEY_METALLIC_FACTOR).value_or(1.0F);
    factors.roughness = material_property<float>(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(1.0F);
    // Assimp's slot for the combined metallic-roughness texture.
    if (const auto texture = texture_of(source, {aiTextureType_UNKNOWN})) {
        RS_ASSIGN_OR_RETURN(const glm::vec3 mean, mean_of(texture->name));
        factors.roughness *= mean.g;
        factors.metallic *= mean.b;
    }
    SurfaceProperties& surface = material.surface = surface_of(factors);
    material.metallic_roughness = factors;
    const float transmission = material_property<float>(source, AI_MATKEY_TRANSMISSION_FACTOR).value_or(0.0F);
    surface.ior = std::clamp(material_property<float>(source, AI_MATKEY_REFRACTI).value_or(1.5F), 1.0F, 10.0F);
    if (transmission >= 0.5F) surface.kind = SurfaceKind::glass;
    surface.emission = glm::max(colour_property(source, AI_MATKEY_COLOR_EMISSIVE), glm::vec3(0.0F));
    material.emission = texture_of(source, {aiTextureType_EMISSIVE});
    material.colours = texture_of(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, hole_alpha_of(source));
    return {};
}

// MTL's illumination models: 3, 5 mirror reflection; 4, 6, 7, 9 transparency (MTL specification, "illum").
void read_mtl(const aiMaterial& source, ModelMaterial& material) {
    SurfaceProperties& surface = material.surface;
    const glm::vec3 diffuse =
        as_reflectance(to_vec(material_property<aiColor3D>(source, AI_MATKEY_COLOR_DIFFUSE).value_or(aiColor3D(0.8F))));
    const glm::vec3 specular = as_reflectance(colour_property(source, AI_MATKEY_COLOR_SPECULAR));
    const float specular_peak = std::max({specular.r, specular.g, specular.b});
    const float exponent = std::max(material_property<float>(source, AI_MATKEY_SHININESS).value_or(0.0F), 0.0F);
    const float opacity = material_property<float>(source, AI_MATKEY_OPACITY).value_or(1.0F);
    const int illum = material_property<int>(source, AI_MATKEY_OBJ_ILLUM).value_or(2);
    const float ior = material_property<float>(source, AI_MATKEY_REFRACTI).value_or(1.0F);
    surface.ior = ior > 1.0F ? std::min(ior, 10.0F) : 1.5F;
    surface.colour = diffuse;
    surface.emission = glm::max(colour_property(source, AI_MATKEY_COLOR_EMISSIVE), glm::vec3(0.0F));
    // Lamps in MTL scenes are usually single polygons just below a ceiling, emitting downwards.
    material.two_sided = surface.emission == glm::vec3(0.0F);
    const bool transparent = illum == 4 || illum == 6 || illum == 7 || illum == 9 || opacity < 0.5F;
    const bool reflecting = (illum == 3 || illum == 5) && specular_peak > 0.0F;
    const auto metallic = material_property<float>(source, AI_MATKEY_METALLIC_FACTOR);
    const auto roughness = material_property<float>(source, AI_MATKEY_ROUGHNESS_FACTOR);
    if (transparent) {
        surface.kind = SurfaceKind::glass;
        const glm::vec3 filter = as_reflectance(colour_property(source, AI_MATKEY_COLOR_TRANSPARENT));  // Tf
        surface.colour = filter == glm::vec3(0.0F) ? glm::vec3(1.0F) : filter;
    } else if (metallic && *metallic >= 0.5F) {
        surface.kind = SurfaceKind::metal;
        surface.roughness = std::clamp(roughness.value_or(0.3F), 0.0F, 1.0F);
    } else if (roughness) {
        surface.kind = SurfaceKind::glossy;
        surface.roughness = std::clamp(*roughness, 0.0F, 1.0F);
    } else if (reflecting && std::max({diffuse.r, diffuse.g, diffuse.b}) < 0.05F) {
        surface.kind = SurfaceKind::mirror;
        surface.colour = specular;
    } else if (specular_peak > 0.0F && exponent > 0.0F && illum >= 2) {
        surface.kind = SurfaceKind::glossy;
        surface.roughness = roughness_of_exponent(exponent);
    }
    material.colours = texture_of(source, {aiTextureType_DIFFUSE}, kBlendedHoleAlpha);
    // Many exporters write Kd 0 for textured materials, which would make the texture black.
    if (material.colours && surface.colour == glm::vec3(0.0F)) surface.colour = glm::vec3(1.0F);
}

}  // namespace

std::optional<ModelTexture> texture_of(const aiMaterial& material, std::initializer_list<aiTextureType> types,
                                       float hole_alpha) {
    for (const aiTextureType type : types) {
        aiString name;
        if (material.GetTextureCount(type) == 0 || material.GetTexture(type, 0, &name) != AI_SUCCESS) continue;
        if (name.length == 0) continue;
        const auto repeats = [&](const char* key, unsigned of_type, unsigned index) {
            return material_property<int>(material, key, of_type, index).value_or(aiTextureMapMode_Wrap) !=
                   aiTextureMapMode_Clamp;
        };
        return ModelTexture{name.C_Str(), repeats(AI_MATKEY_MAPPINGMODE_U(type, 0)),
                            repeats(AI_MATKEY_MAPPINGMODE_V(type, 0)), hole_alpha};
    }
    return std::nullopt;
}

Result<ModelMaterial> read_model_material(const aiMaterial& source, bool gltf, const TextureMean& mean_of) {
    ModelMaterial material;
    material.name = material_property<aiString>(source, AI_MATKEY_NAME).value_or(aiString("material")).C_Str();
    if (gltf) {
        RS_TRY(read_gltf(source, mean_of, material));
    } else {
        read_mtl(source, material);
    }
    return material;
}

aiTextureType leading_texture(const aiMaterial& material) {
    for (const aiTextureType type : {aiTextureType_DIFFUSE, aiTextureType_NORMALS, aiTextureType_EMISSIVE}) {
        if (material.GetTextureCount(type) > 0) return type;
    }
    return aiTextureType_DIFFUSE;
}

bool has_other_coordinates(const aiMaterial& material, aiTextureType type) {
    const aiTextureType leading = leading_texture(material);
    const auto set_of = [&](aiTextureType t) {
        return material_property<int>(material, AI_MATKEY_UVWSRC(t, 0)).value_or(0);
    };
    const auto transform_of = [&](aiTextureType t) {
        return material_property<aiUVTransform>(material, AI_MATKEY_UVTRANSFORM(t, 0)).value_or(aiUVTransform());
    };
    const aiUVTransform a = transform_of(type), b = transform_of(leading);
    return set_of(type) != set_of(leading) || a.mScaling != b.mScaling || a.mTranslation != b.mTranslation ||
           a.mRotation != b.mRotation;
}

bool is_gltf(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    return extension.size() > 1 && (extension[1] == 'g' || extension[1] == 'G');
}

}  // namespace rs
