#pragma once
// Whether a PNG file arrived whole, found out before libpng sees it: libpng writes its complaints to stderr, and some
// readers give out what they have of an image that is cut short. Part of librayspace_image_io.so.

#include "rayspace/base/result.hpp"

#include <string>

namespace rs::image_io {

// Walks the chunks and verifies each one's checksum (PNG specification, section 5.3). Files that are no PNG pass: they
// are not for this function to judge. Reads the file once, in small pieces.
Status check_png_integrity(const std::string& path);

}  // namespace rs::image_io
