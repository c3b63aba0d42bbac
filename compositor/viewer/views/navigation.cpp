#include "compositor/viewer/views/navigation.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr double kMaxSpan_s = 0.25;
constexpr double kWheelStep = 0.12;     // fraction of the pivot's distance per notch
constexpr double kWheelSeconds = 0.25;  // seconds of walking per notch
constexpr double kMinPivotDistance = 1e-3;

glm::dvec3 ahead_of(double heading_rad) {
    return {-std::sin(heading_rad), 0, -std::cos(heading_rad)};
}

glm::dvec3 right_of(double heading_rad) {
    return {std::cos(heading_rad), 0, -std::sin(heading_rad)};
}

double clamp_pitch(double pitch_rad) {
    return std::clamp(pitch_rad, -kMaxPitch_rad, kMaxPitch_rad);
}

// Equivalent angle in -pi .. pi.
double wrap_angle(double angle_rad) {
    return std::remainder(angle_rad, 2 * kPi);
}

Visitor orbit(Visitor visitor, const NavigationInput& input, const NavigationSettings& settings, double seconds,
              double pace) {
    const glm::dvec3 pivot = visitor.pivot();
    visitor.heading_rad = wrap_angle(visitor.heading_rad - settings.radians_per_px * input.look_px.x +
                                     settings.turn_rad_per_s * seconds * (input.turn_left + input.right));
    visitor.pitch_rad = clamp_pitch(visitor.pitch_rad - settings.radians_per_px * input.look_px.y -
                                    settings.turn_rad_per_s * seconds * input.up);
    visitor.pivot_distance =
        std::max(kMinPivotDistance,
                 visitor.pivot_distance * std::pow(1 - kWheelStep, input.wheel) - pace * seconds * input.forward);
    visitor.eye = pivot - visitor.pivot_distance * visitor.sight();
    return visitor;
}

}  // namespace

NavigationMode mode_of(const Navigation& navigation) {
    for (const std::string& type : navigation.types) {
        if (type == "WALK") return NavigationMode::kWalk;
        if (type == "FLY") return NavigationMode::kFly;
        if (type == "EXAMINE") return NavigationMode::kExamine;
    }
    return NavigationMode::kWalk;
}

const char* name_of(NavigationMode mode) {
    switch (mode) {
        case NavigationMode::kFly:
            return "fly";
        case NavigationMode::kExamine:
            return "examine";
        default:
            return "walk";
    }
}

glm::dvec3 Visitor::sight() const {
    return std::cos(pitch_rad) * ahead_of(heading_rad) + glm::dvec3(0, std::sin(pitch_rad), 0);
}

Visitor moved(const Visitor& visitor, NavigationMode mode, const NavigationInput& input,
              const NavigationSettings& settings) {
    const double seconds = std::clamp(input.seconds, 0.0, kMaxSpan_s);
    const double pace = settings.speed * (input.fast ? settings.fast : 1);
    Visitor next = visitor;
    const double pan = settings.pan_per_px * visitor.pivot_distance;
    next.eye += -pan * input.pan_px.x * right_of(visitor.heading_rad) + glm::dvec3(0, pan * input.pan_px.y, 0);
    if (mode == NavigationMode::kExamine) return orbit(next, input, settings, seconds, pace);

    next.heading_rad = wrap_angle(visitor.heading_rad - settings.radians_per_px * input.look_px.x +
                                  settings.turn_rad_per_s * seconds * input.turn_left);
    next.pitch_rad = clamp_pitch(visitor.pitch_rad - settings.radians_per_px * input.look_px.y);
    const glm::dvec3 ahead = mode == NavigationMode::kFly ? next.sight() : ahead_of(next.heading_rad);
    glm::dvec3 way = input.forward * ahead + input.right * right_of(next.heading_rad) + glm::dvec3(0, input.up, 0);
    if (const double length = glm::length(way); length > 1) way /= length;  // diagonal movement is not faster
    next.eye += pace * (seconds * way + kWheelSeconds * input.wheel * ahead);
    return next;
}

Visitor visitor_at(const Viewpoint& viewpoint, const glm::dvec3& pivot) {
    Visitor visitor;
    visitor.eye = glm::dvec3(viewpoint.world_from_camera[3]);
    const glm::dvec3 sight = -glm::normalize(glm::dvec3(viewpoint.world_from_camera[2]));
    visitor.pitch_rad = clamp_pitch(std::asin(std::clamp(sight.y, -1.0, 1.0)));
    // Looking straight up or down, the image's up vector gives the heading.
    const glm::dvec3 level =
        std::abs(sight.y) < 0.9999 ? sight : glm::dvec3(viewpoint.world_from_camera[1]) * (sight.y < 0 ? 1.0 : -1.0);
    visitor.heading_rad = std::atan2(-level.x, -level.z);
    visitor.pivot_distance = std::max(kMinPivotDistance, glm::length(pivot - visitor.eye));
    return visitor;
}

Visitor facing(const Visitor& visitor, const glm::dvec3& point) {
    const glm::dvec3 way = point - visitor.eye;
    const double distance = glm::length(way);
    if (!(distance > kMinPivotDistance)) return visitor;
    Visitor turned = visitor;
    if (std::hypot(way.x, way.z) > 1e-6 * distance) turned.heading_rad = std::atan2(-way.x, -way.z);
    turned.pitch_rad = clamp_pitch(std::asin(std::clamp(way.y / distance, -1.0, 1.0)));
    turned.pivot_distance = distance;
    return turned;
}

Viewpoint viewpoint_of(const Visitor& visitor, const Viewpoint& like) {
    Viewpoint viewpoint = like;
    const glm::dvec3 right = right_of(visitor.heading_rad);
    const glm::dvec3 back = -visitor.sight();
    viewpoint.world_from_camera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0),
                                             glm::dvec4(back, 0), glm::dvec4(visitor.eye, 1));
    return viewpoint;
}

Visitor between(const Visitor& from, const Visitor& to, double t) {
    const double s = std::clamp(t, 0.0, 1.0);
    const double eased = s * s * (3 - 2 * s);
    Visitor visitor;
    visitor.eye = from.eye + eased * (to.eye - from.eye);
    visitor.heading_rad = wrap_angle(from.heading_rad + eased * wrap_angle(to.heading_rad - from.heading_rad));
    visitor.pitch_rad = from.pitch_rad + eased * (to.pitch_rad - from.pitch_rad);
    visitor.pivot_distance = from.pivot_distance + eased * (to.pivot_distance - from.pivot_distance);
    return visitor;
}

}  // namespace rs::compositor
