#pragma once
// Writes selected frames of a turntable video to a folder of photos, the input of the other import stages.

#include "capture/photos/intake/video/frame_selection.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

/// Limit on the frames of a video; each takes 25 to 45 KB (FrameCopy).
inline constexpr int kMaxVideoFrames = 6000;

struct VideoFrames {
    FrameSelection selection;
    std::vector<std::string> notes;  // for the user, one line each
};

/// Decodes the video twice (VideoReader): once to select frames, once to write them to `folder` as frame-NNNNN.png,
/// upright; NNNNN is the frame number in the video, from 1.
///
/// If static background is visible, the exposure of written frames is normalised: each channel is divided by its median
/// ratio to the mean of the video (exposure_gain()), in linear light.
///
/// Memory: 45 KB per frame of the video, plus that of VideoReader. Errors: those of VideoReader and write_png(), more
/// than kMaxVideoFrames frames, a video without motion.
Result<VideoFrames> write_video_frames(const std::filesystem::path& video, const std::filesystem::path& folder,
                                       const FrameRequest& request, Progress* progress);

}  // namespace rs::capture
