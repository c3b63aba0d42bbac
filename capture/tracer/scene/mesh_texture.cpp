#include "capture/tracer/scene/mesh_texture.hpp"

#include "capture/tracer/scene/mesh_file.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <assimp/scene.h>
#include <assimp/texture.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <random>
#include <span>

namespace rs::capture {

namespace {

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
    Result<StagedFile> staged = StagedFile::create(path);
    if (!staged) return staged.error();
    const auto bytes = std::as_bytes(std::span(reinterpret_cast<const unsigned char*>(source.pcData), source.mWidth));
    if (Status written = staged->write(bytes); !written) return written.error();
    return staged->commit();
}

// Pictures that stand inside of a GLB go through a file of their own, for readers take paths.
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
    if (Status written = write_bytes(source, temporary.path()); !written) return written.error();
    auto result = read(temporary.path());
    if (result) return result;
    return Error{file.string() + ": its embedded texture \"" + name + "\" cannot be read; store it as PNG or JPEG"};
}

// Calls `read` with the path of the picture.
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
    Result<Texture> texture =
        read_named(source_, name, file_, [&](const std::filesystem::path& path) { return read_texture(path, file_); });
    if (!texture) return texture.error();
    if (hole_alpha != kHoleAlpha) {
        for (RgbaF& p : texture->pixels.pixels()) p.a = p.a < hole_alpha ? 0.0F : 1.0F;
    }
    if (source_.GetEmbeddedTexture(name.c_str()) != nullptr) texture->name = name;
    textures_.push_back(std::move(texture).value());
    return loaded_[key] = static_cast<int>(textures_.size()) - 1;
}

Result<glm::vec3> MeshTextures::mean_numbers(const std::string& name) {
    // As codes of 8 bits; the sRGB curve, which such pictures do not have, is then not undone.
    const Result<Image<Rgba8>> codes =
        read_named(source_, name, file_, [&](const std::filesystem::path& path) -> Result<Image<Rgba8>> {
            std::error_code ignored;
            if (!std::filesystem::is_regular_file(path, ignored)) return missing_texture(path, file_);
            return read_picture(path);
        });
    if (!codes) return codes.error();
    glm::dvec3 sum(0.0);
    for (const Rgba8& p : codes->pixels()) sum += glm::dvec3(p.r, p.g, p.b);
    return glm::vec3(sum / (255.0 * static_cast<double>(codes->pixels().size())));
}

}  // namespace rs::capture
