#include "capture/calibration/board/board_bundle.hpp"

#include "capture/calibration/model/projection.hpp"
#include "capture/calibration/points/model_covariance.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rs::capture {
namespace {

// Blocks: lens (f, cx, cy, k1, k2), pose (pan, tilt, roll), board (angle-axis vector, middle, log of units per mm),
// angle.
struct CornerResidual {
    BoardObservation seen;
    double turns = 1;  // the view's angle is this many times its parameter block
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

// Weak lens prior: the standard deviations of bundle.hpp, and a factor of e for the focal length.
struct BoardLensPrior {
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

// Parameter blocks of a turn for Ceres.
struct Unknowns {
    std::array<double, 5> lens;
    std::array<double, 3> pose;
    std::array<double, 7> board;
    std::vector<double> angles;  // [view]; kCommonStep: [0] only, the step

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

// Fills `problem`; the parameter blocks are owned by `unknowns`.
void build_problem(ceres::Problem& problem, Unknowns& unknowns, const Lens& lens,
                   std::span<const BoardObservation> seen, const BoardBundleOptions& options) {
    const bool common = options.free.angles == AngleFreedom::kCommonStep;
    const BundleFreedom& free = options.free;
    auto* loss = new ceres::HuberLoss(3);
    for (const BoardObservation& one : seen) {
        double* angle = common ? unknowns.angles.data() : &unknowns.angles[static_cast<std::size_t>(one.view)];
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<CornerResidual, 2, 5, 3, 7, 1>(new CornerResidual{
                                     one, common ? static_cast<double>(one.view) : 1.0, options.noise_px}),
                                 loss, unknowns.lens.data(), unknowns.pose.data(), unknowns.board.data(), angle);
        if (!common && (free.angles == AngleFreedom::kConstant || one.view == 0))
            problem.SetParameterBlockConstant(angle);
    }
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<BoardLensPrior, 5, 5>(
                                 new BoardLensPrior{1.3 * std::max(lens.width, lens.height), 0.5 * lens.width,
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
        build_problem(problem, unknowns, turn.model.lens, seen, options);
        ceres::Solver::Options how;
        how.linear_solver_type = ceres::DENSE_SCHUR;  // each observation depends on one angle
        how.max_num_iterations = options.max_iterations;
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

ModelDeviations board_standard_deviations(const BoardTurn& turn, std::span<const BoardObservation> seen,
                                          const BoardBundleOptions& options) {
    const std::size_t views = turn.model.angles_rad.size();
    ModelDeviations deviations;
    deviations.angles_rad.assign(views, std::numeric_limits<double>::infinity());
    if (seen.empty()) return deviations;
    Unknowns unknowns(turn, options.free.angles);
    ceres::Problem problem;
    build_problem(problem, unknowns, turn.model.lens, seen, options);

    ceres::Problem::EvaluateOptions order;
    std::vector<bool> is_seen(views, false);
    for (const BoardObservation& one : seen) is_seen[static_cast<std::size_t>(one.view)] = true;
    const ParameterIndices places(options.free, is_seen);
    const auto is_free = [](int place) { return place >= 0; };
    if (std::any_of(places.camera.begin(), places.camera.begin() + 5, is_free)) {
        order.parameter_blocks.push_back(unknowns.lens.data());
    }
    if (std::any_of(places.camera.begin() + 5, places.camera.end(), is_free)) {
        order.parameter_blocks.push_back(unknowns.pose.data());
    }
    for (std::size_t view = 0; view < views; ++view) {
        if (is_free(places.angles[view])) order.parameter_blocks.push_back(&unknowns.angles[view]);
    }
    if (is_free(places.step)) order.parameter_blocks.push_back(unknowns.angles.data());
    order.parameter_blocks.push_back(unknowns.board.data());
    ceres::CRSMatrix jacobian;
    if (!problem.Evaluate(order, nullptr, nullptr, nullptr, &jacobian)) return deviations;
    using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const Eigen::Map<const Sparse> j(jacobian.num_rows, jacobian.num_cols,
                                     static_cast<Eigen::Index>(jacobian.values.size()), jacobian.rows.data(),
                                     jacobian.cols.data(), jacobian.values.data());
    Eigen::MatrixXd information = Eigen::MatrixXd(Sparse(j.transpose() * j));
    // The unknowns differ greatly in scale (pixels, radians), so the diagonal is normalized to ones.
    const Eigen::VectorXd size = information.diagonal().cwiseSqrt().cwiseMax(1e-300);
    information = size.cwiseInverse().asDiagonal() * information * size.cwiseInverse().asDiagonal();
    const Eigen::LLT<Eigen::MatrixXd> solver(information);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-15)) return deviations;
    const auto identity = Eigen::MatrixXd::Identity(information.rows(), information.cols());
    Eigen::MatrixXd covariance = solver.solve(identity);
    covariance = size.cwiseInverse().asDiagonal() * covariance * size.cwiseInverse().asDiagonal();

    const Lens& lens = turn.model.lens;
    return standard_deviations(turn.model, places, covariance,
                               0.5 * (has_sideways_axis(turn.model.pose) ? lens.width : lens.height));
}

}  // namespace rs::capture
