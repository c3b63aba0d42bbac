#include "capture/calibration/board/board_initialization.hpp"

#include "capture/calibration/model/turntable_fit.hpp"
#include "rayspace/base/conventions.hpp"

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::capture {
namespace {

// The camera's pose relative to the board: p_in_camera = rotation * p_in_board + translation, in mm, camera axes as in
// turntable_model.hpp.
struct BoardPose {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
};

// Homography from (u, v) in units of `unit_mm` to directions (x, y, 1), y down, of a camera of focal length `unit_px`.
// Nothing if the view has too few corners.
std::optional<Eigen::Matrix3d> homography(const BoardCorners& view, const BoardDesign& design, const Lens& lens,
                                          double unit_px, double unit_mm) {
    if (!has_board(view, design)) return std::nullopt;
    std::vector<cv::Point2d> from, to;
    for (const DetectedCorner& seen : view.corners) {
        const glm::dvec2 at = corner_mm(design, seen.corner) / unit_mm;
        glm::dvec2 p = (seen.p - glm::dvec2(lens.cx, lens.cy)) / unit_px;
        if (lens.k1 != 0 || lens.k2 != 0) {
            const auto direction = undistorted(lens, seen.p);
            if (!direction) continue;
            p = *direction * (lens.f_px / unit_px);
        }
        from.emplace_back(at.x, at.y);
        to.emplace_back(p.x, p.y);
    }
    if (from.size() < kFewestCornersOfView) return std::nullopt;
    cv::Mat h;
    try {
        h = cv::findHomography(from, to, 0);
    } catch (const cv::Exception&) {
        return std::nullopt;
    }
    if (h.empty() || !cv::checkRange(h)) return std::nullopt;
    Eigen::Matrix3d result;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) result(y, x) = h.at<double>(y, x);
    }
    return result;
}

double board_size_mm(const BoardDesign& design) {
    return design.square_mm * std::max(design.squares_x, design.squares_y);
}

std::optional<BoardPose> pose_from(Eigen::Matrix3d h, double unit_mm) {
    if (h(2, 2) < 0) h = -h;  // in front of the camera
    Eigen::Matrix3d frame = h;
    frame.col(2) = h.col(0).cross(h.col(1));
    const Eigen::Matrix3d turned = nearest_rotation(frame);
    // Half the sum of the singular values of the first two columns.
    const double scale = turned.leftCols<2>().cwiseProduct(h.leftCols<2>()).sum() / 2;
    if (!(scale > 1e-12)) return std::nullopt;
    const Eigen::Vector3d flip(1, -1, -1);  // from y down, z forward to y up, z backward
    BoardPose pose;
    pose.rotation.col(0) = flip.cwiseProduct(turned.col(0));
    pose.rotation.col(2) = flip.cwiseProduct(turned.col(1));
    pose.rotation.col(1) = pose.rotation.col(2).cross(pose.rotation.col(0));
    pose.translation = flip.cwiseProduct(h.col(2)) * (unit_mm / scale);
    return pose;
}

struct Axis {
    Eigen::Vector3d direction;      // up, the direction of the printed side
    Eigen::Vector3d closest_point;  // to the camera, mm
};

std::optional<Axis> axis_of(const std::vector<BoardPose>& poses) {
    // The board's directions rotate about the axis, so their scatter is smallest along it.
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Eigen::Vector3d face = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const BoardPose& pose : poses) mean += pose.rotation.col(k) / static_cast<double>(poses.size());
        for (const BoardPose& pose : poses) {
            const Eigen::Vector3d d = pose.rotation.col(k) - mean;
            spread += d * d.transpose();
        }
        if (k == 1) face = mean;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(spread);
    if (directions.info() != Eigen::Success || !(directions.eigenvalues()(1) > 1e-6)) return std::nullopt;
    Axis axis{directions.eigenvectors().col(0), {}};
    if (axis.direction.dot(face) < 0) axis.direction = -axis.direction;
    // A point b of the board that is fixed in the camera frame, at c: rotation * b + translation = c for all views.
    // Both may slide along the axis; the solution of minimum norm is taken.
    cv::Mat_<double> a(3 * static_cast<int>(poses.size()), 6, 0.0), rhs(a.rows, 1);
    for (int row = 0; row < a.rows; ++row) {
        const BoardPose& pose = poses[static_cast<std::size_t>(row / 3)];
        const int k = row % 3;
        for (int column = 0; column < 3; ++column) a(row, column) = pose.rotation(k, column);
        a(row, 3 + k) = -1;
        rhs(row, 0) = -pose.translation(k);
    }
    cv::SVD svd(a);
    cv::Mat_<double> values = svd.w;
    for (double& value : values) value = value < 1e-3 * values(0, 0) ? 0 : value;
    cv::Mat_<double> solution;
    svd.backSubst(rhs, solution);
    const Eigen::Vector3d point(solution(3, 0), solution(4, 0), solution(5, 0));
    axis.closest_point = point - axis.direction * axis.direction.dot(point);
    return axis.closest_point.norm() > 1e-9 && axis.closest_point.allFinite() ? std::optional(axis) : std::nullopt;
}

