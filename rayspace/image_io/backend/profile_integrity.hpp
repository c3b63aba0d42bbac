#pragma once
// Whether a file's ICC profile can be true, found out before OpenImageIO sees it: version 2.4 takes texts out of a
// profile from wherever its table of tags points to, beyond its end too. Part of librayspace_image_io.so.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace rs::image_io {

// Looks at the profiles of JPEG (APP2 segments), PNG (iCCP), TIFF (tag 34675) and WebP (ICCP) files, as far as the
// libraries that OpenImageIO reads them with would. Files of other kinds and files without a profile pass, but for
// those kinds that could bring a profile and that nobody needs here: icons, Photoshop's and JPEG 2000. Time grows with
// the file's size at most; memory: at most 16 MB for a profile, and a profile that is larger is refused.
Status check_profile_integrity(const std::string& path);

// A profile alone: all tags, and the texts of tags, must lie inside of it (ICC.1:2010, 7.3 and 10.13); at most 1000
// tags of at most 1000 texts. What is no profile at all passes: it is not read as one. Bytes behind its stated size are
// not its.
bool is_sound_profile(std::span<const unsigned char> icc);

}  // namespace rs::image_io
