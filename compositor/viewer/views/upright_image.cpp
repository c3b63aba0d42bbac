#include "compositor/viewer/views/upright_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::compositor {
namespace {

constexpr double kMinHorizontal =
    0.35;  // horizontal part of the central ray's direction: 70 degrees above or below the horizon
constexpr double kMinForward = 0.05;    // component of every ray along the upright camera's forward
constexpr double kMaxStretch = 2.5;     // anisotropy of the mapping at the image centre
constexpr double kMaxPixelRatio = 3.5;  // pixels of the upright image per pixel of the area
constexpr int kSideLimit_px = 8192;     // RECONSTRUCTION.md, section 1

// Singular values of a 2x2 matrix, in descending order.
std::array<double, 2> singular_values(const glm::dmat2& m) {
    const double sum = std::hypot(m[0][0] + m[1][1], m[0][1] - m[1][0]);
    const double difference = std::hypot(m[0][0] - m[1][1], m[0][1] + m[1][0]);
    return {(sum + difference) / 2, std::abs(sum - difference) / 2};
}

// Maps (x, y, 1) of an image to coordinates along the axes of the upright camera: right, down, forward.
glm::dmat3 rays_along(const glm::dmat3& axes, const Camera& camera) {
    const glm::dmat3 ray_from_screen(camera.right() / camera.fl_x, -camera.up() / camera.fl_y, camera.ray(0, 0));
    return glm::transpose(axes) * ray_from_screen;
}

}  // namespace

std::optional<UprightImage> upright_image(const Camera& camera, const ScreenRectangle& area,
                                          const BoundingCylinder& bounds, double samples_across) {
    const glm::dvec2 middle(area.x + area.width / 2.0, area.y + area.height / 2.0);
    const glm::dvec3 ray = glm::normalize(camera.ray(middle.x, middle.y));
    const double level = std::hypot(ray.x, ray.z);
    if (level < kMinHorizontal) return std::nullopt;
    const glm::dvec3 forward(ray.x / level, 0, ray.z / level);
    const glm::dvec3 up(0, 1, 0);
    const glm::dvec3 right = glm::cross(forward, up);

    const glm::dmat3 along = rays_along(glm::dmat3(right, -up, forward), camera);
    const auto on_image = [&](const glm::dvec2& p) {  // at focal length 1; z: forward
        const glm::dvec3 q = along * glm::dvec3(p, 1);
        return glm::dvec3(q.x / q.z, q.y / q.z, q.z);
    };
    const std::array<glm::dvec2, 4> corners{{{area.x, area.y},
                                             {area.x + area.width, area.y},
                                             {area.x, area.y + area.height},
                                             {area.x + area.width, area.y + area.height}}};
    glm::dvec2 lowest(INFINITY);
    glm::dvec2 highest(-INFINITY);
    for (const glm::dvec2& corner : corners) {
        const glm::dvec3 p = on_image(corner);
        if (p.z < kMinForward * glm::length(camera.ray(corner.x, corner.y))) return std::nullopt;
        lowest = glm::min(lowest, glm::dvec2(p));
        highest = glm::max(highest, glm::dvec2(p));
    }
    const glm::dvec2 at(on_image(middle));
    const glm::dmat2 per_pixel(
        glm::dvec2(on_image(middle + glm::dvec2(0.5, 0))) - glm::dvec2(on_image(middle - glm::dvec2(0.5, 0))),
        glm::dvec2(on_image(middle + glm::dvec2(0, 0.5))) - glm::dvec2(on_image(middle - glm::dvec2(0, 0.5))));
    const auto [largest, smallest] = singular_values(per_pixel);
    if (!(largest <= kMaxStretch * smallest)) return std::nullopt;
    const double focal_px = samples_across / smallest;

    UprightImage made;
    made.camera.fl_x = focal_px;
    made.camera.fl_y = focal_px;
    const glm::dvec2 size = glm::ceil((highest - lowest) * focal_px);
    if (!(std::max(size.x, size.y) <= kSideLimit_px)) return std::nullopt;
    made.camera.width = std::max(static_cast<int>(size.x), 1);
    made.camera.height = std::max(static_cast<int>(size.y), 1);
    made.camera.cx = -lowest.x * focal_px;
    made.camera.cy = -lowest.y * focal_px;
    made.camera.world_from_camera =
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(-forward, 0), glm::dvec4(camera.centre(), 1));
    const auto covered = covering_rectangle(bounds, made.camera);
    if (!covered) return std::nullopt;
    made.camera.width = covered->width;
    made.camera.height = covered->height;
    made.camera.cx -= covered->x;
    made.camera.cy -= covered->y;
    const double pixels = static_cast<double>(covered->width) * covered->height;
    const double direct = samples_across * samples_across * area.width * area.height;
    if (pixels > kMaxPixelRatio * direct) return std::nullopt;
    const glm::dmat3 image_from_rays(glm::dvec3(focal_px, 0, 0), glm::dvec3(0, focal_px, 0),
                                     glm::dvec3(made.camera.cx, made.camera.cy, 1));
    made.image_from_screen = image_from_rays * along;
    return made;
}

}  // namespace rs::compositor
