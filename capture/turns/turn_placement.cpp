#include "capture/turns/turn_placement.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

TurnPlacement upright_placement(double azimuth_rad, double distance, double height) {
    TurnPlacement placement;
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 unit(0);
        unit[k] = 1;
        placement.rotation[k] = turned(unit, azimuth_rad);
    }
    placement.offset = {0, -height, 0};
    placement.distance = distance;
    return placement;
}

TurnPlacement aimed_placement(double azimuth_rad, const CameraAim& aim, double middle) {
    const double c = std::cos(aim.tilt_rad), s = std::sin(aim.tilt_rad);
    const double distance = std::max(0.01 * aim.slant, aim.slant * c - aim.shift * s);
    return upright_placement(azimuth_rad, distance, middle + aim.slant * s + aim.shift * c);
}

CameraAim aim_of(const PlacedTurn& turn, double middle) {
    const double tilt = turn.model.pose.tilt_rad;
    const double c = std::cos(tilt), s = std::sin(tilt);
    const double distance = turn.placement.distance, height = -turn.placement.offset.y - middle;
    return {tilt, distance * c + height * s, height * c - distance * s};
}

double azimuth_rad(const TurnPlacement& placement) {
    const glm::dmat3& r = placement.rotation;
    return std::atan2(r[2].x - r[0].z, r[0].x + r[2].z);
}

Camera common_camera(const PlacedTurn& turn, std::size_t view) {
    Camera camera = object_camera(turn.model, view);
    const glm::dmat3 common_from_turn = glm::transpose(turn.placement.rotation);
    const glm::dvec3 centre = turn.placement.common_from_turn(camera.centre());
    camera.world_from_camera = glm::dmat4(common_from_turn * glm::dmat3(camera.world_from_camera));
    camera.world_from_camera[3] = glm::dvec4(centre, 1);
    return camera;
}

double axis_tilt_deg(const TurnPlacement& placement) {
    return degrees(std::acos(std::clamp(placement.rotation[1].y, -1.0, 1.0)));
}

double elevation_deg(const PlacedTurn& turn, const glm::dvec3& target) {
    const glm::dvec3 off = turn.placement.rotation * (common_camera(turn, 0).centre() - target);
    return degrees(std::atan2(off.y, std::hypot(off.x, off.z)));
}

}  // namespace rs::capture
