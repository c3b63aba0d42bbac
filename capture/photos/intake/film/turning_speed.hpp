#pragma once
// How fast the turntable turns in each frame of a film, up to a factor.
//
// A point at (x, y, z) of an object that turns by w per frame about the vertical axis moves by w z in image x and, for
// a camera that looks down by the angle e, by w x sin(e) in image y. So vertical motion grows linearly from the axis to
// both sides, whatever the shape of the object, and its slope is the speed up to a factor; horizontal motion depends on
// the shape. Each pair of frames gives the slope by a robust linear regression over the motion of corners
// (pyramidal Lucas-Kanade).
//
// A camera at the height of the object shows no such motion. Then only the trend of the amount of motion over the film
// is used: a speed that changes exponentially.

#include "capture/photos/intake/film/frame_copy.hpp"
#include "rayspace/base/progress.hpp"

#include <cstdint>
#include <vector>

namespace rs::capture {

struct TurningSpeed {
    std::vector<double> per_frame;  // [frame]: angle from it to the next frame, of no unit; 0 where nothing turns
    bool is_measured = false;       // from vertical motion; else from the trend
};

/// \param copies  At least one, all of one size, normalize_exposure() applied.
/// \param region  moving_region() of the copies.
TurningSpeed turning_speed(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region, Progress* progress);

}  // namespace rs::capture
