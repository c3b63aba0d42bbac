#include "compositor/web/view/surface_point.hpp"

#include <cmath>

namespace rs::web {
namespace {

constexpr int kWindow_px = 9;              // odd
constexpr int kReach_px = kWindow_px / 2;  // of the normal's differences
constexpr std::uint8_t kOpaqueFrom = 128;

// The camera's own rays through a window of pixels about (x, y).
Camera window_camera(Camera camera, double x, double y) {
    camera.cx += kWindow_px / 2.0 - x;
    camera.cy += kWindow_px / 2.0 - y;
    camera.width = kWindow_px;
    camera.height = kWindow_px;
    return camera;
}

}  // namespace

std::optional<SurfacePoint> surface_point(const ObjectView& object, const OrbitView& view, double x, double y) {
    const Camera camera = window_camera(object.camera_of(view), x, y);
    const double unit = object.object().units_per_radius;
    Camera in_rig = camera;
    in_rig.world_from_camera[3] = glm::dvec4(camera.centre() * unit, 1);
    const Result<engine::ViewRegisters> registers = engine::prepare_view(object.object(), in_rig);
    if (!registers) return std::nullopt;
    Image<Rgba8> image(kWindow_px, kWindow_px);
    Image<std::int32_t> lambda_q20(kWindow_px, kWindow_px);
    object.renderer().render(*registers, image, lambda_q20);
    const Image<float> depth = engine::depth_image(object.object(), in_rig, lambda_q20);

    const auto at = [&](int i, int j) -> std::optional<glm::dvec3> {
        if (depth(i, j) <= 0 || image(i, j).a < kOpaqueFrom) return std::nullopt;
        return camera.centre() + double(depth(i, j)) / unit * camera.ray(i + 0.5, j + 0.5);
    };
    const std::optional<glm::dvec3> middle = at(kReach_px, kReach_px);
    if (!middle) return std::nullopt;
    // The shorter of the differences to both sides does not cross a contour.
    const auto difference = [&](int di, int dj) {
        const auto before = at(kReach_px - di, kReach_px - dj);
        const auto after = at(kReach_px + di, kReach_px + dj);
        if (before && after) {
            const glm::dvec3 to_middle = *middle - *before;
            const glm::dvec3 from_middle = *after - *middle;
            return glm::length(to_middle) < glm::length(from_middle) ? to_middle : from_middle;
        }
        if (before) return *middle - *before;
        return after ? *after - *middle : glm::dvec3(0);
    };
    const glm::dvec3 across = glm::cross(difference(0, -kReach_px), difference(kReach_px, 0));
    const glm::dvec3 to_viewer = glm::normalize(camera.centre() - *middle);
    SurfacePoint found{*middle, to_viewer};
    if (glm::length(across) > 0) found.normal = glm::normalize(glm::dot(across, to_viewer) < 0 ? -across : across);
    return found;
}

}  // namespace rs::web
