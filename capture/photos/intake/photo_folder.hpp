#pragma once
// The pictures of one turn, as they lie in a folder: which files they are, in which order, and whether they fit
// together. The import begins with it (capture/photos/import.hpp).

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rs::capture {

// True where `a` comes before `b` as people count: runs of digits compare as numbers of any length ("view2" before
// "view10", "007" after "6"), letters without regard to ASCII case. A total order: names that count alike ("1", "01")
// fall back to comparing their bytes.
bool natural_less(std::string_view a, std::string_view b);

// True where the name ends like a picture: .png .jpg .jpeg .tif .tiff .webp .bmp .exr .hdr .tga .ppm, in any case.
bool is_picture_name(const std::filesystem::path& name);

struct PhotoFolder {
    std::vector<std::filesystem::path> photos;  // full paths, in natural order of their file names
    std::vector<std::string> ignored;           // names of other entries (folders too), hidden ones left out
    int width = 0;                              // px, of every picture
    int height = 0;
    bool has_alpha = false;  // of every picture
};

// [photograph], without the folder.
std::vector<std::string> file_names(const PhotoFolder& folder);

// Lists the folder and reads the pictures' headers. Fails where there are no pictures or more than kMaxViews, where a
// header cannot be read, where one is to be shown turned (EXIF orientation other than 1), and where two sizes
// differ (naming both files and sizes). Pixels are not looked at.
Result<PhotoFolder> open_photo_folder(const std::filesystem::path& folder);

}  // namespace rs::capture
