#pragma once
// Display wall as a window into the scene: off-axis camera of an eye in front of it. Geometry: R. Kooima, "Generalized
// Perspective Projection" (2009): axes along the wall's edges, distance of the eye, and its foot point on the wall. The
// result is an ordinary camera with an off-centre principal point.
//
//     wall in the room (metres) + eye in the room -> camera in the room -> RoomPose -> camera in the scene
//
// Walls and eyes are independent, so that images of adjacent walls join at their common edge. Pure; thread-safe.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rs::compositor {

/// Rectangle given by three corners as seen by the visitor, in metres; the room's Y is up.
struct Wall {
    std::string name;
    glm::dvec3 lower_left{0};
    glm::dvec3 lower_right{0};
    glm::dvec3 upper_left{0};
    int width = 0;  // px
    int height = 0;
};

/// Fails unless the corners form a rectangle (right angle within 1e-6, sides of at least 1 mm); the error names the
/// wall.
Status check_wall(const Wall& wall);

/// Head pose in the room, metres. Heading 0 is -Z, increasing to the left; pitch upwards, roll to the right; applied in
/// the order roll, pitch, heading.
struct Head {
    glm::dvec3 position{0, 1.7, 0};  // between the eyes
    double heading_rad = 0;
    double pitch_rad = 0;
    double roll_rad = 0;

    [[nodiscard]] glm::dvec3 right() const;  // unit vector
    /// Position of an eye, `offset_m` to the right of the centre.
    [[nodiscard]] glm::dvec3 eye(double offset_m) const { return position + offset_m * right(); }
};

/// Pose of the room in the scene. The room is never tilted: vertical walls stay vertical, for which engines render
/// fast.
struct RoomPose {
    glm::dvec3 position{0};      // of the room's origin, scene units
    double heading_rad = 0;      // about Y, counter-clockwise seen from above
    double units_per_metre = 1;  // > 0

    [[nodiscard]] glm::dvec3 in_scene(const glm::dvec3& p_in_room) const;
    [[nodiscard]] glm::dvec3 turned(const glm::dvec3& direction_in_room) const;
};

/// Room pose in which this head sees what the camera sees: same position and heading; the camera's pitch is ignored.
RoomPose place_of(const Camera& camera, const Head& head, double units_per_metre);

/// Eyes nearer to a wall's plane count as in the plane, metres.
inline constexpr double kMinEyeDistance_m = 1e-3;

/// Camera of an eye (room coordinates) through a wall that passed check_wall(). Fails if the eye is behind the wall or
/// in its plane; the error names the wall.
Result<Camera> wall_camera(const Wall& wall, const glm::dvec3& eye_in_room, const RoomPose& place);

}  // namespace rs::compositor
