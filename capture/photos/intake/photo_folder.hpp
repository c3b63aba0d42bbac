#pragma once
// The pictures of one turn, as they lie in a folder: which files they are, in which order, and whether they fit
// together. The import begins with it (capture/photos/import.hpp).

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rs {
class StagedFolder;
}

namespace rs::capture {

// True where `a` comes before `b` as people count: runs of digits compare as numbers of any length ("view2" before
// "view10", "007" after "6"), letters without regard to ASCII case. A total order: names that count alike ("1", "01")
// fall back to comparing their bytes.
bool natural_less(std::string_view a, std::string_view b);

// True where the name ends like a picture: .png .jpg .jpeg .tif .tiff .webp .heic .heif .avif .bmp .exr .hdr .tga .ppm,
// in any case.
bool is_picture_name(const std::filesystem::path& name);

struct PhotoFolder {
    std::vector<std::filesystem::path> photos;  // full paths, in natural order of their file names
    std::vector<std::string> ignored;           // names of other entries (folders too), hidden ones left out
    // Of pictures that lie in the folder in another format, too, under the same name: that which most pictures have is
    // taken, JPEG where as many have it, and these are left aside.
    std::vector<std::string> in_other_formats;
    // EXIF: how the files' pixels are turned to be shown (PictureInfo::orientation), one for all, as the camera stands
    // still. Where files differ it is what most of them state: a camera that looks down does not know its own.
    int orientation = 1;
    int otherwise_turned = 0;  // files that state another one
    // [photograph]: where some are stored on their side and some upright, as an editor saves them: what most of those
    // stored like it state, and the above counts those that state another. Empty: `orientation` holds for all.
    std::vector<int> own_orientations;
    int shown_width = 0;  // px, of every photograph as it is shown
    int shown_height = 0;
    double reduction = 1;  // shown pixels per pixel of the pictures that read_photograph() gives, of ...
    int width = 0;         // ... so many pixels, the middle of what is shown
    int height = 0;
    bool has_alpha = false;                    // of every picture
    int focal_35mm = 0;                        // EXIF, mm; 0 where it is not one for all, or unknown
    std::vector<std::string> selection_notes;  // on the selection of photos (photo_source.hpp)
    // Folder of extracted film frames; deleted with the last copy of this object. Null for photos.
    std::shared_ptr<const StagedFolder> temporary;

    [[nodiscard]] int orientation_of(std::size_t photograph) const {
        return own_orientations.empty() ? orientation : own_orientations[photograph];
    }
    // Where a point of a photograph as it is shown, in px, lies in its picture.
    [[nodiscard]] glm::dvec2 in_picture(const glm::dvec2& shown_px) const {
        const glm::dvec2 shown(shown_width, shown_height), picture(width, height);
        return 0.5 * picture + (shown_px - 0.5 * shown) / reduction;
    }
    [[nodiscard]] bool states_several() const { return otherwise_turned > 0 || !own_orientations.empty(); }
    // True if nobody can tell by its size if a mask or a camera is of the files' pixels or of what is shown.
    [[nodiscard]] bool turns_unnoticed() const {
        return states_several() || (orientation != 1 && (orientation < 5 || shown_width == shown_height));
    }
};

// "4000x3000".
std::string size_text(int width, int height);

// What is the matter where such photographs come with `other`, which is for pixels.
Error turned_beside(const PhotoFolder& folder, const std::string& other);

// [photograph], without the folder.
std::vector<std::string> file_names(const PhotoFolder& folder);

// The least that photographs are made smaller to.
inline constexpr int kMinSide_px = 64;

// Lists the folder and reads the pictures' headers. Large photographs are to be read with max_side_px
// (kMinSide_px .. kMaxPictureSide_px) for the longer side (photograph_reduction()). Fails where there are no pictures
// or more than kMaxViews, where a header cannot be read, where a side is longer than kMaxPhotographSide_px, and where
// two sizes differ, turned as EXIF states (naming both files and sizes). What is left of a thin photograph that is made
// smaller is a pixel at least. Pixels are not looked at.
Result<PhotoFolder> open_photo_folder(const std::filesystem::path& folder, int max_side_px = kMaxPictureSide_px);

}  // namespace rs::capture
