#pragma once
// Plausibility check of a file's ICC profile before OpenImageIO reads it, since version 2.4 reads texts at any offset
// stated in a profile's tag table, even beyond its end. Part of librayspace_image_io.so.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rs::image_io {

/// Checks the profiles of JPEG (APP2 segments), PNG (iCCP), TIFF (tag 34675) and WebP (ICCP) files, as the libraries
/// used by OpenImageIO would read them. Files of other formats and files without a profile pass, except formats that
/// may contain a profile and are not needed: icons, Photoshop and JPEG 2000. Time is at most proportional to the file's
/// size; memory: at most 16 MB; larger profiles are rejected.
Status check_profile_integrity(const std::string& path);

/// Checks a profile: all tags, and the texts of tags, must be inside of it (ICC.1:2010, 7.3 and 10.13); at most 1000
/// tags with at most 1000 texts each. Data that is not a profile passes, since it is not read as one. Bytes after the
/// profile's stated size are ignored.
bool is_sound_profile(std::span<const unsigned char> icc);

}  // namespace rs::image_io
