#pragma once
// Combines the images of both eyes into one. Pure; thread-safe.

#include "rayspace/image/image.hpp"

#include <array>

namespace rs::compositor {

enum class StereoForm { kFolders, kSideBySide, kTopBottom, kAnaglyph };
struct NamedStereoForm {
    const char* name;
    StereoForm form;
};
inline constexpr std::array kStereoForms{
    NamedStereoForm{"folders", StereoForm::kFolders}, NamedStereoForm{"side-by-side", StereoForm::kSideBySide},
    NamedStereoForm{"top-bottom", StereoForm::kTopBottom}, NamedStereoForm{"anaglyph", StereoForm::kAnaglyph}};

/// Both images have the same size; `form` is not kFolders. Side-by-side and top-bottom images have full size, left eye
/// first; a red-cyan anaglyph takes red from the left eye, green and blue from the right.
Image<Rgba8> stereo_image(StereoForm form, const Image<Rgba8>& left, const Image<Rgba8>& right);

/// Copies `tile` into `whole` at (x, y), where it must fit.
void paste(const Image<Rgba8>& tile, Image<Rgba8>& whole, int x, int y);

}  // namespace rs::compositor
