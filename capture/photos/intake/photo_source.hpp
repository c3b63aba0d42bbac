#pragma once
// Input of an import: a folder of photos of one turn, a folder with more photos than needed, or a film.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace rs::capture {

/// Larger folders are reduced by select_frames() (video/frame_selection.hpp) by default.
inline constexpr std::size_t kMaxPhotosWithoutSelection = 150;

struct PhotoRequest {
    std::filesystem::path photos;  // folder or video
    std::filesystem::path output;  // extracted frames of a video are stored beside it during the import
    bool force = false;            // of StagedFolder, for the output
    int max_side_px = kMaxImageSide_px;
    std::optional<int> frames;  // number of photos or frames to select
    /// True if options describe single photos (masks, angles, steps), so that none may be left out.
    bool has_per_photo_options = false;
};

/// Returns true if `photos` is a regular file, which is read as a film.
bool is_video(const std::filesystem::path& photos);

/// Opens the photos to import: all photos of a folder of up to kMaxPhotosWithoutSelection, otherwise those selected by
/// select_frames(). Notes on the selection are in PhotoFolder::selection_notes.
/// Errors: those of open_photo_folder() and write_video_frames(); a video or a frame count together with per-photo
/// options.
Result<PhotoFolder> open_photos(const PhotoRequest& request, Progress* progress);

}  // namespace rs::capture
