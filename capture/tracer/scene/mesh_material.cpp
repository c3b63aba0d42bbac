#include "capture/tracer/scene/mesh_material.hpp"

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/models/model_image.hpp"

#include <assimp/scene.h>

#include <string>
#include <utility>

namespace rs::capture {
Result<int> MeshTextures::colours(const ModelTexture& from) {
    const std::string& name = from.name;
    const auto key = std::tuple(name, from.hole_alpha, from.repeat_u, from.repeat_v);
    if (const auto found = loaded_.find(key); found != loaded_.end()) return found->second;
    RS_ASSIGN_OR_RETURN(Texture texture, read_model_image(source_, file_, name, [&](const std::filesystem::path& path) {
                            return read_texture(path, file_);
                        }));
    if (from.hole_alpha != kHoleAlpha) {
        for (RgbaF& p : texture.pixels.pixels()) p.a = p.a < from.hole_alpha ? 0.0F : 1.0F;
    }
    texture.repeat_u = from.repeat_u;
    texture.repeat_v = from.repeat_v;
    if (source_.GetEmbeddedTexture(name.c_str()) != nullptr) texture.name = name;
    textures_.push_back(std::move(texture));
    return loaded_[key] = static_cast<int>(textures_.size()) - 1;
}

Result<glm::vec3> MeshTextures::mean_numbers(const std::string& name) {
    // Reads 8-bit codes without sRGB decoding.
    RS_ASSIGN_OR_RETURN(
        const Image<Rgba8> codes,
        read_model_image(source_, file_, name, [&](const std::filesystem::path& path) -> Result<Image<Rgba8>> {
            std::error_code ignored;
            if (!std::filesystem::is_regular_file(path, ignored)) return missing_texture(path, file_);
            return read_image(path);
        }));
    return mean_of_codes(codes.pixels());
}

Status convert_materials(const aiScene& source, const std::filesystem::path& file, Scene& scene) {
    MeshTextures textures(source, file, scene.textures);
    for (unsigned i = 0; i < source.mNumMaterials; ++i) {
        RS_ASSIGN_OR_RETURN(const ModelMaterial read,
                            read_model_material(*source.mMaterials[i], is_gltf(file),
                                                [&](const std::string& name) { return textures.mean_numbers(name); }));
        Material material;
        material.name = read.name;
        material.kind = read.surface.kind;
        material.colour = read.surface.colour;
        material.roughness = read.surface.roughness;
        material.ior = read.surface.ior;
        material.emission = read.surface.emission;
        material.two_sided = read.two_sided;
        if (read.colours) {
            RS_ASSIGN_OR_RETURN(material.texture, textures.colours(*read.colours));
        }
        if (read.emission && material.emission != glm::vec3(0.0F)) {
            RS_ASSIGN_OR_RETURN(material.emission_texture, textures.colours(*read.emission));
        }
        scene.materials.push_back(std::move(material));
    }
    return {};
}

}  // namespace rs::capture
