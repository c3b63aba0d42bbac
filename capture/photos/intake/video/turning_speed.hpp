#pragma once
// Estimates the angular speed of the turntable in each frame of a video, up to a constant factor.
//
// A point at (x, y, z) of an object that turns by w per frame about the vertical axis moves by w z in image x and, for
// a camera that looks down by the angle e, by w x sin(e) in image y. So vertical motion grows linearly from the axis to
// both sides for any object shape, and its slope is the speed up to a factor. Horizontal motion depends on the shape.
// Each pair of frames gives the slope by a robust linear regression over the motion of corners (pyramidal
// Lucas-Kanade).
//
// A camera at the height of the object sees no such motion. Then the speed is modelled as an exponential function of
// time, fitted to the magnitude of motion.

#include "capture/photos/intake/video/frame_copy.hpp"
#include "rayspace/base/progress.hpp"

#include <cstdint>
#include <vector>

namespace rs::capture {

struct TurningSpeed {
    std::vector<double> per_frame;  // angle from each frame to the next, arbitrary unit; 0 without rotation
    bool is_measured = false;       // from vertical motion; otherwise from the trend
};

/// \param copies  At least one, all of one size, normalize_exposure() applied.
/// \param region  moving_region() of the copies.
TurningSpeed turning_speed(const std::vector<FrameCopy>& copies, const Image<std::uint8_t>& region, Progress* progress);

}  // namespace rs::capture
