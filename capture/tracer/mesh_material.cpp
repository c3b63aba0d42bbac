#include "capture/tracer/mesh_material.hpp"

#include "capture/tracer/mesh_file.hpp"
#include "rayspace/file_output.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>

namespace rs::capture {

namespace {

glm::vec3 to_vec(const aiColor4D& c) {
    return {c.r, c.g, c.b};
}
glm::vec3 to_vec(const aiColor3D& c) {
    return {c.r, c.g, c.b};
}
glm::vec3 as_reflectance(const glm::vec3& c) {
    return glm::clamp(c, glm::vec3(0.0F), glm::vec3(1.0F));
}

template <class T>
std::optional<T> property(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
    T value{};
    if (material.Get(key, type, index, value) != AI_SUCCESS) return std::nullopt;
    return value;
}

glm::vec3 colour_property(const aiMaterial& material, const char* key, unsigned type, unsigned index) {
    return to_vec(property<aiColor3D>(material, key, type, index).value_or(aiColor3D(0.0F)));
}

bool is_gltf(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    return extension.size() >= 2 && (extension[1] == 'g' || extension[1] == 'G');
}

void convert_gltf(const aiMaterial& source, Material& material) {
    if (const auto base = property<aiColor4D>(source, AI_MATKEY_BASE_COLOR))
        material.colour = as_reflectance(to_vec(*base));
    const float metallic = property<float>(source, AI_MATKEY_METALLIC_FACTOR).value_or(1.0F);
    material.roughness = std::clamp(property<float>(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(1.0F), 0.0F, 1.0F);
    const float transmission = property<float>(source, AI_MATKEY_TRANSMISSION_FACTOR).value_or(0.0F);
    material.ior = std::clamp(property<float>(source, AI_MATKEY_REFRACTI).value_or(1.5F), 1.0F, 10.0F);
    material.kind = transmission >= 0.5F ? SurfaceKind::glass
                    : metallic >= 0.5F   ? SurfaceKind::metal
                                         : SurfaceKind::glossy;
    material.emission = glm::max(colour_property(source, AI_MATKEY_COLOR_EMISSIVE), glm::vec3(0.0F));
}

// MTL's illumination models: 3, 5 mirror reflection; 4, 6, 7, 9 transparency (MTL specification, "illum").
void convert_mtl(const aiMaterial& source, Material& material) {
    const glm::vec3 diffuse =
        as_reflectance(to_vec(property<aiColor3D>(source, AI_MATKEY_COLOR_DIFFUSE).value_or(aiColor3D(0.8F))));
    const glm::vec3 specular = as_reflectance(colour_property(source, AI_MATKEY_COLOR_SPECULAR));
    const float specular_peak = std::max({specular.r, specular.g, specular.b});
    const float exponent = std::max(property<float>(source, AI_MATKEY_SHININESS).value_or(0.0F), 0.0F);
    const float opacity = property<float>(source, AI_MATKEY_OPACITY).value_or(1.0F);
    const int illum = property<int>(source, AI_MATKEY_OBJ_ILLUM).value_or(2);
    const float ior = property<float>(source, AI_MATKEY_REFRACTI).value_or(1.0F);
    material.ior = ior > 1.0F ? std::min(ior, 10.0F) : 1.5F;
    material.colour = diffuse;
    material.emission = glm::max(colour_property(source, AI_MATKEY_COLOR_EMISSIVE), glm::vec3(0.0F));
    // Lamps of MTL scenes are single polygons that shine downwards from just below a ceiling.
    material.two_sided = material.emission == glm::vec3(0.0F);
    const bool transparent = illum == 4 || illum == 6 || illum == 7 || illum == 9 || opacity < 0.5F;
    const bool reflecting = (illum == 3 || illum == 5) && specular_peak > 0.0F;
    if (transparent) {
        material.kind = SurfaceKind::glass;
        material.colour = glm::vec3(1.0F);
    } else if (reflecting && std::max({diffuse.r, diffuse.g, diffuse.b}) < 0.05F) {
        material.kind = SurfaceKind::mirror;
        material.colour = specular;
    } else if (specular_peak > 0.0F && exponent > 0.0F && illum >= 2) {
        // A Phong lobe of exponent n is about as wide as GGX with alpha = sqrt(2 / (n + 2)), and alpha = roughness^2.
        material.kind = SurfaceKind::glossy;
        material.roughness = std::sqrt(std::sqrt(2.0F / (exponent + 2.0F)));
    }
}

// Pictures that stand inside of a GLB go through a file of their own, for readers take paths.
Result<Texture> read_embedded(const aiTexture& source, const std::string& name, const std::filesystem::path& file) {
    if (source.mHeight != 0) {
        return Error{file.string() + ": texture \"" + name + "\" is stored as raw pixels; store it as PNG or JPEG"};
    }
    const std::string hint = source.achFormatHint;
    const std::filesystem::path temporary =
        std::filesystem::temp_directory_path() /
        ("rayspace-texture-" + std::to_string(::getpid()) + "-" + std::to_string(std::random_device{}()) +
         (hint == "jpg" || hint == "jpeg" ? ".jpg" : ".png"));
    Result<StagedFile> staged = StagedFile::create(temporary);
    if (!staged) return staged.error();
    const auto bytes = std::as_bytes(std::span(reinterpret_cast<const unsigned char*>(source.pcData), source.mWidth));
    if (Status written = staged->write(bytes); !written) return written.error();
    if (Status committed = staged->commit(); !committed) return committed.error();
    Result<Texture> texture = read_texture(temporary, file);
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    if (!texture)
        return Error{file.string() + ": its embedded texture \"" + name + "\" cannot be read; store it as PNG or JPEG"};
    texture->name = name;
    return texture;
}

// "%20" and the like, which glTF's URIs have in the place of special characters.
std::string decode_uri(const std::string& uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
        decoded += escaped ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
        if (escaped) i += 2;
    }
    return decoded;
}

Result<Texture> load_texture(const aiScene& source, const std::string& name, const std::filesystem::path& file) {
    if (const aiTexture* embedded = source.GetEmbeddedTexture(name.c_str()))
        return read_embedded(*embedded, name, file);
    std::string relative = name;
    std::ranges::replace(relative, '\\', '/');
    const std::filesystem::path as_written = file.parent_path() / relative;
    std::error_code ignored;
    const bool exists = std::filesystem::exists(as_written, ignored);
    return read_texture(exists ? as_written : file.parent_path() / decode_uri(relative), file);
}

std::optional<std::string> texture_name(const aiMaterial& material) {
    aiString name;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
        if (material.GetTextureCount(type) > 0 && material.GetTexture(type, 0, &name) == AI_SUCCESS &&
            name.length > 0) {
            return std::string(name.C_Str());
        }
    }
    return std::nullopt;
}

}  // namespace

Status convert_materials(const aiScene& source, const std::filesystem::path& file, Scene& scene) {
    std::map<std::string, int> loaded;
    for (unsigned i = 0; i < source.mNumMaterials; ++i) {
        const aiMaterial& from = *source.mMaterials[i];
        Material material;
        material.name = property<aiString>(from, AI_MATKEY_NAME).value_or(aiString("material")).C_Str();
        if (is_gltf(file)) {
            convert_gltf(from, material);
        } else {
            convert_mtl(from, material);
        }
        if (const auto name = texture_name(from)) {
            if (!loaded.contains(*name)) {
                Result<Texture> texture = load_texture(source, *name, file);
                if (!texture) return texture.error();
                loaded[*name] = static_cast<int>(scene.textures.size());
                scene.textures.push_back(std::move(texture).value());
            }
            material.texture = loaded[*name];
            // MTL files of many exporters say Kd 0 beside a texture, which would blacken it.
            if (!is_gltf(file) && material.colour == glm::vec3(0.0F)) material.colour = glm::vec3(1.0F);
        }
        scene.materials.push_back(std::move(material));
    }
    return {};
}

}  // namespace rs::capture
