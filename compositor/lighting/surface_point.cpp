#include "compositor/lighting/surface_point.hpp"

#include <cmath>
#include <limits>

namespace rs::compositor {
namespace {

// First difference along one axis, from the side with the smaller second difference.
double slope(double middle, double before, double far_before, double behind, double far_behind) {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto bend = [&](double near, double far) {
        return near > 0 && far > 0 ? std::abs(middle - 2 * near + far) : infinity;
    };
    const double bend_before = bend(before, far_before);
    const double bend_behind = bend(behind, far_behind);
    if (bend_before == infinity && bend_behind == infinity) return 0;
    return bend_before < bend_behind ? middle - before : behind - middle;
}

}  // namespace

std::optional<SurfacePoint> surface_from_depths(const Camera& camera, int x, int y,
                                                const DepthsAround& inverse_depths) {
    const auto at = [&](int dx, int dy) {
        constexpr int kMiddle = kDepthsAcross / 2;
        return inverse_depths[static_cast<std::size_t>((dy + kMiddle) * kDepthsAcross + dx + kMiddle)];
    };
    const double middle = at(0, 0);
    if (!(middle > 0)) return std::nullopt;
    const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
    const double right = (x + 0.5 - camera.cx) / camera.fl_x;
    const double up = (camera.cy - (y + 0.5)) / camera.fl_y;
    glm::dvec3 n;
    n.x = slope(middle, at(-1, 0), at(-2, 0), at(1, 0), at(2, 0)) * camera.fl_x;
    n.y = -slope(middle, at(0, -1), at(0, -2), at(0, 1), at(0, 2)) * camera.fl_y;
    n.z = middle - n.x * right - n.y * up;
    SurfacePoint point;
    point.place = camera.centre() + ray / middle;
    point.normal = -glm::normalize(camera.right() * n.x + camera.up() * n.y + camera.forward() * n.z);
    return point;
}

}  // namespace rs::compositor
