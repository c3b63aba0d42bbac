#include "encode/raymap/captured_view.hpp"

#include <cmath>

namespace rs::encode {
namespace {

bool is_below(double value, double limit) {
    return std::abs(value) < limit;
}

constexpr double kMostPixels = 16384;   // limit of cx, cy, fl_y and q1
constexpr double kMostLateral = 32767;  // limit of q0, px times object radii
constexpr double kMostRadii = 256;      // limit of height and l0

}  // namespace

Result<CapturedView> captured_view(const Camera& camera, int planes) {
    const double lateral_px = -glm::dot(camera.centre(), camera.right()) * camera.fl_x;
    const double depth = -glm::dot(camera.centre(), camera.forward());
    if (!is_below(camera.cx, kMostPixels) || !is_below(camera.cy, kMostPixels) || !is_below(camera.fl_x, kMostPixels) ||
        !is_below(camera.fl_y, kMostPixels)) {
        return Error{"its focal length or principal point is 16384 pixels or more; scale the images down"};
    }
    if (!is_below(lateral_px, kMostLateral)) {
        return Error{
            "its optical axis passes too far from the Y axis for its distance and focal length; bring the axis nearer "
            "to the middle of the image, or scale the images down"};
    }
    if (!is_below(camera.centre().y, kMostRadii) || !is_below(depth, kMostRadii)) {
        return Error{"it is 256 object radii away or more; check the object radius"};
    }
    CapturedView view;
    view.cx_q16 = fixed_point(camera.cx, 16);
    view.cy_q16 = fixed_point(camera.cy, 16);
    view.fl_y_q16 = fixed_point(camera.fl_y, 16);
    view.height_q20 = fixed_point(camera.centre().y, 20);
    for (int k = 0; k < planes; ++k) {
        const glm::dvec3 tangent = reference_plane(k, planes).tangent;
        CapturedLine line;
        line.l0_q20 = fixed_point(depth, 20);
        line.l1_q30 = fixed_point(glm::dot(tangent, camera.forward()), 30);
        line.q0_q16 = fixed_point(lateral_px, 16);
        line.q1_q16 = fixed_point(glm::dot(tangent, camera.right()) * camera.fl_x, 16);
        view.lines.push_back(line);
    }
    return view;
}

NormalLine normal_line(const Camera& camera, const ReferencePlane& plane) {
    const ViewpointLine line = viewpoint_line(camera.centre(), plane);
    return {fixed_point(glm::dot(plane.normal, camera.forward()), 30),
            fixed_point(glm::dot(plane.normal, camera.right()) * camera.fl_x, 16), fixed_point(line.a, 20),
            fixed_point(line.c, 20)};
}

}  // namespace rs::encode
