#pragma once
// Plausibility check of an OpenEXR header before OpenEXR reads it, since OpenEXR allocates and clears the stated sizes
// (such as 2 GB for a comment) before it checks the file's size. Part of librayspace_image_io.so.

#include "rayspace/base/result.hpp"

#include <string>

namespace rs::image_io {

/// Checks the attributes of all parts' headers (OpenEXR file layout, "Header Attributes"): no attribute, and no text or
/// preview inside of one, may be larger than the rest of the file, and no window larger than max_side_px. Files of
/// other formats pass. Reads the header once; memory: a few hundred bytes.
Status check_exr_header(const std::string& path, int max_side_px);

}  // namespace rs::image_io
