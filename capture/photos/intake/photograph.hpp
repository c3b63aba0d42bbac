#pragma once
// One photograph of a folder as the import works with it: upright, and not larger than was asked for.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>

namespace rs::capture {

// What is to be shown of stored pixels: turned and mirrored as EXIF's orientation 1..8 states.
Image<Rgba8> shown_upright(Image<Rgba8> stored, int orientation);

// folder.width x folder.height pixels of what is shown of a photograph, or of a mask of it: folder.shown_width x
// folder.shown_height.
Image<Rgba8> in_working_size(Image<Rgba8> shown, const PhotoFolder& folder);

// Photograph i of the folder, folder.width x folder.height pixels. While they are turned or averaged the
// file's pixels are in memory twice, 4 bytes each. Errors: those of read_picture(), and a photograph that is of another
// size by now.
Result<Image<Rgba8>> read_photograph(const PhotoFolder& folder, std::size_t i);

}  // namespace rs::capture
