#include "capture/tracer/scene/mesh_material.hpp"

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/texture.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>

namespace rs::capture {
namespace {

// Decodes the percent-encoding ("%20") of glTF URIs.
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

class TemporaryFile {
public:
    explicit TemporaryFile(std::filesystem::path path) : path_(std::move(path)) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

Status write_bytes(const aiTexture& source, const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(StagedFile staged, StagedFile::create(path));
    const auto bytes = std::as_bytes(std::span(reinterpret_cast<const unsigned char*>(source.pcData), source.mWidth));
    RS_TRY(staged.write(bytes));
    return staged.commit();
}

// Copies images embedded in a GLB to a temporary file, because the image readers need a path.
template <class Read>
auto read_embedded(const aiTexture& source, const std::string& name, const std::filesystem::path& file, Read read)
    -> decltype(read(file)) {
    if (source.mHeight != 0) {
        return Error{file.string() + ": texture \"" + name + "\" is stored as raw pixels; store it as PNG or JPEG"};
    }
    const std::string hint = source.achFormatHint;
    const TemporaryFile temporary(std::filesystem::temp_directory_path() /
                                  ("rayspace-texture-" + std::to_string(::getpid()) + "-" +
                                   std::to_string(std::random_device{}()) +
                                   (hint == "jpg" || hint == "jpeg" ? ".jpg" : ".png")));
    RS_TRY(write_bytes(source, temporary.path()));
    auto result = read(temporary.path());
    if (result) return result;
    return Error{file.string() + ": its embedded texture \"" + name + "\" cannot be read; store it as PNG or JPEG"};
}

// Calls `read` with the path of the image.
template <class Read>
auto read_named(const aiScene& source, const std::string& name, const std::filesystem::path& file, Read read)
    -> decltype(read(file)) {
    if (const aiTexture* embedded = source.GetEmbeddedTexture(name.c_str()))
        return read_embedded(*embedded, name, file, read);
    std::string relative = name;
    std::ranges::replace(relative, '\\', '/');
    const std::filesystem::path as_written = file.parent_path() / relative;
    std::error_code ignored;
    const bool exists = std::filesystem::exists(as_written, ignored);
    return read(exists ? as_written : file.parent_path() / decode_uri(relative));
}

}  // namespace

Result<int> MeshTextures::colours(const std::string& name, float hole_alpha) {
    const auto key = std::pair(name, hole_alpha);
    if (const auto found = loaded_.find(key); found != loaded_.end()) return found->second;
    RS_ASSIGN_OR_RETURN(Texture texture, read_named(source_, name, file_, [&](const std::filesystem::path& path) {
                            return read_texture(path, file_);
                        }));
    if (hole_alpha != kHoleAlpha) {
        for (RgbaF& p : texture.pixels.pixels()) p.a = p.a < hole_alpha ? 0.0F : 1.0F;
    }
    if (source_.GetEmbeddedTexture(name.c_str()) != nullptr) texture.name = name;
    textures_.push_back(std::move(texture));
    return loaded_[key] = static_cast<int>(textures_.size()) - 1;
}

Result<glm::vec3> MeshTextures::mean_numbers(const std::string& name) {
    // Reads 8-bit codes without sRGB decoding.
    RS_ASSIGN_OR_RETURN(
        const Image<Rgba8> codes,
        read_named(source_, name, file_, [&](const std::filesystem::path& path) -> Result<Image<Rgba8>> {
            std::error_code ignored;
            if (!std::filesystem::is_regular_file(path, ignored)) return missing_texture(path, file_);
            return read_image(path);
        }));
    glm::dvec3 sum(0.0);
    for (const Rgba8& p : codes.pixels()) sum += glm::dvec3(p.r, p.g, p.b);
    return glm::vec3(sum / (255.0 * static_cast<double>(codes.pixels().size())));
}

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

std::optional<std::string> texture_name(const aiMaterial& material, std::initializer_list<aiTextureType> types) {
    aiString name;
    for (const aiTextureType type : types) {
        if (material.GetTextureCount(type) > 0 && material.GetTexture(type, 0, &name) == AI_SUCCESS &&
            name.length > 0) {
            return std::string(name.C_Str());
        }
    }
    return std::nullopt;
}

// Alpha threshold for holes of the base colour texture (glTF 2.0, 3.9.4); 0.5 for blended surfaces.
float hole_alpha_of(const aiMaterial& source) {
    const std::string mode = property<aiString>(source, AI_MATKEY_GLTF_ALPHAMODE).value_or(aiString("OPAQUE")).C_Str();
    if (mode == "BLEND") return kHoleAlpha;
    if (mode != "MASK") return 0.0F;
    const float cutoff = property<float>(source, AI_MATKEY_GLTF_ALPHACUTOFF).value_or(0.5F);
    const float factor = property<aiColor4D>(source, AI_MATKEY_BASE_COLOR).value_or(aiColor4D(1.0F)).a;
    if (cutoff <= 0.0F) return 0.0F;
    return factor > 0.0F ? cutoff / factor : std::numeric_limits<float>::infinity();
}

Status convert_gltf(const aiMaterial& source, MeshTextures& textures, Material& material) {
    if (const auto base = property<aiColor4D>(source, AI_MATKEY_BASE_COLOR))
        material.colour = as_reflectance(to_vec(*base));
    float metallic = property<float>(source, AI_MATKEY_METALLIC_FACTOR).value_or(1.0F);
    float roughness = property<float>(source, AI_MATKEY_ROUGHNESS_FACTOR).value_or(1.0F);
    // Assimp's slot for the combined metallic-roughness texture.
    if (const auto name = texture_name(source, {aiTextureType_UNKNOWN})) {
        RS_ASSIGN_OR_RETURN(const glm::vec3 mean, textures.mean_numbers(*name));
        roughness *= mean.g;
        metallic *= mean.b;
    }
    material.roughness = std::clamp(roughness, 0.0F, 1.0F);
    const float transmission = property<float>(source, AI_MATKEY_TRANSMISSION_FACTOR).value_or(0.0F);
    material.ior = std::clamp(property<float>(source, AI_MATKEY_REFRACTI).value_or(1.5F), 1.0F, 10.0F);
    material.kind = transmission >= 0.5F ? SurfaceKind::glass
                    : metallic >= 0.5F   ? SurfaceKind::metal
                                         : SurfaceKind::glossy;
    material.emission = glm::max(colour_property(source, AI_MATKEY_COLOR_EMISSIVE), glm::vec3(0.0F));
    const auto glow = texture_name(source, {aiTextureType_EMISSIVE});
    if (glow && material.emission != glm::vec3(0.0F)) {
        RS_ASSIGN_OR_RETURN(const int texture, textures.colours(*glow, 0.0F));
        material.emission_texture = texture;
    }
    if (const auto name = texture_name(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})) {
        RS_ASSIGN_OR_RETURN(const int texture, textures.colours(*name, hole_alpha_of(source)));
        material.texture = texture;
    }
    return {};
}

// MTL's illumination models: 3, 5 mirror reflection; 4, 6, 7, 9 transparency (MTL specification, "illum").
Status convert_mtl(const aiMaterial& source, MeshTextures& textures, Material& material) {
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
    // Lamps in MTL scenes are usually single polygons just below a ceiling, emitting downwards.
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
        // A Phong lobe of exponent n is about as wide as GGX with alpha = sqrt(2 / (n + 2)); alpha = roughness^2.
        material.kind = SurfaceKind::glossy;
        material.roughness = std::sqrt(std::sqrt(2.0F / (exponent + 2.0F)));
    }
    if (const auto name = texture_name(source, {aiTextureType_DIFFUSE})) {
        RS_ASSIGN_OR_RETURN(const int texture, textures.colours(*name, kHoleAlpha));
        material.texture = texture;
        // Many exporters write Kd 0 for textured materials, which would make the texture black.
        if (material.colour == glm::vec3(0.0F)) material.colour = glm::vec3(1.0F);
    }
    return {};
}

}  // namespace

Status convert_materials(const aiScene& source, const std::filesystem::path& file, Scene& scene) {
    MeshTextures textures(source, file, scene.textures);
    for (unsigned i = 0; i < source.mNumMaterials; ++i) {
        const aiMaterial& from = *source.mMaterials[i];
        Material material;
        material.name = property<aiString>(from, AI_MATKEY_NAME).value_or(aiString("material")).C_Str();
        RS_TRY(is_gltf(file) ? convert_gltf(from, textures, material) : convert_mtl(from, textures, material));
        scene.materials.push_back(std::move(material));
    }
    return {};
}

}  // namespace rs::capture
