#pragma once
// Integrity check of a PNG file before libpng reads it, since libpng writes messages to stderr, and some readers return
// truncated images. Part of librayspace_image_io.so.

#include "rayspace/base/result.hpp"

#include <string>

namespace rs::image_io {

/// Verifies the checksum of every chunk (PNG specification, section 5.3). Files of other formats pass. Reads the file
/// once, in small pieces.
Status check_png_integrity(const std::string& path);

}  // namespace rs::image_io
