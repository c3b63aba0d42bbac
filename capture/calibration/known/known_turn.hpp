#pragma once
// What the readers of known_files.hpp share; private to them.

#include "capture/calibration/known/known_files.hpp"

#include <glm/glm.hpp>

#include <span>
#include <string>

namespace rs::capture {

// Pixels count as square within this share; f is the mean of both.
inline constexpr double kSquarePixels = 0.01;

// f from fx and fy, or an error that begins with `where`.
Result<double> common_focal_length(double fx_px, double fy_px, const std::string& where);

// Fills in pose, angles and sense.
Status set_turn(KnownInputs& known, std::span<const glm::dmat4> world_from_camera, const std::string& where);

}  // namespace rs::capture
