#include "encode/raymap/captured_view.hpp"

#include "rayspace/ray_space.hpp"

#include <cmath>

namespace rs::encode {
namespace {

std::int32_t fixed(double value, int fractional_bits) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, fractional_bits)));
}

}  // namespace

CapturedView captured_view(const Camera& camera, int planes) {
    CapturedView view;
    view.cx_q16 = fixed(camera.cx, 16);
    view.cy_q16 = fixed(camera.cy, 16);
    view.fl_y_q16 = fixed(camera.fl_y, 16);
    view.height_q20 = fixed(camera.centre().y, 20);
    for (int k = 0; k < planes; ++k) {
        const glm::dvec3 tangent = reference_plane(k, planes).tangent;
        CapturedLine line;
        line.l0_q20 = fixed(-glm::dot(camera.centre(), camera.forward()), 20);
        line.l1_q30 = fixed(glm::dot(tangent, camera.forward()), 30);
        line.q0_q16 = fixed(-glm::dot(camera.centre(), camera.right()) * camera.fl_x, 16);
        line.q1_q16 = fixed(glm::dot(tangent, camera.right()) * camera.fl_x, 16);
        view.lines.push_back(line);
    }
    return view;
}

}  // namespace rs::encode
