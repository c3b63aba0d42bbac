#include "compositor/viewer/views/screen_rectangle.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rs::compositor {
namespace {

constexpr int kSides = 16;
constexpr double kCutOff = 1e-3;  // near plane: axial depth, object radii

// Corners of a prism around the cylinder in camera coordinates, z = depth.
std::array<glm::dvec3, 2 * kSides> prism_corners(const BoundingCylinder& bound, const Camera& camera) {
    std::array<glm::dvec3, 2 * kSides> corners;
    const double radius = bound.radius / std::cos(kPi / kSides);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle = 2 * kPi * static_cast<double>(i % kSides) / kSides;
        const glm::dvec3 corner(radius * std::sin(angle), i < kSides ? bound.bottom : bound.top,
                                radius * std::cos(angle));
        const glm::dvec3 v = corner - camera.centre();
        corners[i] = {glm::dot(v, camera.right()), glm::dot(v, camera.up()), glm::dot(v, camera.forward())};
    }
    return corners;
}

}  // namespace

std::optional<ScreenRectangle> covering_rectangle(const BoundingCylinder& bound, const Camera& camera) {
    if (bound.empty()) return std::nullopt;
    double left = std::numeric_limits<double>::infinity();
    double top = left;
    double right = -left;
    double bottom = -left;
    const auto include = [&](const glm::dvec3& p) {
        const double x = camera.cx + camera.fl_x * p.x / p.z;
        const double y = camera.cy - camera.fl_y * p.y / p.z;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    };
    const auto corners = prism_corners(bound, camera);
    for (const glm::dvec3& p : corners) {
        if (p.z >= kCutOff) {
            include(p);
            continue;
        }
        // Clips the convex prism at the near plane: corners in front, and intersections of all segments between a
        // corner in front and one behind. Segments that are not edges lie inside and do not matter.
        for (const glm::dvec3& q : corners) {
            if (q.z > kCutOff) include(p + (q - p) * ((kCutOff - p.z) / (q.z - p.z)));
        }
    }
    left = std::floor(std::max(left, 0.0));
    top = std::floor(std::max(top, 0.0));
    right = std::ceil(std::min(right, static_cast<double>(camera.width)));
    bottom = std::ceil(std::min(bottom, static_cast<double>(camera.height)));
    if (!(left < right && top < bottom)) return std::nullopt;
    return ScreenRectangle{static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left),
                           static_cast<int>(bottom - top)};
}

FrameView view_of_frame(const Camera& camera) {
    // Points are in camera coordinates: right, up, back.
    glm::dmat4 m(0.0);
    m[0][0] = 2 * camera.fl_x / camera.width;
    m[1][1] = 2 * camera.fl_y / camera.height;
    m[2][0] = 1 - 2 * camera.cx / camera.width;
    m[2][1] = 2 * camera.cy / camera.height - 1;
    m[2][3] = -1;
    m[3][2] = kNear;
    return {camera, m * glm::inverse(camera.world_from_camera)};
}

bool can_be_visible(const BoundingBox& box, const glm::dmat4& clip_from_world, bool perspective) {
    if (box.empty()) return false;
    // A box is outside if all of its corners are outside of the same plane.
    int outside = 0x1f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? box.highest.x : box.lowest.x,
                           (corner & 2) != 0 ? box.highest.y : box.lowest.y,
                           (corner & 4) != 0 ? box.highest.z : box.lowest.z);
        const glm::dvec4 clip = clip_from_world * glm::dvec4(p, 1);
        outside &= (clip.x < -clip.w ? 1 : 0) | (clip.x > clip.w ? 2 : 0) | (clip.y < -clip.w ? 4 : 0) |
                   (clip.y > clip.w ? 8 : 0) | (perspective && clip.w < kNear ? 16 : 0);
    }
    return outside == 0;
}

}  // namespace rs::compositor
