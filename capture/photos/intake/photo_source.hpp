#pragma once
// What an import is given: a folder of photos of one turn, a folder with more photos than needed, or a film.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace rs::capture {

/// Folders with more photos than this go through select_frames() (film/frame_selection.hpp) unasked.
inline constexpr std::size_t kMostUnselectedPhotos = 150;

struct PhotoRequest {
    std::filesystem::path photos;  // folder, or film
    std::filesystem::path output;  // beside which frames of a film are kept while they are needed
    int max_side_px = kMaxPictureSide_px;
    std::optional<int> frames;  // how many to choose
    // Options that describe each photo (masks, angles, steps) forbid a selection.
    bool are_photos_described = false;
};

/// Whether `photos` is a file, and therefore taken as a film.
bool is_film(const std::filesystem::path& photos);

/// The photos to import: all of a folder of up to kMostUnselectedPhotos, else those that select_frames() chooses.
/// Notes on a selection are in PhotoFolder::selection_notes.
/// Errors: those of open_photo_folder() and write_film_frames(); a film, or a count of frames, with photos that are
/// described.
Result<PhotoFolder> open_photos(const PhotoRequest& request, Progress* progress);

}  // namespace rs::capture
