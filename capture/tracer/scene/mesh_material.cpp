#include "capture/tracer/scene/mesh_material.hpp"

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <assimp/scene.h>
#include <assimp/texture.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <utility>

namespace rs::capture {
namespace {

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

Result<int> MeshTextures::colours(const ModelTexture& from) {
    const std::string& name = from.name;
    const auto key = std::tuple(name, from.hole_alpha, from.repeat_u, from.repeat_v);
    if (const auto found = loaded_.find(key); found != loaded_.end()) return found->second;
    RS_ASSIGN_OR_RETURN(Texture texture, read_named(source_, name, file_, [&](const std::filesystem::path& path) {
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
        read_named(source_, name, file_, [&](const std::filesystem::path& path) -> Result<Image<Rgba8>> {
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
