#pragma once
// Image files of textures of glTF and OBJ models.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <memory>
#include <string>

struct aiScene;

namespace rs {

/// File of an image that a model refers to. Embedded images are copied to a temporary file, because image readers need
/// a path; it is deleted with the last copy of this object.
class ModelImage {
public:
    /// \param model_file file of `model`; references are relative to its folder (file_reference.hpp)
    /// \param name as in a material: embedded, or a reference
    /// \return an error if the image is embedded as raw pixels, or its reference is to another host. The file may not
    /// exist.
    static Result<ModelImage> find(const aiScene& model, const std::filesystem::path& model_file,
                                   const std::string& name);

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] bool is_embedded() const { return temporary_ != nullptr; }

private:
    class TemporaryImage;
    std::filesystem::path path_;
    std::shared_ptr<const TemporaryImage> temporary_;
};

/// Calls `read` with the path of an image that a model refers to.
/// \return the result of `read`; its error names the texture if the image is embedded
template <class Read>
auto read_model_image(const aiScene& model, const std::filesystem::path& model_file, const std::string& name, Read read)
    -> decltype(read(model_file)) {
    RS_ASSIGN_OR_RETURN(const ModelImage image, ModelImage::find(model, model_file, name));
    auto result = read(image.path());
    if (result || !image.is_embedded()) return result;
    return Error{model_file.string() + ": its embedded texture \"" + name +
                 "\" cannot be read; store it as PNG or JPEG"};
}

}  // namespace rs
