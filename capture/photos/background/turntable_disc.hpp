#pragma once
/// \file
/// Top of the turntable: its detection in the clean plate and the geometry of its plane.
///
/// The disc is symmetric about the axis, so the part that the object covers looks like the rest of the same circle
/// (disc_inpainting.hpp), and shadows fall on it. Pixel coordinates: x to the right, y down, pixel centres at
/// half-integers. Lengths on the plane are in units of the camera's height above it.

#include "capture/photos/background/background_parameters.hpp"
#include "rayspace/image/image.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace rs::capture {

/// Circle about the axis, seen by a pinhole camera with the principal point in the image centre.
struct TurntableDisc {
    double f_px = 0;      ///< assumed focal length; the tilt compensates its error
    double tilt_rad = 0;  ///< by which the camera looks down
    double roll_rad = 0;  ///< of the camera about its optical axis
    double centre_x = 0;  ///< px, where the axis meets the disc
    double centre_y = 0;
    double radius = 0;
};

/// Plane of a disc in an image of the size in which the disc was detected.
class DiscPlane {
public:
    DiscPlane(const TurntableDisc& disc, int width, int height)
        : f_px_(disc.f_px), cx_(0.5 * width), cy_(0.5 * height) {
        const double cos_tilt = std::cos(disc.tilt_rad);
        up_ = {std::sin(disc.roll_rad) * cos_tilt, -std::cos(disc.roll_rad) * cos_tilt, -std::sin(disc.tilt_rad)};
        right_ = glm::normalize(glm::cross(up_, glm::dvec3(0, 0, 1)));
        away_ = glm::cross(right_, up_);
        centre_ = intersection({disc.centre_x, disc.centre_y});
        unit_per_px_ = glm::length(plane_from_px({disc.centre_x + 1, disc.centre_y}));
    }
    /// Width of a pixel on the plane at the disc's centre.
    [[nodiscard]] double unit_per_px() const { return unit_per_px_; }
    /// True if the pixel's ray meets the plane.
    [[nodiscard]] bool is_below_horizon(glm::dvec2 px) const { return glm::dot(up_, ray(px)) < -1e-3; }
    /// Point of the plane that a pixel shows, relative to the axis: to the right, and away from the camera. Only below
    /// the horizon.
    [[nodiscard]] glm::dvec2 plane_from_px(glm::dvec2 px) const {
        const glm::dvec3 offset = intersection(px) - centre_;
        return {glm::dot(offset, right_), glm::dot(offset, away_)};
    }
    /// Pixel that shows a point of the circle of a radius about the axis.
    [[nodiscard]] glm::dvec2 px_on_circle(double radius, double angle_rad) const {
        return px_on_circle(radius, glm::dvec2(std::cos(angle_rad), std::sin(angle_rad)));
    }
    /// The same; `direction` is the cosine and sine of the angle.
    [[nodiscard]] glm::dvec2 px_on_circle(double radius, const glm::dvec2& direction) const {
        const glm::dvec3 p = centre_ + radius * (direction.x * right_ + direction.y * away_);
        return {cx_ + f_px_ * p.x / p.z, cy_ + f_px_ * p.y / p.z};
    }
    /// True if all of a circle about the axis is in front of the camera, at no less than 1/5 of the centre's depth.
    [[nodiscard]] bool is_in_front(double radius) const { return centre_.z - radius > 0.2 * centre_.z; }

private:
    [[nodiscard]] glm::dvec3 ray(glm::dvec2 px) const { return {(px.x - cx_) / f_px_, (px.y - cy_) / f_px_, 1}; }
    [[nodiscard]] glm::dvec3 intersection(glm::dvec2 px) const {
        const glm::dvec3 d = ray(px);
        return d * (-1 / std::min(-1e-6, glm::dot(up_, d)));
    }

    double f_px_, cx_, cy_;
    double unit_per_px_ = 0;
    glm::dvec3 up_{}, right_{}, away_{}, centre_{};  // camera coordinates: x right, y down, z forwards
};

/// Detects the disc whose rim has the highest contrast in the clean plate, with the centre within the columns of
/// `object` (not 0 where the object is in any frame) and within its lower half or little below. `known`: not 0 where
/// the plate is known. All have one size. Coarse grid, finer grid, then Gauss-Newton steps to the nearest edges.
/// Nullopt if no rim is clear along most of what is known of it.
std::optional<TurntableDisc> find_turntable_disc(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known,
                                                 ConstImageView<std::uint8_t> object,
                                                 const BackgroundParameters::Disc& parameters);

}  // namespace rs::capture
