#pragma once
/// \file
/// Folder with the photos of one turn: the files, their order, checks that they are consistent, and reading in the
/// working size of the import: upright, downscaled. First stage of an import (capture/photos/import.hpp).

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

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

/// True if `a` precedes `b` in natural order: runs of digits compare as numbers of any length ("view2" before "view10",
/// "007" after "6"), letters without regard to ASCII case. A total order: names that compare equal ("1", "01") are
/// compared by their bytes.
bool natural_less(std::string_view a, std::string_view b);

/// Sorts by natural_less(), and signed angles by value: if some names have a minus before their first number and others
/// do not ("-10" ... "0" ... "10"), those with a minus come first, in descending order of the number.
void sort_photos(std::vector<std::filesystem::path>& photos);

/// True if the name has the extension of an image file: .png .jpg .jpeg .tif .tiff .webp .heic .heif .avif .bmp .exr
/// .hdr .tga .ppm, in any case.
bool is_image_name(const std::filesystem::path& name);

/// Photos of one turn. Photos are displayed in the size shown_width x shown_height, after the EXIF orientation is
/// applied. read_photo() returns images in the working size, width x height.
struct PhotoFolder {
    std::vector<std::filesystem::path> photos;  ///< full paths, in natural order of their file names
    std::vector<std::string> ignored;           ///< names of other entries, also folders; without hidden ones
    /// Skipped files: photos that the folder also holds in another format under the same name. The most frequent
    /// format is used, JPEG in a tie.
    std::vector<std::string> in_other_formats;
    /// EXIF orientation of the stored pixels (ImageInfo::orientation), the same for all photos because the camera is
    /// fixed. If files differ, it is the most frequent one: a camera that looks down cannot sense its orientation.
    int orientation = 1;
    int other_orientation_count = 0;  ///< number of files with another orientation
    /// [photo]: set if some photos are stored on their side and others upright, as an editor saves them. Each is the
    /// most frequent orientation of the photos stored in the same size, and other_orientation_count counts the files
    /// that differ from it. Empty: `orientation` applies to all.
    std::vector<int> own_orientations;
    int shown_width = 0;     ///< px, of all photos as displayed
    int shown_height = 0;    ///< px
    double reduction = 1;    ///< displayed pixels per pixel of the working size
    int width = 0;           ///< px, working size: the images of read_photo(), centred in the displayed photo
    int height = 0;          ///< px
    bool has_alpha = false;  ///< all files have an alpha channel
    int focal_35mm = 0;      ///< EXIF, mm; 0 if unknown or not the same for all photos
    std::vector<std::string> selection_notes;  ///< on the selection of photos (photo_source.hpp)
    /// Folder of extracted video frames; deleted with the last copy of this object. Null for photos.
    std::shared_ptr<const StagedFolder> temporary;

    /// EXIF orientation that is applied to a photo.
    [[nodiscard]] int orientation_of(std::size_t photo) const {
        return own_orientations.empty() ? orientation : own_orientations[photo];
    }
    /// Converts a point of the displayed photo, in px, to px of the image in working size.
    [[nodiscard]] glm::dvec2 in_image(const glm::dvec2& shown_px) const {
        const glm::dvec2 shown(shown_width, shown_height), image(width, height);
        return 0.5 * image + (shown_px - 0.5 * shown) / reduction;
    }
    /// True if the files differ in their EXIF orientation.
    [[nodiscard]] bool has_several_orientations() const {
        return other_orientation_count > 0 || !own_orientations.empty();
    }
    /// True if it is ambiguous whether the size of a mask or a camera refers to the stored pixels or to the displayed
    /// photo.
    [[nodiscard]] bool has_ambiguous_orientation() const {
        return has_several_orientations() || (orientation != 1 && (orientation < 5 || shown_width == shown_height));
    }
};

/// Text of a size: "4000x3000".
std::string size_text(int width, int height);

/// Error for photos with has_ambiguous_orientation() that come with `other`, a file that refers to pixels: it may refer
/// to the stored or the displayed ones.
Error ambiguous_orientation_error(const PhotoFolder& folder, const std::string& other);

/// File names of the photos, without the folder.
std::vector<std::string> file_names(const PhotoFolder& folder);

/// Minimum of max_side_px in open_photo_folder().
inline constexpr int kMinSide_px = 64;

/// Lists the folder and reads the headers of the image files, not their pixels. The working size of large photos is
/// reduced to max_side_px (kMinSide_px .. kMaxImageSide_px) on the longer side (photo_reduction()); a side of a
/// thin photo keeps at least one pixel. Errors: a folder that cannot be listed; no image files, or more than kMaxViews;
/// an unreadable header; a side longer than kMaxPhotoSide_px; two sizes that differ after EXIF orientation (the
/// message has both files and sizes).
Result<PhotoFolder> open_photo_folder(const std::filesystem::path& folder, int max_side_px = kMaxImageSide_px);

/// The same for the given files, in the given order. `where` is named in messages.
Result<PhotoFolder> open_photo_files(std::vector<std::filesystem::path> photos, const std::string& where,
                                     int max_side_px = kMaxImageSide_px);

/// Sets the working size of a folder with a given shown size, as open_photo_folder() does.
void set_working_size(PhotoFolder& folder, int max_side_px);

/// Rotates and mirrors stored pixels by the EXIF orientation, 1..8.
Image<Rgba8> apply_orientation(Image<Rgba8> stored, int orientation);

/// Downscales an upright photo, or a mask of it, from folder.shown_width x folder.shown_height px to folder.width x
/// folder.height px.
Image<Rgba8> to_working_size(Image<Rgba8> upright, const PhotoFolder& folder);

/// Photo i of the folder, folder.width x folder.height px. Peak memory: twice the file's pixels at 4 bytes each.
/// Thread-safe. Errors: those of read_image(), and a file whose size has changed since the folder was opened.
Result<Image<Rgba8>> read_photo(const PhotoFolder& folder, std::size_t i);

}  // namespace rs::capture
