#pragma once
// Conventions of Rayspace, to which all other headers refer.
//
// Object frame      Right-handed, Y up. The turntable's axis is the Y axis through the origin. Capture sets are
//                   scaled freely; inside a ray-space object the unit of length is the *object radius*, the radius of
//                   the bounding cylinder about Y (see Rig::object_radius).
// Camera frame      OpenGL axes: +X right, +Y up, the viewing direction is -Z. `world_from_camera` takes camera
//                   coordinates to object coordinates; it is the `transform_matrix` of a NeRF transforms.json.
// Pixels            Origin at the top left, x to the right, y down, pixel *centres* at +0.5. A principal point of
//                   (w/2, h/2) is the middle of the image.
// Colour            8-bit images are sRGB with straight (unassociated) alpha. Float images are linear-light with
//                   the sRGB primaries. Alpha is linear coverage. Where colours are averaged they are weighted by
//                   alpha.
// YUV               BT.601 full range ("JPEG"), U and V centred on 128. Integer formulas: engine/RECONSTRUCTION.md.
// Depth             Axial depth: distance along the camera's viewing axis, in the units of the rig; 0: no surface.
// Files             Little-endian. Text is UTF-8. Writers use a temporary name and rename.
// Reference planes  Plane k of K contains the Y axis. Normal n_k = (sin t, 0, cos t), tangent t_k = (cos t, 0, -sin t),
//                   t = 2*pi*k/K. See ray_space.hpp.

#include <cstdint>

namespace rs {

inline constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) {
    return degrees * (kPi / 180.0);
}
constexpr double degrees(double radians) {
    return radians * (180.0 / kPi);
}

/// Largest sizes accepted by all readers; larger ones are rejected with a message that states the limit.
inline constexpr int kMaxImageSide_px = 8192;
inline constexpr int kMaxViews = 4096;
inline constexpr int kMinPlanes = 3;
inline constexpr int kMaxPlanes = 64;
inline constexpr int kMaxMapSide = 4096;
inline constexpr int kMaxRings = 64;

}  // namespace rs
