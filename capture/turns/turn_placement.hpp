#pragma once
/// \file
/// Placement of several turns of one object in a common frame. Each turn has its own calibration
/// (calibration/model/turntable_model.hpp), in whose table frame the unit of length is the camera's distance from the
/// axis. The common frame is the object frame of the first turn: Y along its axis, origin on the axis at the height of
/// its camera, that camera at distance 1.

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <cstddef>

namespace rs::capture {

/// Similarity from the common frame to the object frame of a turn (at angle 0): (rotation * p + offset) / distance.
struct TurnPlacement {
    glm::dmat3 rotation{1.0};
    glm::dvec3 offset{0.0};
    double distance = 1;  ///< of the turn's camera from its axis, in common units

    /// True if the turn's axis is that of the common frame: the object stands as in the reference turn. False if it was
    /// laid down otherwise.
    [[nodiscard]] bool is_upright() const { return rotation[1].y > 1 - 1e-9; }

    [[nodiscard]] glm::dvec3 turn_from_common(const glm::dvec3& p) const { return (rotation * p + offset) / distance; }
    [[nodiscard]] glm::dvec3 common_from_turn(const glm::dvec3& p) const {
        return glm::transpose(rotation) * (p * distance - offset);
    }
};

/// Placement of a turn about the axis of the first: at angle 0 the object is turned by `azimuth_rad` relative to the
/// first turn's angle 0, and the camera is `height` above the first camera.
TurnPlacement upright_placement(double azimuth_rad, double distance, double height);

struct PlacedTurn {
    TurntableModel model;
    TurnPlacement placement;
};

/// Camera position in terms that are well conditioned at all tilts.
struct CameraAim {
    double tilt_rad = 0;
    double slant = 1;  ///< distance along the viewing direction from a point of the axis at the height `middle`
    double shift = 0;  ///< of the camera along the image's up direction
};

/// Placement about the common axis of a camera with this aim at the point of the axis at height `middle`.
TurnPlacement aimed_placement(double azimuth_rad, const CameraAim& aim, double middle);

/// Inverse of aimed_placement() for a turn about the common axis.
CameraAim aim_of(const PlacedTurn& turn, double middle);

/// Rotation about Y that is nearest to the placement's rotation.
double azimuth_rad(const TurnPlacement& placement);

/// Pinhole camera of a view in the common frame, without the lens distortion.
Camera common_camera(const PlacedTurn& turn, std::size_t view);

/// Degrees between the axes of the turn and of the common frame, 0..180.
double axis_tilt_deg(const TurnPlacement& placement);

/// Degrees by which the camera is above (positive) the plane through `target`, a point of the common frame, that is
/// perpendicular to the turn's axis.
double elevation_deg(const PlacedTurn& turn, const glm::dvec3& target);

}  // namespace rs::capture
