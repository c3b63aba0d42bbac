#include "capture/calibration/board_bundle.hpp"

#include "capture/calibration/bundle_deviations.hpp"
#include "capture/calibration/projection.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::capture {
namespace {

// Blocks: lens (f, cx, cy, k1, k2), pose (pan, tilt, roll), board (turning vector, middle, log of units per mm), angle.
struct CornerResidual {
    BoardObservation seen;
    double turns = 1;  // the angle is this many times its block
    double noise_px = 1;

    template <class T>
    bool operator()(const T* lens, const T* pose, const T* board, const T* angle, T* residuals) const {
        using std::exp;
        const T scale = exp(board[6]);
        const std::array<T, 3> at{scale * seen.at_mm.x, T(0), scale * seen.at_mm.y};
        std::array<T, 3> point;
        ceres::AngleAxisRotatePoint(board, at.data(), point.data());
        for (std::size_t k = 0; k < 3; ++k) point[k] += board[3 + k];
        const T turned_by = angle[0] * turns;
        if (!project_turned(lens, pose, turned_by, point.data(), residuals)) return false;
        residuals[0] = (residuals[0] - seen.seen.x) / noise_px;
        residuals[1] = (residuals[1] - seen.seen.y) / noise_px;
        return true;
    }
};

// What lenses are like, as one weak observation each (the priors of bundle.hpp; the focal length within a factor e).
struct LensPrior {
    double f_px = 1, cx = 0, cy = 0, principal_px = 1;

    template <class T>
    bool operator()(const T* lens, T* residuals) const {
        using std::log;
        if (lens[0] <= T(0)) return false;
        residuals[0] = log(lens[0] / f_px);
        residuals[1] = (lens[1] - cx) / principal_px;
        residuals[2] = (lens[2] - cy) / principal_px;
        residuals[3] = lens[3] / kPriorK1;
        residuals[4] = lens[4] / kPriorK2;
        return true;
    }
};

// A turn as Ceres sees it.
struct Unknowns {
    std::array<double, 5> lens;
    std::array<double, 3> pose;
    std::array<double, 7> board;
    std::vector<double> angles;  // [view]; kCommonStep: [0] alone, the step

    Unknowns(const BoardTurn& turn, AngleFreedom freedom)
        : lens{turn.model.lens.f_px, turn.model.lens.cx, turn.model.lens.cy, turn.model.lens.k1, turn.model.lens.k2},
          pose{turn.model.pose.pan_rad, turn.model.pose.tilt_rad, turn.model.pose.roll_rad},
          board{},
          angles(turn.model.angles_rad) {
        ceres::RotationMatrixToAngleAxis(&turn.board.object_from_board[0][0], board.data());  // column-major, as glm
        for (std::size_t k = 0; k < 3; ++k) board[3 + k] = turn.board.middle[static_cast<glm::length_t>(k)];
        board[6] = std::log(turn.board.units_per_mm);
        if (freedom == AngleFreedom::kCommonStep) angles = {angles.size() > 1 ? angles[1] : 0.0};
    }

