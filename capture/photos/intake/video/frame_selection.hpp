#pragma once
// Selects the frames of a turntable video to import: one turn, evenly spaced by angle, the sharpest near each angle.

#include "capture/photos/intake/video/frame_copy.hpp"
#include "capture/photos/intake/video/turn_period.hpp"
#include "rayspace/base/progress.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rs::capture {

/// Limits and default of FrameRequest::count for a film.
inline constexpr int kMinSelectedFrames = 36;
inline constexpr int kMaxSelectedFrames = 120;
inline constexpr int kDefaultSelectedFrames = 72;

struct FrameRequest {
    int count = kDefaultSelectedFrames;
    /// Skips blurred frames if the gap stays below 2.6 steps; fewer than `count` frames may be selected.
    bool may_skip_blurred = true;
};

struct FrameSelection {
    std::vector<std::size_t> frames;  // selected indices, ascending
    TurnRange turn;
    Image<std::uint8_t> moving;  // moving_region() of the video
    bool is_speed_measured = false;
};

/// Divides one turn into request.count steps of equal angle (turning_speed.hpp) and selects at most one frame per step.
/// Dynamic programming minimises the sum of two costs: blur, relative to the sharpest frame within 7.5 degrees, and
/// deviation from equal steps. Steps without any frame are skipped.
/// \param copies    make_frame_copy() of every frame in order, at least one, all of one size; normalize_exposure() is
///                  applied to them.
/// \param progress  May be null.
FrameSelection select_frames(std::vector<FrameCopy>& copies, const FrameRequest& request, Progress* progress);

/// Formats a note, e.g. "turn.mp4: 300 frames, one turn is frames 12..287, 60 chosen".
/// \param images  Unit: "frames" or "photos".
std::string selection_note(const std::string& name, const std::string& images, std::size_t count,
                           const FrameSelection& selection);

}  // namespace rs::capture
