#pragma once
// Whether a PNG file arrived whole, found out before libpng sees it: libpng writes its complaints to stderr, and some
// readers give out what they have of a picture that is cut short. Part of librayspace_pictures.so.

#include "rayspace/base/result.hpp"

#include <string>

namespace rs::pictures {

// Walks the chunks and verifies each one's checksum (PNG specification, section 5.3). Files that are no PNG pass: they
// are not for this function to judge. Reads the file once, in small pieces.
Status check_png_integrity(const std::string& path);

}  // namespace rs::pictures
