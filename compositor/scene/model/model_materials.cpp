#include "compositor/scene/model/model_materials.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/models/model_material.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace rs::compositor::model {
namespace {

constexpr float kMaxBumpScale = 1000;

template <class T>
std::optional<T> property(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
    T value{};
    if (material.Get(key, type, index, value) != AI_SUCCESS) return std::nullopt;
    return value;
}

glm::vec3 vec(const aiColor3D& c) {
    return glm::clamp(glm::vec3(c.r, c.g, c.b), glm::vec3(0), glm::vec3(1));
}

bool repeats(const aiMaterial& source, aiTextureType type, bool along_s) {
    const auto mode = along_s ? property<int>(source, AI_MATKEY_MAPPINGMODE_U(type, 0))
                              : property<int>(source, AI_MATKEY_MAPPINGMODE_V(type, 0));
    return mode.value_or(aiTextureMapMode_Wrap) != aiTextureMapMode_Clamp;
}

// Rough surfaces have wide highlights: the width of a Phong lobe of exponent n is about roughness^4 = 2 / (n + 2).
float shininess_of(float roughness) {
    const float r = std::clamp(roughness, 0.2F, 1.0F);
    return std::clamp((2 / (r * r * r * r) - 2) / 128, 0.0F, 1.0F);
}

}  // namespace

ModelMaterials::ModelMaterials(const aiScene& model, std::filesystem::path file)
    : model_(model), file_(std::move(file)) {}

const MaterialWithSides& ModelMaterials::at(unsigned index) {
    const auto known = converted_.find(index);
    if (known != converted_.end()) return known->second;
    return converted_.emplace(index, convert(*model_.mMaterials[index])).first->second;
}

// Embedded images are written to a temporary file for the image reader.
std::shared_ptr<const SceneTexture> ModelMaterials::image(const std::string& name, bool repeat_s, bool repeat_t) {
    std::string fault;
    std::shared_ptr<const SceneTexture> read;
    const aiTexture* embedded = model_.GetEmbeddedTexture(name.c_str());
    if (embedded == nullptr) {
        read = images_.read({name}, file_.parent_path(), repeat_s, repeat_t, fault);
    } else if (embedded->mHeight != 0) {
        fault = "an image inside of the file is of an unknown kind";
    } else {
        std::string path = (std::filesystem::temp_directory_path() / "rayspace-picture-XXXXXX").string();
        const int descriptor = mkstemp(path.data());
        if (descriptor >= 0) close(descriptor);
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(embedded->pcData), static_cast<std::streamsize>(embedded->mWidth));
        read = images_.read({path}, "", repeat_s, repeat_t, fault);
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
    if (!fault.empty()) warnings.push_back(printable(file_.string() + ": " + fault + "; drawn without"));
    return read;
}

