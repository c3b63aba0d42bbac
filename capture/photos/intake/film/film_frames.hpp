#pragma once
// Chosen frames of a film of a turntable as a folder of photos, which the rest of an import reads like any other.

#include "capture/photos/intake/film/frame_selection.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

/// Frames in a film at most; FrameCopy takes 25 to 45 KB for each.
inline constexpr int kMostFilmFrames = 6000;

struct FilmFrames {
    FrameSelection selection;
    std::vector<std::string> notes;  // one line each: what was chosen, and what the user should know
};

/// Decodes the film twice (VideoReader): once to choose frames, once to write them to `folder` as frame-NNNNN.png,
/// upright, NNNNN counting the film's frames from 1.
///
/// Where the background is visible and static, the exposure of written frames is evened out: each channel is divided by
/// its median ratio to the mean of the film (exposure_gain()), in linear light.
///
/// Memory: 45 KB per frame of the film, and what VideoReader takes. Errors: those of VideoReader and write_png(), more
/// than kMostFilmFrames frames, a film in which nothing moves.
Result<FilmFrames> write_film_frames(const std::filesystem::path& film, const std::filesystem::path& folder,
                                     const FrameRequest& request, Progress* progress);

}  // namespace rs::capture
