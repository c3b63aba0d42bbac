#pragma once
// Assigns mask files of a folder to photos by name. Tools name masks in several ways; for the photo NAME.EXT these
// names are tried, in this order, each with the extensions in the order of kMaskExtensions:
//
//     1. NAME.EXT              the photo's own name
//     2. NAME.png              the photo's name with another extension
//     3. NAME.EXT.png          COLMAP, Meshroom
//     4. NAME_mask.png, NAME-mask.png, NAME.mask.png, mask_NAME.png
//
// Extensions and the word "mask" may be in either case; NAME must match exactly. Hidden files are ignored, and so is
// the photo itself where masks and photos lie in one folder.

#include "rayspace/base/result.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rs::capture {

/// Extensions of masks in order of preference: lossless formats first.
inline constexpr std::array<std::string_view, 14> kMaskExtensions = {".png",  ".tif",  ".tiff", ".bmp",  ".tga",
                                                                     ".ppm",  ".exr",  ".hdr",  ".webp", ".jpg",
                                                                     ".jpeg", ".heic", ".heif", ".avif"};

/// The files of a folder by their names.
class MaskNames {
public:
    /// Lists a folder. Fails where it cannot be read.
    static Result<MaskNames> list(const std::filesystem::path& folder);

    /// The masks of a photo, the preferred one first; empty if there are none. Thread-safe.
    [[nodiscard]] std::vector<std::filesystem::path> masks_of(const std::filesystem::path& photo) const;

private:
    // [name without extension, the word "mask" in lower case][index in kMaskExtensions]
    std::map<std::string, std::map<std::size_t, std::filesystem::path>> files_;
};

}  // namespace rs::capture