MaterialWithSides ModelMaterials::convert(const aiMaterial& source) {
    MaterialWithSides result;
    Material& material = result.material;
    material.ambient = 1;
    material.emissive = vec(property<aiColor3D>(source, AI_MATKEY_COLOR_EMISSIVE).value_or(aiColor3D(0)));
    result.two_sided = property<int>(source, AI_MATKEY_TWOSIDED).value_or(1) != 0;
    bool blends = true;
    if (const auto base = property<aiColor4D>(source, AI_MATKEY_BASE_COLOR)) {
        const float metallic = std::clamp(property<float>(source, AI_MATKEY_METALLIC_FACTOR).value_or(1), 0.0F, 1.0F);
        const glm::vec3 colour = vec({base->r, base->g, base->b});
        // For Phong's formula: metals without reflections would be black except for highlights, so half of the colour
        // stays diffuse.
        material.diffuse = colour * (1 - 0.5F * metallic);
        material.specular = glm::mix(glm::vec3(0.04F), colour, metallic);
        material.shininess = shininess_of(property<float>(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(1));
        const std::string mode =
            property<aiString>(source, AI_MATKEY_GLTF_ALPHAMODE).value_or(aiString("OPAQUE")).C_Str();
        blends = mode != "OPAQUE";
        material.opacity = mode == "BLEND" ? std::clamp(base->a, 0.0F, 1.0F) : 1;
        result.two_sided = property<int>(source, AI_MATKEY_TWOSIDED).value_or(0) != 0;
    } else {
        material.diffuse = vec(property<aiColor3D>(source, AI_MATKEY_COLOR_DIFFUSE).value_or(aiColor3D(0.8F)));
        material.specular = vec(property<aiColor3D>(source, AI_MATKEY_COLOR_SPECULAR).value_or(aiColor3D(0)));
        material.shininess = std::clamp(property<float>(source, AI_MATKEY_SHININESS).value_or(0) / 128, 0.0F, 1.0F);
        const float exponent = std::max(property<float>(source, AI_MATKEY_SHININESS).value_or(0), 0.0F);
        material.phong =
            PhongTerms{vec(property<aiColor3D>(source, AI_MATKEY_COLOR_AMBIENT).value_or(aiColor3D(0))), exponent};
        if (material.shininess == 0) material.specular = glm::vec3(0);
        material.opacity = std::clamp(property<float>(source, AI_MATKEY_OPACITY).value_or(1), 0.0F, 1.0F);
    }
    const int shading = property<int>(source, AI_MATKEY_SHADING_MODEL).value_or(aiShadingMode_Gouraud);
    material.lit = shading != aiShadingMode_Unlit;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        aiString name;
        if (material.texture || source.GetTexture(type, 0, &name) != AI_SUCCESS || name.length == 0) continue;
        const auto read = image(name.C_Str(), repeats(source, type, true), repeats(source, type, false));
        if (!read) continue;
        auto texture = std::make_shared<SceneTexture>(*read);
        texture->modulates = true;
        texture->has_alpha = texture->has_alpha && blends;
        material.texture = std::move(texture);
    }
    material.normals = relief(source);
    add_surface(source, material);
    return result;
}

void ModelMaterials::add_surface(const aiMaterial& source, Material& material) {
    const auto mean_of = [&](const std::string& name) -> Result<glm::vec3> {
        const auto read = image(name, true, true);
        return read ? mean_of_codes(read->image.pixels()) : glm::vec3(1);
    };
    const Result<ModelMaterial> read = read_model_material(source, is_gltf(file_), mean_of);
    if (!read || !material.lit) return;
    material.surface = read->surface;
    if (read->emission && read->surface.emission != glm::vec3(0)) {
        material.emission_texture = image(read->emission->name, read->emission->repeat_u, read->emission->repeat_v);
    }
    // Glass is blended by raster renderers.
    constexpr float kGlassOpacity = 0.25F;
    if (read->surface.kind == rs::SurfaceKind::glass) material.opacity = std::min(material.opacity, kGlassOpacity);
    // Pixels below the cutoff of an alpha mask are holes.
    if (!read->colours || !material.texture || !material.texture->has_alpha) return;
    const float hole_alpha = read->colours->hole_alpha;
    if (hole_alpha == kBlendedHoleAlpha) return;
    auto masked = std::make_shared<SceneTexture>(*material.texture);
    for (Rgba8& p : masked->image.pixels()) p.a = static_cast<float>(p.a) < hole_alpha * 255 ? 0 : 255;
    material.texture = std::move(masked);
}

// glTF's normal texture, MTL's norm, or MTL's bump map. Normals take precedence over heights.
std::shared_ptr<const NormalMap> ModelMaterials::relief(const aiMaterial& source) {
    for (const aiTextureType type : {aiTextureType_NORMALS, aiTextureType_HEIGHT}) {
        aiString name;
        if (source.GetTexture(type, 0, &name) != AI_SUCCESS || name.length == 0) continue;
        const auto read = image(name.C_Str(), repeats(source, type, true), repeats(source, type, false));
        if (!read) continue;
        float strength = property<float>(source, AI_MATKEY_GLTF_TEXTURE_SCALE(type, 0)).value_or(1);
        strength = property<float>(source, AI_MATKEY_OBJ_BUMPMULT(type, 0)).value_or(strength);
        strength = std::isfinite(strength) ? std::clamp(strength, -kMaxBumpScale, kMaxBumpScale) : 1;
        return type == aiTextureType_HEIGHT ? normal_map_of_heights(*read, strength) : normal_map(*read, strength);
    }
    return nullptr;
}

}  // namespace rs::compositor::model
