#pragma once
// Plausibility checks of image files before third-party libraries read them. Part of librayspace_image_io.so. Files of
// other formats pass all checks.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rs::image_io {

/// Checks the attributes of all parts' headers of an OpenEXR file (OpenEXR file layout, "Header Attributes"): no
/// attribute, and no text or preview inside of one, may be larger than the rest of the file, and no window larger than
/// max_side_px. OpenEXR itself allocates and clears the stated sizes (such as 2 GB for a comment) before it checks the
/// file's size. Reads the header once; memory: a few hundred bytes.
Status check_exr_header(const std::string& path, int max_side_px);

/// Verifies the checksum of every chunk of a PNG file (PNG specification, section 5.3), since libpng writes messages to
/// stderr, and some readers return truncated images. Reads the file once, in small pieces.
Status check_png_integrity(const std::string& path);

/// Checks the ICC profiles of JPEG (APP2 segments), PNG (iCCP), TIFF (tag 34675) and WebP (ICCP) files, as the
/// libraries used by OpenImageIO would read them. OpenImageIO 2.4 reads texts at any offset stated in a profile's tag
/// table, even beyond its end. Files without a profile pass. Formats that may contain a profile and are not needed are
/// rejected: icons, Photoshop and JPEG 2000. Time is at most proportional to the file's size; memory: at most 16 MB;
/// larger profiles are rejected.
Status check_profile_integrity(const std::string& path);

/// Checks a profile: all tags, and the texts of tags, must be inside of it (ICC.1:2010, 7.3 and 10.13); at most 1000
/// tags with at most 1000 texts each. Data that is not a profile passes, since it is not read as one. Bytes after the
/// profile's stated size are ignored.
bool is_valid_profile(std::span<const unsigned char> icc);

}  // namespace rs::image_io
