#include "capture/calibration/model/turntable_fit.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <complex>

namespace rs::capture {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct PlacedCamera {
    Matrix3d orientation;  // world_from_camera
    Vector3d centre;
};

PlacedCamera placed_camera(const glm::dmat4& world_from_camera) {
    PlacedCamera camera;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) camera.orientation(row, column) = world_from_camera[column][row];
        camera.centre(column) = world_from_camera[3][column];
    }
    return camera;
}

Matrix3d rotation_about(const Vector3d& axis, double angle_rad) {
    return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}

// World direction that is most constant in all camera frames, pointing up in the images. Nothing if a second direction
// is as constant: then the cameras do not rotate.
std::optional<Vector3d> common_axis(const std::vector<PlacedCamera>& cameras) {
    Matrix3d mean = Matrix3d::Zero();
    for (const PlacedCamera& camera : cameras) mean += camera.orientation / static_cast<double>(cameras.size());
    Matrix3d scatter = Matrix3d::Zero();
    for (const PlacedCamera& camera : cameras) {
        const Matrix3d apart = camera.orientation - mean;
        scatter += apart * apart.transpose() / static_cast<double>(cameras.size());
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(scatter);
    constexpr double kLeastTurn = 1e-4;  // about half a degree
    if (solver.info() != Eigen::Success || !(solver.eigenvalues()(1) > kLeastTurn)) return std::nullopt;
    const Vector3d axis = solver.eigenvectors().col(0);
    return mean.col(1).dot(axis) < 0 ? Vector3d(-axis) : axis;
}

// The angle about `axis` that rotates orientation `from` nearest to `to`.
double angle_between(const Vector3d& axis, const Matrix3d& from, const Matrix3d& to) {
    const Matrix3d q = to * from.transpose();
    const Vector3d twist(q(2, 1) - q(1, 2), q(0, 2) - q(2, 0), q(1, 0) - q(0, 1));
    return std::atan2(axis.dot(twist), q.trace() - axis.dot(q * axis));
}

// Least-squares circle `centre` = axis + arm rotated by -angle, in the plane perpendicular to the axis as complex
// numbers.
struct Circle {
    Vector3d arm = Vector3d::Zero();  // from the axis to the camera at angle 0, perpendicular to the axis
    double misfit = 0;                // relative to the arm's length, heights included
};
Circle fitted_circle(const std::vector<PlacedCamera>& cameras, const Vector3d& axis,
                     const std::vector<double>& angles_rad) {
    using Complex = std::complex<double>;
    const Vector3d first = axis.unitOrthogonal();
    const Vector3d second = axis.cross(first);
    Vector3d mean = Vector3d::Zero();
    for (const PlacedCamera& camera : cameras) mean += camera.centre / static_cast<double>(cameras.size());
    const auto n = static_cast<double>(cameras.size());
    Complex sum_turn = 0;
    Complex sum_turned_back = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Vector3d p = cameras[i].centre - mean;
        const Complex turn = std::polar(1.0, -angles_rad[i]);
        sum_turn += turn;
        sum_turned_back += std::conj(turn) * Complex(first.dot(p), second.dot(p));
    }
    // p_i = c + turn_i w with sum p_i = 0, so c = -w sum(turn) / n, and w from the other normal equation.
    const Complex w = sum_turned_back / (n - std::norm(sum_turn) / n);
    const Complex c = -w * sum_turn / n;
    double sum = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Vector3d p = cameras[i].centre - mean;
        const Complex off = Complex(first.dot(p), second.dot(p)) - c - std::polar(1.0, -angles_rad[i]) * w;
        sum += std::norm(off) + axis.dot(p) * axis.dot(p);
    }
    Circle circle;
    circle.arm = first * w.real() + second * w.imag();
    circle.misfit = std::sqrt(sum / n) / circle.arm.norm();
    return circle;
}

