#pragma once
// Whether a file's ICC profile can be true, found out before OpenImageIO sees it: version 2.4 takes texts out of a
// profile from wherever its table of tags points to, beyond its end too. Part of librayspace_pictures.so.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rs::pictures {

// Looks for the profile of JPEG (APP2 segments), PNG (iCCP), TIFF, WebP, PSD and JPEG 2000 files; in the last four by
// the mark that every profile has. All tags, and the texts of tags, must lie inside of it (ICC.1:2010, 7.3 and
// 10.13). Files of other kinds, and without a profile, pass. Memory: the profile's, at most 16 MB.
Status check_profile_integrity(const std::string& path);

// The same of a profile alone. What is no profile at all passes: it is not read as one.
bool is_sound_profile(std::span<const unsigned char> icc);

}  // namespace rs::pictures
