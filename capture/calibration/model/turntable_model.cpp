#include "capture/calibration/model/turntable_model.hpp"

#include "capture/calibration/model/projection.hpp"
#include "rayspace/base/median.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

glm::dmat3 about_y(double t) {  // glm is column-major
    return {{std::cos(t), 0, -std::sin(t)}, {0, 1, 0}, {std::sin(t), 0, std::cos(t)}};
}
glm::dmat3 about_x(double t) {
    return {{1, 0, 0}, {0, std::cos(t), std::sin(t)}, {0, -std::sin(t), std::cos(t)}};
}
glm::dmat3 about_z(double t) {
    return {{std::cos(t), std::sin(t), 0}, {-std::sin(t), std::cos(t), 0}, {0, 0, 1}};
}

// Intersection of the axis' image with a vertical (fixed = 0: x given) or horizontal (fixed = 1) line of the image.
std::optional<double> axis_crossing(const Lens& lens, const CameraPose& pose, int fixed, double value_px) {
    const glm::dmat3 camera_from_table = camera_rotation(pose);
    const glm::dvec3 origin = camera_from_table * glm::dvec3(0, 0, -1);
    const glm::dvec3 along = camera_from_table * glm::dvec3(0, 1, 0);
    // x = X / -Z, y = -Y / -Z; `plane` is the plane through the camera centre and the line of the image.
    const double u = (value_px - (fixed == 0 ? lens.cx : lens.cy)) / lens.f_px;
    const glm::dvec3 plane = fixed == 0 ? glm::dvec3(1, 0, u) : glm::dvec3(0, -1, u);
    const double slope = glm::dot(plane, along);
    if (std::abs(slope) < 1e-12) return std::nullopt;
    const glm::dvec3 p = origin - along * (glm::dot(plane, origin) / slope);
    if (p.z >= -1e-9) return std::nullopt;
    return fixed == 0 ? lens.cy + lens.f_px * p.y / p.z : lens.cx + lens.f_px * p.x / -p.z;
}

}  // namespace

glm::dmat3 camera_rotation(const CameraPose& pose) {
    return about_z(pose.roll_rad) * about_x(pose.tilt_rad) * about_y(pose.pan_rad);
}

glm::dvec3 turned(const glm::dvec3& p_in_object, double angle_rad) {
    return about_y(angle_rad) * p_in_object;
}

std::optional<glm::dvec2> project(const Lens& lens, const CameraPose& pose, const glm::dvec3& p_in_table) {
    const std::array<double, 5> l{lens.f_px, lens.cx, lens.cy, lens.k1, lens.k2};
    const std::array<double, 3> c{pose.pan_rad, pose.tilt_rad, pose.roll_rad};
    const double angle = 0;
    glm::dvec2 pixel;
    if (!project_turned(l.data(), c.data(), angle, &p_in_table.x, &pixel.x)) return std::nullopt;
    return pixel;
}

std::optional<glm::dvec2> undistorted(const Lens& lens, const glm::dvec2& p) {
    const glm::dvec2 d((p.x - lens.cx) / lens.f_px, (p.y - lens.cy) / lens.f_px);
    const double rd = glm::length(d);
    if (rd < 1e-12) return d;
    double r = rd;
    for (int i = 0; i < 30; ++i) {
        const double r2 = r * r;
        const double slope = 1 + r2 * (3 * lens.k1 + 5 * lens.k2 * r2);
        if (!(slope > 1e-3)) return std::nullopt;
        const double step = (r * (1 + r2 * (lens.k1 + lens.k2 * r2)) - rd) / slope;
        r -= step;
        if (std::abs(step) < 1e-14) break;
    }
    if (!(r > 0) || std::abs(r * (1 + r * r * (lens.k1 + lens.k2 * r * r)) - rd) > 1e-9) return std::nullopt;
    return d * (r / rd);
}

TableRays::TableRays(const Lens& lens, const CameraPose& pose, double turn_rad)
    : lens_(lens), from_camera_(glm::transpose(camera_rotation(pose))) {
    if (turn_rad != 0) from_camera_ = about_y(turn_rad) * from_camera_;
}

std::optional<glm::dvec3> TableRays::through(const glm::dvec2& p) const {
    const auto direction = undistorted(lens_, p);
    if (!direction) return std::nullopt;
    return glm::normalize(from_camera_ * glm::dvec3(direction->x, -direction->y, -1));
}

std::optional<glm::dvec3> table_ray(const Lens& lens, const CameraPose& pose, const glm::dvec2& p) {
    return TableRays(lens, pose).through(p);
}

Camera object_camera(const TurntableModel& model, std::size_t view, double scale, double origin_height) {
    const glm::dmat3 object_from_table = about_y(-model.angles_rad[view]);
    const glm::dmat3 object_from_camera = object_from_table * glm::transpose(camera_rotation(model.pose));
    Camera camera;
    camera.width = model.lens.width;
    camera.height = model.lens.height;
    camera.fl_x = camera.fl_y = model.lens.f_px;
    camera.cx = model.lens.cx;
    camera.cy = model.lens.cy;
    camera.world_from_camera = glm::dmat4(object_from_camera);
    const glm::dvec3 centre = object_from_table * glm::dvec3(0, 0, 1) * scale;
    camera.world_from_camera[3] = glm::dvec4(centre.x, centre.y - origin_height * scale, centre.z, 1);
    return camera;
}

std::optional<double> axis_column(const Lens& lens, const CameraPose& pose, double y_px) {
    return axis_crossing(lens, pose, 1, y_px);
}

std::optional<double> axis_row(const Lens& lens, const CameraPose& pose, double x_px) {
    return axis_crossing(lens, pose, 0, x_px);
}

bool has_sideways_axis(const CameraPose& pose) {
    return std::abs(std::sin(pose.roll_rad)) > std::abs(std::cos(pose.roll_rad));
}

std::optional<double> axis_position(const Lens& lens, const CameraPose& pose, double at_px) {
    return has_sideways_axis(pose) ? axis_row(lens, pose, at_px) : axis_column(lens, pose, at_px);
}

double median_step(std::span<const double> angles_rad) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < angles_rad.size(); ++i) steps.push_back(angles_rad[i] - angles_rad[i - 1]);
    return median(std::move(steps));
}

}  // namespace rs::capture