// Decomposes Rz(roll) Rx(tilt) Ry(pan).
CameraPose pose_of(const Matrix3d& camera_from_table) {
    CameraPose pose;
    pose.tilt_rad = std::asin(std::clamp(camera_from_table(2, 1), -1.0, 1.0));
    pose.roll_rad = std::atan2(-camera_from_table(0, 1), camera_from_table(1, 1));
    pose.pan_rad = std::atan2(-camera_from_table(2, 0), camera_from_table(2, 2));
    return pose;
}

}  // namespace

Matrix3d nearest_rotation(const Matrix3d& matrix) {
    const Eigen::JacobiSVD<Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix3d sign = Matrix3d::Identity();
    sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    return svd.matrixU() * sign * svd.matrixV().transpose();
}

Result<TurntableFit> fit_turn_to_cameras(std::span<const glm::dmat4> world_from_camera, const std::string& where) {
    if (world_from_camera.size() < 3) {
        return Error{where + ": has " + std::to_string(world_from_camera.size()) +
                     " cameras; at least 3 are needed to find the axis that they turn about"};
    }
    std::vector<PlacedCamera> cameras;
    for (const glm::dmat4& each : world_from_camera) cameras.push_back(placed_camera(each));
    const auto axis = common_axis(cameras);
    if (!axis)
        return Error{where + ": its cameras have no rotation relative to each other; check that it is of a turntable"};

    TurntableFit turn;
    turn.angles_rad.push_back(0);
    for (std::size_t i = 1; i < cameras.size(); ++i) {
        // The object turns by as much as the camera seems to turn in the opposite direction.
        const double angle = -angle_between(*axis, cameras[0].orientation, cameras[i].orientation);
        const double before = turn.angles_rad.back();
        turn.angles_rad.push_back(before + std::remainder(angle - before, 2 * kPi));
    }
    Matrix3d sum = Matrix3d::Zero();
    for (std::size_t i = 0; i < cameras.size(); ++i)
        sum += rotation_about(*axis, turn.angles_rad[i]) * cameras[i].orientation;
    const Matrix3d at_zero = nearest_rotation(sum);
    double squares = 0;
    std::size_t worst = 0;
    double most = 0;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Matrix3d off = rotation_about(*axis, turn.angles_rad[i]) * cameras[i].orientation * at_zero.transpose();
        const double misfit_rad = Eigen::AngleAxisd(nearest_rotation(off)).angle();
        squares += misfit_rad * misfit_rad;
        if (misfit_rad > most) worst = i;
        most = std::max(most, misfit_rad);
    }
    const Circle circle = fitted_circle(cameras, *axis, turn.angles_rad);
    turn.orientation_misfit_deg = degrees(std::sqrt(squares / static_cast<double>(cameras.size())));
    turn.place_misfit = circle.misfit;
    // Negated comparisons refuse NaN, too.
    if (!(turn.orientation_misfit_deg <= kMaxOrientationMisfit_deg)) {
        return Error{where + ": is not of a turntable: its cameras' directions are off a turn about a single axis by " +
                     format_fixed(turn.orientation_misfit_deg, 2) + " degrees, most in view " +
                     std::to_string(worst + 1) + "; at most " + format_fixed(kMaxOrientationMisfit_deg, 0) +
                     " is allowed"};
    }
    if (!(turn.place_misfit <= kMaxPlaceMisfit)) {
        return Error{where +
                     ": is not of a turntable: its cameras' positions are off a circle about a single axis by " +
                     format_fixed(100 * turn.place_misfit, 1) + " % of their distance; at most " +
                     format_fixed(100 * kMaxPlaceMisfit, 0) + " % is allowed"};
    }

    Matrix3d world_from_table;
    world_from_table.col(1) = *axis;
    world_from_table.col(2) = circle.arm.normalized();
    world_from_table.col(0) = axis->cross(circle.arm.normalized());
    turn.pose = pose_of(at_zero.transpose() * world_from_table);
    return turn;
}

}  // namespace rs::capture
