#pragma once
// The plane of a turntable's disc before the camera: which pixel shows which of its points.

#include "capture/photos/background/turntable_disc.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace rs::capture {

// Of a picture of the size the disc was found in.
class DiscPlane {
public:
    DiscPlane(const TurntableDisc& disc, int width, int height)
        : f_px_(disc.f_px), cx_(0.5 * width), cy_(0.5 * height) {
        const double level = std::cos(disc.tilt_rad);
        up_ = {std::sin(disc.roll_rad) * level, -std::cos(disc.roll_rad) * level, -std::sin(disc.tilt_rad)};
        across_ = glm::normalize(glm::cross(up_, glm::dvec3(0, 0, 1)));
        along_ = glm::cross(across_, up_);
        centre_ = point_at({disc.centre_x, disc.centre_y});
        unit_per_px_ = glm::length(from_axis({disc.centre_x + 1, disc.centre_y}));
    }
    // The width of a pixel at the disc's centre.
    [[nodiscard]] double unit_per_px() const { return unit_per_px_; }
    // Whether the plane is seen there at all.
    [[nodiscard]] bool below_horizon(glm::dvec2 px) const { return glm::dot(up_, ray(px)) < -1e-3; }
    // Where the plane is seen there, measured from the axis: along the picture's rows, and away from the camera.
    [[nodiscard]] glm::dvec2 from_axis(glm::dvec2 px) const {
        const glm::dvec3 offset = point_at(px) - centre_;
        return {glm::dot(offset, across_), glm::dot(offset, along_)};
    }
    // The pixel that shows a point of a circle about the axis.
    [[nodiscard]] glm::dvec2 on_circle(double radius, double angle_rad) const {
        return on_circle(radius, glm::dvec2(std::cos(angle_rad), std::sin(angle_rad)));
    }
    // The same for an angle of which cosine and sine are known.
    [[nodiscard]] glm::dvec2 on_circle(double radius, const glm::dvec2& direction) const {
        const glm::dvec3 p = centre_ + radius * (direction.x * across_ + direction.y * along_);
        return {cx_ + f_px_ * p.x / p.z, cy_ + f_px_ * p.y / p.z};
    }
    // Whether all of a circle about the axis lies well before the camera.
    [[nodiscard]] bool visible(double radius) const { return centre_.z - radius > 0.2 * centre_.z; }

private:
    [[nodiscard]] glm::dvec3 ray(glm::dvec2 px) const { return {(px.x - cx_) / f_px_, (px.y - cy_) / f_px_, 1}; }
    [[nodiscard]] glm::dvec3 point_at(glm::dvec2 px) const {
        const glm::dvec3 d = ray(px);
        return d * (-1 / std::min(-1e-6, glm::dot(up_, d)));
    }

    double f_px_, cx_, cy_;
    double unit_per_px_ = 0;
    glm::dvec3 up_{}, across_{}, along_{}, centre_{};
};

}  // namespace rs::capture
