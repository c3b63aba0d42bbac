#pragma once
// Whether an OpenEXR file's header can be true, found out before OpenEXR sees it: that reserves and clears what a
// header claims, 2 GB for a comment, before it looks whether the file has as much. Part of librayspace_image_io.so.

#include "rayspace/base/result.hpp"

#include <string>

namespace rs::image_io {

// Walks the attributes of all parts' headers (OpenEXR file layout, "Header Attributes"): no attribute, nor a text or
// preview inside of one, may be larger than the rest of the file, and no window larger than an image may be. Files
// that are no EXR pass: they are not for this function to judge. Reads the header once; memory: some hundred bytes.
Status check_exr_header(const std::string& path, int max_side_px);

}  // namespace rs::image_io
