#pragma once
/// \file
/// Finds the photo of each camera of a model. Tools name photos by paths of other machines, without folder, with
/// another extension or with none.

#include "capture/posed/cameras/posed_camera.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

/// A photo and its camera, whose size is that of the photo as displayed.
struct PosedPhoto {
    std::filesystem::path file;
    std::string name;  ///< of the file, relative to the folder of photos
    PosedCamera camera;
    /// EXIF orientation to apply to the stored pixels. 1, as COLMAP reads photos, unless only the rotated photo has the
    /// size that the camera states.
    int orientation = 1;
    bool has_alpha = false;
};

struct PhotoMatches {
    std::vector<PosedPhoto> photos;           ///< in natural order of their names
    std::vector<std::string> without_camera;  ///< photos beside them that the model does not have
    std::vector<std::string> without_photo;   ///< photos of the model that are not in the folder
};

/// Image files of a folder and its subfolders, relative to it, in natural order; hidden ones are skipped. Errors: a
/// folder that cannot be listed, or holds no image files or more than 100,000 files.
Result<std::vector<std::string>> list_photos(const std::filesystem::path& photos);

/// Compares names without extension and letter case, by the longest common end of their paths. Reads the headers of
/// the photos. `photos` is searched with its subfolders. Errors: a folder that cannot be listed or holds no image
/// files; no match; a name that fits several photos equally; a photo with two cameras; a photo whose size differs from
/// that of its camera.
Result<PhotoMatches> match_photos(const std::filesystem::path& photos, const PosedModel& model);

}  // namespace rs::capture
