#pragma once
// Navigation of a visitor through a scene: pure functions of the input and its duration, with the controls of VRML
// browsers and games. Independent of windows.
//
// Walk: keys move along the ground, independent of pitch, at constant eye height. Fly: keys move along the line of
// sight. Examine: orbits around a pivot. Dragging looks around (walk, fly) or rotates the scene (examine); the wheel
// moves forward, or towards the pivot.

#include "compositor/scene/surroundings.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rs::compositor {

enum class NavigationMode { kWalk, kFly, kExamine };

/// First supported navigation type of the scene; kWalk if none is.
NavigationMode mode_of(const Navigation& navigation);
const char* name_of(NavigationMode mode);

/// Heading 0 is -Z, increasing to the left (about +Y); pitch is positive upwards. No roll.
struct Visitor {
    glm::dvec3 eye{0};
    double heading_rad = 0;
    double pitch_rad = 0;       // +-kMaxPitch_rad
    double pivot_distance = 3;  // distance of the orbit centre of examine along the line of sight, > 0

    [[nodiscard]] glm::dvec3 sight() const;  // unit vector
    [[nodiscard]] glm::dvec3 pivot() const { return eye + pivot_distance * sight(); }
};
inline constexpr double kMaxPitch_rad = 1.5;

/// Input during a time span.
struct NavigationInput {
    double seconds = 0;  // 0 .. 0.25; longer spans are clamped, so that a stall causes no jump
    double forward = 0;  // -1 .. 1, from held keys
    double right = 0;
    double up = 0;
    double turn_left = 0;
    bool fast = false;
    glm::dvec2 look_px{0};  // drag, right and down
    glm::dvec2 pan_px{0};   // drag with the other button
    double wheel = 0;       // notches, positive forward
};

struct NavigationSettings {
    double speed = 1;  // scene units per second, > 0
    double turn_rad_per_s = 1.4;
    double radians_per_px = 0.004;
    double pan_per_px = 0.002;  // as a fraction of the pivot's distance
    double fast = 4;            // factor on the speed
};

[[nodiscard]] Visitor moved(const Visitor& visitor, NavigationMode mode, const NavigationInput& input,
                            const NavigationSettings& settings);

/// Drops roll. `pivot` only sets the pivot distance along the line of sight.
[[nodiscard]] Visitor visitor_at(const Viewpoint& viewpoint, const glm::dvec3& pivot);
/// The visitor turned towards a point, which becomes the pivot. Unchanged at the point itself.
[[nodiscard]] Visitor facing(const Visitor& visitor, const glm::dvec3& point);
/// Viewpoint of the visitor with the field of view of `like`.
[[nodiscard]] Viewpoint viewpoint_of(const Visitor& visitor, const Viewpoint& like);

/// Interpolates between visitors with ease-in and ease-out, turning the shorter way.
/// \param t 0 .. 1.
[[nodiscard]] Visitor between(const Visitor& from, const Visitor& to, double t);

}  // namespace rs::compositor