    void write_to(BoardTurn& turn, AngleFreedom freedom) const {
        Lens& l = turn.model.lens;
        l.f_px = lens[0], l.cx = lens[1], l.cy = lens[2], l.k1 = lens[3], l.k2 = lens[4];
        turn.model.pose = {pose[0], pose[1], pose[2]};
        ceres::AngleAxisToRotationMatrix(board.data(), &turn.board.object_from_board[0][0]);
        turn.board.middle = {board[3], board[4], board[5]};
        turn.board.units_per_mm = std::exp(board[6]);
        for (std::size_t i = 0; i < turn.model.angles_rad.size(); ++i) {
            turn.model.angles_rad[i] =
                freedom == AngleFreedom::kCommonStep ? static_cast<double>(i) * angles[0] : angles[i];
        }
    }
};

// Fills `problem`; the blocks stay owned by `unknowns`.
void pose_problem(ceres::Problem& problem, Unknowns& unknowns, const Lens& lens, std::span<const BoardObservation> seen,
                  const BoardBundleOptions& options) {
    const bool common = options.free.angles == AngleFreedom::kCommonStep;
    const BundleFreedom& free = options.free;
    auto* loss = new ceres::HuberLoss(3);
    for (const BoardObservation& one : seen) {
        double* angle = common ? unknowns.angles.data() : &unknowns.angles[static_cast<std::size_t>(one.view)];
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<CornerResidual, 2, 5, 3, 7, 1>(new CornerResidual{
                                     one, common ? static_cast<double>(one.view) : 1.0, options.noise_px}),
                                 loss, unknowns.lens.data(), unknowns.pose.data(), unknowns.board.data(), angle);
        if (!common && (free.angles == AngleFreedom::kHeld || one.view == 0)) problem.SetParameterBlockConstant(angle);
    }
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LensPrior, 5, 5>(
                                 new LensPrior{1.3 * std::max(lens.width, lens.height), 0.5 * lens.width,
                                               0.5 * lens.height, kPriorPrincipalPoint * lens.width}),
                             nullptr, unknowns.lens.data());
    const std::array<bool, 5> lens_free{free.f, free.principal_point, free.principal_point, free.k1, free.k2};
    const std::array<bool, 3> pose_free{free.pan, free.tilt, free.roll};
    const auto hold = [&](double* block, std::span<const bool> is_free) {
        std::vector<int> held;
        for (std::size_t k = 0; k < is_free.size(); ++k) {
            if (!is_free[k]) held.push_back(static_cast<int>(k));
        }
        if (held.size() == is_free.size()) {
            problem.SetParameterBlockConstant(block);
        } else if (!held.empty()) {
            problem.SetManifold(block, new ceres::SubsetManifold(static_cast<int>(is_free.size()), held));
        }
    };
    hold(unknowns.lens.data(), lens_free);
    hold(unknowns.pose.data(), pose_free);
}

double axis_position(const Lens& lens, const CameraPose& pose) {
    return (lies_sideways(pose) ? axis_row(lens, pose, 0.5 * lens.width) : axis_column(lens, pose, 0.5 * lens.height))
        .value_or(0);
}

// Where the unknowns of a block stand in the covariance; -1: held.
struct Places {
    std::vector<int> of_block;
    int next = 0;
    void add(std::span<const bool> is_free) {
        for (const bool one : is_free) of_block.push_back(one ? next++ : -1);
    }
};

}  // namespace

std::optional<glm::dvec2> residual(const BoardTurn& turn, const BoardObservation& seen) {
    const glm::dvec3 at = turn.board.object_from_board * glm::dvec3(seen.at_mm.x, 0, seen.at_mm.y);
    const glm::dvec3 p = turn.board.units_per_mm * at + turn.board.middle;
    const double angle = turn.model.angles_rad[static_cast<std::size_t>(seen.view)];
    const auto pixel = project(turn.model.lens, turn.model.pose, turned(p, angle));
    if (!pixel) return std::nullopt;
    return *pixel - seen.seen;
}

