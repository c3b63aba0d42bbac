#pragma once
// Position and normal of the visible surface at a pixel, from the depths around it. Pure; thread-safe.
//
// On a plane 1 / depth is linear in the pixel's position: with n . P = 1 in camera coordinates, 1 / depth =
// n . ((x - cx) / fl_x, (cy - y) / fl_y, 1), so two differences between neighbours give the normal exactly.

#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace rs::compositor {

struct SurfacePoint {
    glm::dvec3 place{0};
    glm::dvec3 normal{0, 1, 0};  // unit length, towards the camera
};

// 1 / axial depth of the 5x5 pixels around the central one, rows from the top, 0 for the background.
inline constexpr int kDepthsAcross = 5;
using DepthsAround = std::array<double, kDepthsAcross * kDepthsAcross>;

/// Surface at the centre of pixel (x, y); empty for the background. Per axis, the side with the smaller second
/// difference is used, so that depth edges do not affect the normal.
std::optional<SurfacePoint> surface_from_depths(const Camera& camera, int x, int y, const DepthsAround& inverse_depths);

}  // namespace rs::compositor
