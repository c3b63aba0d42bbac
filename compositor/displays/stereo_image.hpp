#pragma once
// Two images, one for each eye, as one. Pure; thread-safe.

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

// Both of one size; `form` is one that makes one image. Side by side and top and bottom are of full size, left first;
// an anaglyph for red and cyan glasses has the left one's red and the right one's green and blue.
Image<Rgba8> stereo_image(StereoForm form, const Image<Rgba8>& left, const Image<Rgba8>& right);

// Copies `tile` into `whole` at (x, y), where it must fit.
void paste(const Image<Rgba8>& tile, Image<Rgba8>& whole, int x, int y);

}  // namespace rs::compositor
