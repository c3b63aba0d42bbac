#pragma once
/// \file
/// Converts rigs of other tools to the conventions of capture sets: OpenGL's camera axes, and the Y axis as the axis of
/// the turntable. Structure from motion leaves the world's frame free, and Blender's Z is up.

#include "rayspace/geometry/rig.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace rs {

/// Top-level key of a rig: true if its cameras are not turntable rings.
inline constexpr const char* kPosedKey = "posed";

/// Axis of one turn of a turntable, in the frame of the rig.
struct TurnAxis {
    glm::dvec3 direction{0, 1, 0};  ///< unit vector, up in the photos
    glm::dvec3 point{0};            ///< of the axis, the nearest one to the origin
    double distance = 0;            ///< mean, of the cameras from the axis
    double aim_height = 0;          ///< mean, at which the optical axes pass the axis; along `direction` from `point`
};

/// Finds the axis about which a single camera, or the object before it, was turned: all cameras of the rig are the same
/// but for a rotation about it, within 2 degrees and 2 % of their distance, and all look towards it (or away from it,
/// if their axes are OpenCV's). Least squares over all cameras.
/// \return nullopt if the cameras are fewer than five, cover less than about 80 degrees, or are not one turn
std::optional<TurnAxis> find_turn_axis(const Rig& rig);

/// If the cameras are one turn, and its axis is more than 1 degree or 2 % of the cameras' distance away from the Y
/// axis, moves the frame so that it is the Y axis. Heights above the origin are kept, unless the cameras look past it
/// by more than their distance: then they look at Y = 0. Rigs with object_radius or foot_height, or with kPosedKey set,
/// refer to their own Y axis and are not changed. \return a description of the motion; empty if the rig was not changed
std::string align_turn_axis(Rig& rig);

/// Converts cameras with OpenCV's axes (Y down, Z forward; COLMAP) to OpenGL's, which transforms.json has: if all of
/// them look away from the Y axis and the converted ones towards it.
/// \return true if the cameras were converted
bool convert_opencv_axes(Rig& rig);

/// align_turn_axis() and convert_opencv_axes(). \return one message per conversion, without the name of the file
std::vector<std::string> apply_rig_conventions(Rig& rig);

}  // namespace rs
