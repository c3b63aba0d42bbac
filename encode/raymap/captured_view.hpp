#pragma once
// Converts a floating-point camera to the integers of a CapturedView (rayspace/object/ray_space_object.hpp).

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cmath>
#include <cstdint>

namespace rs::encode {

/// Rounds to fixed point: the nearest multiple of 2^-fractional_bits, as a whole number of them. The value must fit.
/// Thread-safe.
inline std::int32_t fixed_point(double value, int fractional_bits) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, fractional_bits)));
}

/// Converts an upright camera. With C its centre, r and f its right and forward vectors and t a plane's tangent, the
/// plane point x t is seen at axial depth l = -C.f + x (t.f) in column cx + fl_x (-C.r + x (t.r)) / l. \param camera
/// upright and in object radii, between 1.2 and 200 from the Y axis. \return an error where a number is out of the
/// format's range (encode/FORMAT.md, "Ranges"), such as a focal length of
///     16384 px or a principal axis very far from the Y axis.
Result<CapturedView> captured_view(const Camera& camera, int planes);

/// The projection of a reference plane's points into an upright camera in object radii (encode/FORMAT.md).
NormalLine normal_line(const Camera& camera, const ReferencePlane& plane);

}  // namespace rs::encode
