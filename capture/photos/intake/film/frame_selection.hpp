#pragma once
// Which frames of a film of a turntable are taken: one turn, evenly by angle, the sharpest near each angle.

#include "capture/photos/intake/film/frame_copy.hpp"
#include "capture/photos/intake/film/turn_period.hpp"
#include "rayspace/base/progress.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rs::capture {

/// Fewest and most frames that can be asked for, and what is chosen without being asked.
inline constexpr int kFewestFrames = 36;
inline constexpr int kMostFrames = 120;
inline constexpr int kDefaultFrames = 72;

struct FrameRequest {
    int count = kDefaultFrames;
    /// Blurred frames are left out where the step stays below 2.6 steps, so that fewer than `count` may be chosen.
    bool may_skip_blurred = true;
};

struct FrameSelection {
    std::vector<std::size_t> frames;  // chosen ones, ascending
    TurnRange turn;
    Image<std::uint8_t> moving;  // moving_region() of the film
    bool is_speed_measured = false;
};

/// The range of one turn is divided into request.count steps of equal angle (turning_speed.hpp), and at most one frame
/// is taken from around each. Dynamic programming weighs the sharpness of frames, relative to the sharpest within 7.5
/// degrees, against even steps. Steps without any frame are skipped.
/// \param copies  make_frame_copy() of every frame in order, at least one, all of one size; their exposure is evened
/// out.
FrameSelection select_frames(std::vector<FrameCopy>& copies, const FrameRequest& request, Progress* progress);

/// "turn.mp4: 300 frames, one turn is frames 12..287, 60 chosen".
/// \param images  What is counted: "frames" or "photos".
std::string selection_note(const std::string& name, const std::string& images, std::size_t count,
                           const FrameSelection& selection);

}  // namespace rs::capture
