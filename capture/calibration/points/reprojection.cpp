#include "capture/calibration/points/reprojection.hpp"

#include <cmath>

namespace rs::capture {
namespace {

using Direction = PosedTurn::Direction;

std::array<Direction, 3> directions_of(const double* pose) {
    return {Direction(pose[0]), Direction(pose[1]), Direction(pose[2])};
}

}  // namespace

PosedTurn::PosedTurn(const std::array<double, 3>& pose, const double* step_rad, const std::vector<double>& angles_rad)
    : numbers_(pose), step_rad_(step_rad), angles_rad_(angles_rad), pose_(directions_of(pose.data())) {
    views_.assign(angles_rad.size(), Direction(0));
    PrepareForEvaluation(true, true);
}

void PosedTurn::PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) {
    if (!new_evaluation_point) return;
    pose_ = directions_of(numbers_.data());
    for (std::size_t i = 0; i < views_.size(); ++i) {
        views_[i] = Direction(step_rad_ != nullptr ? *step_rad_ * static_cast<double>(i) : angles_rad_[i]);
    }
}

bool Reprojection::Evaluate(const double* const* parameters, double* residuals, double** jacobians) const {
    const double* lens = parameters[0];
    const double* pose = parameters[1];
    const double* point = parameters[3];
    const Direction turned = turn_ != nullptr ? turn_->view(seen_.view) : Direction(parameters[2][0] * turns_);
    const std::array<Direction, 3> posed = turn_ != nullptr ? turn_->pose() : directions_of(pose);

    // As project_turned(), every step of it kept.
    const double ca = turned.cosine, sa = turned.sine;
    const glm::dvec3 table{ca * point[0] + sa * point[2], point[1], -sa * point[0] + ca * point[2] - 1};
    const double cp = posed[0].cosine, sp = posed[0].sine;
    const double ct = posed[1].cosine, st = posed[1].sine;
    const double cr = posed[2].cosine, sr = posed[2].sine;
    const double panned_x = cp * table.x + sp * table.z;
    const double panned_z = -sp * table.x + cp * table.z;
    const double tilted_y = ct * table.y - st * panned_z;
    const glm::dvec3 p{cr * panned_x - sr * tilted_y, sr * panned_x + cr * tilted_y, st * table.y + ct * panned_z};
    if (p.z > -1e-6) return false;
    const double x = -p.x / p.z;
    const double y = p.y / p.z;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (lens[3] + r2 * lens[4]);
    const glm::dvec2 pixel(lens[1] + lens[0] * radial * x, lens[2] + lens[0] * radial * y);
    const glm::dvec2 residual = seen_.weight * (pixel - seen_.p);
    residuals[0] = residual.x;
    residuals[1] = residual.y;
    if (jacobians == nullptr) return true;

    // Column `column` of a block of `columns`: what px per unit of it become after weighing.
    const auto set = [&](int block, int columns, int column, double px, double py) {
        if (jacobians[block] == nullptr) return;
        const glm::dvec2 weighted = seen_.weight * glm::dvec2(px, py);
        jacobians[block][column] = weighted.x;
        jacobians[block][columns + column] = weighted.y;
    };
    set(0, 5, 0, radial * x, radial * y);
    set(0, 5, 1, 1, 0);
    set(0, 5, 2, 0, 1);
    set(0, 5, 3, lens[0] * r2 * x, lens[0] * r2 * y);
    set(0, 5, 4, lens[0] * r2 * r2 * x, lens[0] * r2 * r2 * y);

    const double by_r2 = lens[3] + 2 * r2 * lens[4];
    const double xx = lens[0] * (radial + 2 * by_r2 * x * x);
    const double xy = lens[0] * 2 * by_r2 * x * y;
    const double yy = lens[0] * (radial + 2 * by_r2 * y * y);
    const auto set_by_change = [&](int block, int columns, int column, const glm::dvec3& change) {
        const double of_x = (-change.x - x * change.z) / p.z;
        const double of_y = (change.y - y * change.z) / p.z;
        set(block, columns, column, xx * of_x + xy * of_y, xy * of_x + yy * of_y);
    };
    set_by_change(1, 3, 0,
                  {cr * panned_z - sr * st * panned_x, sr * panned_z + cr * st * panned_x, -ct * panned_x});  // pan
    set_by_change(1, 3, 1, {sr * p.z, -cr * p.z, tilted_y});                                                  // tilt
    set_by_change(1, 3, 2, {-p.y, p.x, 0});                                                                   // roll
    const auto in_camera = [&](const glm::dvec3& v) -> glm::dvec3 {  // the rotation by the pose, written out
        return {(cr * cp - sr * st * sp) * v.x - sr * ct * v.y + (cr * sp + sr * st * cp) * v.z,
                (sr * cp + cr * st * sp) * v.x + cr * ct * v.y + (sr * sp - cr * st * cp) * v.z,
                -ct * sp * v.x + st * v.y + ct * cp * v.z};
    };
    set_by_change(2, 1, 0, in_camera({turns_ * (table.z + 1), 0, -turns_ * table.x}));
    set_by_change(3, 3, 0, in_camera({ca, 0, -sa}));
    set_by_change(3, 3, 1, in_camera({0, 1, 0}));
    set_by_change(3, 3, 2, in_camera({sa, 0, ca}));
    return true;
}

}  // namespace rs::capture
