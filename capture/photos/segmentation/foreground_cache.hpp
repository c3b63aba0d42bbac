#pragma once
/// \file
/// Temporary storage of a turn's foreground images between the stages of an import: files, compressed for speed by
/// zstd.

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <filesystem>

namespace rs::capture {

class ForegroundCache {
public:
    /// `folder` must exist; its owner removes it. All images are width x height px.
    ForegroundCache(std::filesystem::path folder, int width, int height);

    /// Writes and reads the image of one view. Thread-safe for different views. Errors: the disk; get() also if a file
    /// is damaged.
    [[nodiscard]] Status put(std::size_t view, ConstImageView<Rgba8> image) const;
    [[nodiscard]] Result<Image<Rgba8>> get(std::size_t view) const;

private:
    [[nodiscard]] std::filesystem::path path_of(std::size_t view) const;
    std::filesystem::path folder_;
    int width_, height_;
};

}  // namespace rs::capture
