#pragma once
// The cut-outs of a turn on their way between the stages of an import: files of one process, quick to write and to read
// again, that are gone when it ends.

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <filesystem>

namespace rs::capture {

class CutPictures {
public:
    // `folder` exists; whoever made it removes it. All pictures have one size.
    CutPictures(std::filesystem::path folder, int width, int height);

    // Thread-safe for different views. Errors: the disk.
    [[nodiscard]] Status put(std::size_t view, ConstImageView<Rgba8> picture) const;
    [[nodiscard]] Result<Image<Rgba8>> get(std::size_t view) const;

private:
    [[nodiscard]] std::filesystem::path file_of(std::size_t view) const;
    std::filesystem::path folder_;
    int width_, height_;
};

}  // namespace rs::capture