std::optional<double> adjust(BoardTurn& turn, std::span<const BoardObservation> seen,
                             const BoardBundleOptions& options) {
    if (seen.empty()) return std::nullopt;
    Unknowns unknowns(turn, options.free.angles);
    try {
        ceres::Problem problem;
        pose_problem(problem, unknowns, turn.model.lens, seen, options);
        ceres::Solver::Options how;
        how.linear_solver_type = ceres::DENSE_SCHUR;  // each observation knows one angle
        how.max_num_iterations = options.most_iterations;
        how.function_tolerance = 1e-10;
        how.num_threads = 1;
        how.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(how, &problem, &summary);
        if (!summary.IsSolutionUsable() || !std::isfinite(summary.final_cost)) return std::nullopt;
        unknowns.write_to(turn, options.free.angles);
        return 2 * summary.final_cost / static_cast<double>(seen.size());
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

ModelDeviations board_deviations(const BoardTurn& turn, std::span<const BoardObservation> seen,
                                 const BoardBundleOptions& options) {
    const std::size_t views = turn.model.angles_rad.size();
    const bool common = options.free.angles == AngleFreedom::kCommonStep;
    ModelDeviations deviations;
    deviations.angles_rad.assign(views, std::numeric_limits<double>::infinity());
    if (seen.empty()) return deviations;
    Unknowns unknowns(turn, options.free.angles);
    ceres::Problem problem;
    pose_problem(problem, unknowns, turn.model.lens, seen, options);

    ceres::Problem::EvaluateOptions order;
    Places places;  // lens 0..4, pose 5..7, then the angles (or the step)
    const BundleFreedom& free = options.free;
    places.add(std::array<bool, 5>{free.f, free.principal_point, free.principal_point, free.k1, free.k2});
    if (places.next > 0) order.parameter_blocks.push_back(unknowns.lens.data());
    const int before_pose = places.next;
    places.add(std::array<bool, 3>{free.pan, free.tilt, free.roll});
    if (places.next > before_pose) order.parameter_blocks.push_back(unknowns.pose.data());
    std::vector<bool> is_seen(views, false);
    for (const BoardObservation& one : seen) is_seen[static_cast<std::size_t>(one.view)] = true;
    for (std::size_t i = 0; i < unknowns.angles.size(); ++i) {
        const bool is_free = common || (free.angles == AngleFreedom::kEach && i > 0 && is_seen[i]);
        places.add(std::array<bool, 1>{is_free});
        if (is_free) order.parameter_blocks.push_back(&unknowns.angles[i]);
    }
    order.parameter_blocks.push_back(unknowns.board.data());
    ceres::CRSMatrix jacobian;
    if (!problem.Evaluate(order, nullptr, nullptr, nullptr, &jacobian)) return deviations;
    using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const Eigen::Map<const Sparse> j(jacobian.num_rows, jacobian.num_cols,
                                     static_cast<Eigen::Index>(jacobian.values.size()), jacobian.rows.data(),
                                     jacobian.cols.data(), jacobian.values.data());
    Eigen::MatrixXd information = Eigen::MatrixXd(Sparse(j.transpose() * j));
    // Numbers of very different sizes: pixels and radians. Scaled to ones on the diagonal.
    const Eigen::VectorXd size = information.diagonal().cwiseSqrt().cwiseMax(1e-300);
    information = size.cwiseInverse().asDiagonal() * information * size.cwiseInverse().asDiagonal();
    const Eigen::LLT<Eigen::MatrixXd> solver(information);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-15)) return deviations;
    const auto identity = Eigen::MatrixXd::Identity(information.rows(), information.cols());
    Eigen::MatrixXd covariance = solver.solve(identity);
    covariance = size.cwiseInverse().asDiagonal() * covariance * size.cwiseInverse().asDiagonal();

    const auto of = [&](const Eigen::VectorXd& gradient) {
        return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
    };
    const auto one = [&](std::size_t number) {
        const int place = places.of_block[number];
        return place < 0 ? 0.0 : std::sqrt(std::max(0.0, covariance(place, place)));
    };
    deviations.f_px = one(0);
    deviations.cx = one(1);
    deviations.cy = one(2);
    deviations.k1 = one(3);
    deviations.k2 = one(4);
    deviations.tilt_rad = one(6);
    deviations.roll_rad = one(7);
    deviations.axis_direction_rad =
        std::hypot(deviations.tilt_rad, std::cos(turn.model.pose.tilt_rad) * deviations.roll_rad);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(covariance.rows());
    Eigen::VectorXd slopes = zero;
    for (std::size_t k = 0; k < 8; ++k) {
        if (places.of_block[k] < 0) continue;
        const double step = k < 3 ? 1e-3 : 1e-6;
        std::array<double, 2> value{};
        for (std::size_t side = 0; side < 2; ++side) {
            Unknowns moved = unknowns;
            (k < 5 ? moved.lens[k] : moved.pose[k - 5]) += side == 0 ? -step : step;
            BoardTurn there = turn;
            moved.write_to(there, free.angles);
            value[side] = axis_position(there.model.lens, there.model.pose);
        }
        slopes(places.of_block[k]) = (value[1] - value[0]) / (2 * step);
    }
    deviations.axis_position_px = of(slopes);
    for (std::size_t view = 0; view < views; ++view) {  // from the mean: else the first view's error is in all others
        Eigen::VectorXd from_mean = zero;
        for (std::size_t other = 0; !common && other < views; ++other) {
            const int place = places.of_block[8 + other];
            if (place >= 0) from_mean(place) = (other == view ? 1.0 : 0.0) - 1.0 / static_cast<double>(views);
        }
        if (common) from_mean(places.of_block[8]) = static_cast<double>(view) - 0.5 * static_cast<double>(views - 1);
        deviations.angles_rad[view] = of(from_mean);
    }
    return deviations;
}

}  // namespace rs::capture
