#pragma once
// A wall that a visitor looks through as through a window: the camera of an eye before it. The geometry is that of
// R. Kooima, "Generalized Perspective Projection" (2009): axes along the wall's edges, the distance of the eye, and
// where the eye stands before the wall. Here that is an ordinary camera, whose principal point is off the middle.
//
//     wall in the room (metres) + eye in the room -> camera in the room -> RoomPlace -> camera in the scene
//
// Two eyes or two walls share nothing but this, so what two walls show of a point on their common edge meets there.
// Pure; thread-safe.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rs::compositor {

// Three corners of a rectangle as the visitor sees it, in metres; the room's Y is up.
struct Wall {
    std::string name;
    glm::dvec3 lower_left{0};
    glm::dvec3 lower_right{0};
    glm::dvec3 upper_left{0};
    int width = 0;  // px
    int height = 0;
};

// Fails where the corners make no rectangle (a right angle within 1e-6, sides of 1 mm at least), naming the wall.
Status check_wall(const Wall& wall);

// Where a visitor's head is in the room, metres. Heading 0 looks along -Z and grows to the left, pitch is up, roll
// leans to the right; applied in the order roll, pitch, heading.
struct Head {
    glm::dvec3 position{0, 1.7, 0};  // between the eyes
    double heading_rad = 0;
    double pitch_rad = 0;
    double roll_rad = 0;

    [[nodiscard]] glm::dvec3 right() const;  // unit vector
    // `offset_m` to the right of the middle.
    [[nodiscard]] glm::dvec3 eye(double offset_m) const { return position + offset_m * right(); }
};

// Where the room stands in the scene. It is never tilted: vertical walls stay vertical, for which engines draw objects
// fast.
struct RoomPlace {
    glm::dvec3 position{0};      // of the room's origin, scene units
    double heading_rad = 0;      // about Y, counter-clockwise seen from above
    double units_per_metre = 1;  // > 0

    [[nodiscard]] glm::dvec3 in_scene(const glm::dvec3& p_in_room) const;
    [[nodiscard]] glm::dvec3 turned(const glm::dvec3& direction_in_room) const;
};

// The room in which a visitor with this head sees what the camera sees: the head is at the camera's centre and its
// heading the camera's; the camera's pitch is left out.
RoomPlace place_of(const Camera& camera, const Head& head, double units_per_metre);

// An eye nearer to a wall's plane than this is taken to be in it, metres.
inline constexpr double kNearestEye_m = 1e-3;

// What the eye (in the room) sees through the wall. The wall has passed check_wall(). Fails where the eye is behind the
// wall or in its plane, naming it.
Result<Camera> wall_camera(const Wall& wall, const glm::dvec3& eye_in_room, const RoomPlace& place);

}  // namespace rs::compositor
