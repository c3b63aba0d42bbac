#pragma once
/// \file
/// Reads a photo of a folder in the working size of the import: upright, downscaled to the requested size.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>

namespace rs::capture {

/// Rotates and mirrors stored pixels by the EXIF orientation, 1..8.
Image<Rgba8> apply_orientation(Image<Rgba8> stored, int orientation);

/// Downscales an upright photo, or a mask of it, from folder.shown_width x folder.shown_height px to folder.width x
/// folder.height px.
Image<Rgba8> to_working_size(Image<Rgba8> upright, const PhotoFolder& folder);

/// Photo i of the folder, folder.width x folder.height px. Peak memory: twice the file's pixels at 4 bytes each.
/// Thread-safe. Errors: those of read_image(), and a file whose size has changed since the folder was opened.
Result<Image<Rgba8>> read_photo(const PhotoFolder& folder, std::size_t i);

}  // namespace rs::capture
