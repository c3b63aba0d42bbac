#pragma once
// Turns of a synthetic object without symmetry: two boxes, of which points are projected to masks.

#include "capture/calibration/points/tracks.hpp"
#include "capture/turns/turn_placement.hpp"
#include "rayspace/base/conventions.hpp"

#include <glm/glm.hpp>

#include <cmath>
#include <vector>

namespace rs::capture::test {

inline TurntableModel turn_model(double tilt_deg, std::size_t views = 12) {
    TurntableModel model;
    model.lens = {240, 200, 420, 120, 100, 0, 0};
    model.pose.tilt_rad = radians(tilt_deg);
    for (std::size_t i = 0; i < views; ++i) {
        model.angles_rad.push_back(2 * kPi * static_cast<double>(i) / static_cast<double>(views));
    }
    return model;
}

// Points on a grid in the two boxes, in the common frame.
inline std::vector<glm::dvec3> object_points() {
    std::vector<glm::dvec3> points;
    constexpr double kStep = 0.006;
    for (double x = -0.15; x <= 0.15; x += kStep) {
        for (double y = -0.1; y <= 0.1; y += kStep) {
            for (double z = -0.06; z <= 0.06; z += kStep) {
                if (y <= 0 || x > 0.05) points.emplace_back(x, y, z);
            }
        }
    }
    return points;
}

// The masks of a turn; grey values are not used.
inline TurnImages turn_images(const PlacedTurn& turn) {
    TurnImages images;
    images.width = turn.model.lens.width;
    images.height = turn.model.lens.height;
    const std::vector<glm::dvec3> points = object_points();
    for (std::size_t i = 0; i < turn.model.angles_rad.size(); ++i) {
        const Camera camera = common_camera(turn, i);
        CalibrationImage image{Image<std::uint8_t>(images.width, images.height),
                               Image<std::uint8_t>(images.width, images.height)};
        for (const glm::dvec3& p : points) {
            const glm::dvec3 at = camera.project(p);
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int x = static_cast<int>(at.x) + dx, y = static_cast<int>(at.y) + dy;
                    if (x >= 0 && y >= 0 && x < images.width && y < images.height) image.alpha(x, y) = 255;
                }
            }
        }
        images.images.push_back(std::move(image));
        images.names.push_back(std::to_string(i));
    }
    return images;
}

// Two turns: one level, one 35 degrees above, with the object turned by 130 degrees in between.
inline std::vector<PlacedTurn> two_turns() {
    return {{turn_model(2), upright_placement(0, 1, 0)},
            {turn_model(35), aimed_placement(radians(130), {radians(35), 1.05, 0.01}, -0.02)}};
}

}  // namespace rs::capture::test
