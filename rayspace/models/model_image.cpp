#include "rayspace/models/model_image.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/file/file_reference.hpp"

#include <assimp/scene.h>
#include <assimp/texture.h>
#include <unistd.h>

#include <random>
#include <span>

namespace rs {

class ModelImage::TemporaryImage {
public:
    explicit TemporaryImage(std::filesystem::path path) : path_(std::move(path)) {}
    TemporaryImage(const TemporaryImage&) = delete;
    TemporaryImage& operator=(const TemporaryImage&) = delete;
    ~TemporaryImage() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }

private:
    std::filesystem::path path_;
};

Result<ModelImage> ModelImage::find(const aiScene& model, const std::filesystem::path& model_file,
                                    const std::string& name) {
    ModelImage image;
    const aiTexture* const embedded = model.GetEmbeddedTexture(name.c_str());
    if (embedded == nullptr) {
        const auto path = resolve_reference(name, model_file.parent_path());
        if (!path) return Error{model_file.string() + ": texture '" + name.substr(0, 80) + "' is not a local file"};
        image.path_ = *path;
        return image;
    }
    if (embedded->mHeight != 0) {
        return Error{model_file.string() + ": texture \"" + name +
                     "\" is stored as raw pixels; store it as PNG or JPEG"};
    }
    const std::string hint = embedded->achFormatHint;
    image.path_ = std::filesystem::temp_directory_path() /
                  ("rayspace-texture-" + std::to_string(::getpid()) + "-" + std::to_string(std::random_device{}()) +
                   (hint == "jpg" || hint == "jpeg" ? ".jpg" : ".png"));
    RS_ASSIGN_OR_RETURN(StagedFile staged, StagedFile::create(image.path_));
    RS_TRY(staged.write(
        std::as_bytes(std::span(reinterpret_cast<const unsigned char*>(embedded->pcData), embedded->mWidth))));
    RS_TRY(staged.commit());
    image.temporary_ = std::make_shared<const TemporaryImage>(image.path_);
    return image;
}

}  // namespace rs
