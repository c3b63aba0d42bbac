#include "compositor/displays/wall.hpp"

#include "rayspace/api/types/check.hpp"

#include <cmath>
#include <cstdio>

namespace rs::compositor {
namespace {

constexpr double kMinSide_m = 1e-3;
constexpr double kMaxSkew = 1e-6;  // cosine of the angle between the sides

std::string metres(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g m", length);
    return text;
}

}  // namespace

Status check_wall(const Wall& wall) {
    const glm::dvec3 across = wall.lower_right - wall.lower_left;
    const glm::dvec3 along = wall.upper_left - wall.lower_left;
    const std::string name = "wall '" + wall.name + "'";
    if (!(glm::length(across) >= kMinSide_m) || !(glm::length(along) >= kMinSide_m)) {
        return Error{name + " has a side of less than 1 mm; give its corners in metres"};
    }
    const double skew = std::abs(glm::dot(glm::normalize(across), glm::normalize(along)));
    if (!(skew <= kMaxSkew)) {
        return Error{name + " has no right angle at lower_left; its corners must make a rectangle"};
    }
    return {};
}

glm::dvec3 Head::right() const {
    const double sin_h = std::sin(heading_rad), cos_h = std::cos(heading_rad);
    const double sin_p = std::sin(pitch_rad);
    const glm::dvec3 level(cos_h, 0, -sin_h);
    // Up vector of a head that is pitched but not rolled.
    const glm::dvec3 up(sin_h * sin_p, std::cos(pitch_rad), cos_h * sin_p);
    return std::cos(roll_rad) * level - std::sin(roll_rad) * up;
}

glm::dvec3 RoomPose::turned(const glm::dvec3& v) const {
    const double s = std::sin(heading_rad), c = std::cos(heading_rad);
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

glm::dvec3 RoomPose::in_scene(const glm::dvec3& p_in_room) const {
    return position + units_per_metre * turned(p_in_room);
}

RoomPose place_of(const Camera& camera, const Head& head, double units_per_metre) {
    // A camera looking straight up or down has its heading from its up vector.
    glm::dvec3 ahead = camera.forward();
    if (std::hypot(ahead.x, ahead.z) < 1e-6) ahead = ahead.y < 0 ? camera.up() : -camera.up();
    RoomPose place;
    place.heading_rad = std::atan2(-ahead.x, -ahead.z) - head.heading_rad;
    place.units_per_metre = units_per_metre;
    place.position = camera.centre() - units_per_metre * place.turned(head.position);
    return place;
}

Result<Camera> wall_camera(const Wall& wall, const glm::dvec3& eye_in_room, const RoomPose& place) {
    RS_CHECK(place.units_per_metre > 0 && wall.width > 0 && wall.height > 0);
    const glm::dvec3 across = wall.lower_right - wall.lower_left;
    const glm::dvec3 along = wall.upper_left - wall.lower_left;
    const double width_m = glm::length(across);
    const double height_m = glm::length(along);
    const glm::dvec3 right = across / width_m;
    // check_wall() tolerates a slight skew; camera axes must be orthogonal.
    const glm::dvec3 up = glm::normalize(along - right * glm::dot(along, right));
    const glm::dvec3 back = glm::cross(right, up);
    const glm::dvec3 from_corner = eye_in_room - wall.lower_left;
    const double distance = glm::dot(from_corner, back);
    if (!(distance >= kMinEyeDistance_m)) {
        const bool behind = distance <= -kMinEyeDistance_m;
        return Error{"an eye is " + (behind ? metres(-distance) + " behind" : std::string("in the plane of")) +
                     " wall '" + wall.name + "'; move the head to its front, or exchange its left and right corners"};
    }
    Camera camera;
    camera.width = wall.width;
    camera.height = wall.height;
    camera.fl_x = distance * wall.width / width_m;
    camera.fl_y = distance * wall.height / height_m;
    camera.cx = glm::dot(from_corner, right) * wall.width / width_m;
    camera.cy = wall.height - glm::dot(from_corner, up) * wall.height / height_m;
    camera.world_from_camera =
        glm::dmat4(glm::dvec4(place.turned(right), 0), glm::dvec4(place.turned(up), 0),
                   glm::dvec4(place.turned(back), 0), glm::dvec4(place.in_scene(eye_in_room), 1));
    return camera;
}

}  // namespace rs::compositor
