#pragma once
// How a visitor moves through a scene: pure functions of what is pressed and for how long, as VRML browsers and games
// have taught people. No window is known here.
//
// Walk: keys move along the ground, whatever the pitch; the eyes stay at their height. Fly: keys move along the line of
// sight. Examine: the visitor circles about a pivot and looks at it. Dragging looks around (walk, fly) or turns the
// scene under the hand (examine); the wheel goes forward or nearer.

#include "compositor/scene/surroundings.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rs::compositor {

enum class NavigationMode { kWalk, kFly, kExamine };

// The first of a scene's navigation types that is known here; kWalk where none is.
NavigationMode mode_of(const Navigation& navigation);
const char* name_of(NavigationMode mode);

// Heading 0 looks along -Z, growing to the left (about +Y); pitch is up. No roll.
struct Visitor {
    glm::dvec3 eye{0};
    double heading_rad = 0;
    double pitch_rad = 0;       // +-kMostPitch_rad
    double pivot_distance = 3;  // of the point that examine circles about, along the line of sight, > 0

    [[nodiscard]] glm::dvec3 sight() const;  // unit vector
    [[nodiscard]] glm::dvec3 pivot() const { return eye + pivot_distance * sight(); }
};
inline constexpr double kMostPitch_rad = 1.5;

// What was done in a span of time.
struct NavigationInput {
    double seconds = 0;  // 0 .. 0.25; longer ones count as that, so that a stutter is no leap
    double forward = 0;  // -1 .. 1: keys held
    double right = 0;
    double up = 0;
    double turn_left = 0;
    bool fast = false;
    glm::dvec2 look_px{0};  // dragged, right and down
    glm::dvec2 pan_px{0};   // dragged with the other button
    double wheel = 0;       // notches, forward
};

struct NavigationSettings {
    double speed = 1;  // scene units a second, > 0
    double turn_rad_per_s = 1.4;
    double radians_per_px = 0.004;
    double pan_per_px = 0.002;  // of the pivot's distance
    double fast = 4;            // times the speed
};

[[nodiscard]] Visitor moved(const Visitor& visitor, NavigationMode mode, const NavigationInput& input,
                            const NavigationSettings& settings);

// Roll is dropped; `pivot` is brought onto the line of sight by its distance.
[[nodiscard]] Visitor visitor_at(const Viewpoint& viewpoint, const glm::dvec3& pivot);
// The viewpoint of a visitor with the field of view of `like`.
[[nodiscard]] Viewpoint viewpoint_of(const Visitor& visitor, const Viewpoint& like);

// A visitor on the way from one place to another, `t` 0 .. 1, smooth at both ends; turns the shorter way.
[[nodiscard]] Visitor between(const Visitor& from, const Visitor& to, double t);

}  // namespace rs::compositor