double wrapped(double angle) {
    return std::remainder(angle, 2 * kPi);
}

}  // namespace

bool has_board(const BoardCorners& view, const BoardDesign& design) {
    if (view.corners.size() < kFewestCornersOfView) return false;
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    std::vector<Eigen::Vector2d> points;
    for (const DetectedCorner& seen : view.corners) {
        const glm::dvec2 p = corner_mm(design, seen.corner) / design.square_mm;
        points.emplace_back(p.x, p.y);
        mean += points.back() / static_cast<double>(view.corners.size());
    }
    for (const Eigen::Vector2d& p : points) spread += (p - mean) * (p - mean).transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
    solver.computeDirect(spread, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()(0) > 0.4;  // squares^2; six corners in two rows have 1.5
}

std::vector<double> estimate_focal_lengths(std::span<const BoardCorners> views, const BoardDesign& design,
                                           const Lens& lens) {
    const double side_px = std::max(lens.width, lens.height);
    // With w = 1 / f^2 the images of the board's two directions are perpendicular and of equal length: linear in w.
    double square = 0, product = 0;
    for (const BoardCorners& view : views) {
        auto h = homography(view, design, lens, side_px, board_size_mm(design));
        if (!h) continue;
        *h /= h->topLeftCorner<2, 2>().norm();
        const Eigen::Vector3d a = h->col(0), b = h->col(1);
        for (const auto& [p, q] :
             {std::pair(a.head<2>().dot(b.head<2>()), a(2) * b(2)),
              std::pair(a.head<2>().squaredNorm() - b.head<2>().squaredNorm(), a(2) * a(2) - b(2) * b(2))}) {
            square += q * q;
            product -= p * q;
        }
    }
    std::vector<double> likely;
    // p / f^2 + q = 0, so f^2 = -p / q in the least-squares sense.
    if (product > 0) {
        const double f2 = product / square;
        if (f2 > 0.04 && f2 < 900) likely.push_back(std::sqrt(f2) * side_px);
    }
    for (const double f : {1.3, 0.8, 2.2, 4.0, 8.0}) likely.push_back(f * side_px);
    return likely;
}

std::optional<BoardTurn> initialize_board_turn(std::span<const BoardCorners> views, const BoardDesign& design,
                                               const Lens& lens) {
    std::vector<BoardPose> poses;
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const double unit_mm = board_size_mm(design);
        const auto h = homography(views[i], design, lens, lens.f_px, unit_mm);
        const auto pose = h ? pose_from(*h, unit_mm) : std::nullopt;
        if (!pose) continue;
        poses.push_back(*pose);
        shown.push_back(i);
    }
    if (poses.size() < 3) return std::nullopt;
    const auto axis = axis_of(poses);
    if (!axis) return std::nullopt;

    const double distance_mm = axis->closest_point.norm();
    Eigen::Matrix3d camera_from_table;
    camera_from_table.col(1) = axis->direction;
    camera_from_table.col(2) = -axis->closest_point / distance_mm;
    camera_from_table.col(0) = camera_from_table.col(1).cross(camera_from_table.col(2));
    BoardTurn turn;
    turn.model.lens = lens;
    turn.model.pose.tilt_rad = std::asin(std::clamp(camera_from_table(2, 1), -1.0, 1.0));
    turn.model.pose.pan_rad = std::atan2(-camera_from_table(2, 0), camera_from_table(2, 2));
    turn.model.pose.roll_rad = std::atan2(-camera_from_table(0, 1), camera_from_table(1, 1));
    turn.model.angles_rad.assign(views.size(), 0);

    const Eigen::Matrix3d first = camera_from_table.transpose() * poses.front().rotation;
    Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double before = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Eigen::Matrix3d here = camera_from_table.transpose() * poses[i].rotation;
        const Eigen::Matrix3d moved = here * first.transpose();
        const double angle =
            before + wrapped(std::atan2(moved(0, 2) - moved(2, 0), moved(0, 0) + moved(2, 2)) - before);
        turn.model.angles_rad[shown[i]] = before = angle;
        const Eigen::Matrix3d back = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
        rotations += back * here;
        middle += back * (camera_from_table.transpose() * (poses[i].translation - axis->closest_point));
    }
    middle /= static_cast<double>(poses.size()) * distance_mm;
    const Eigen::Matrix3d rotation = nearest_rotation(rotations);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) turn.board.object_from_board[column][row] = rotation(row, column);
    }
    turn.board.middle = {middle.x(), middle.y(), middle.z()};
    turn.board.units_per_mm = 1 / distance_mm;
    return turn;
}

}  // namespace rs::capture
