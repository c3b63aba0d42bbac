#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/reprojection.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <array>
#include <cmath>
#include <vector>

namespace rs::capture {

void silence_ceres() {
    static const bool done = [] {
        FLAGS_minloglevel = google::GLOG_FATAL;  // failed steps are part of a solver's life; the summary tells the rest
        return true;
    }();
    static_cast<void>(done);
}

namespace {

struct LensPrior {
    glm::dvec2 middle;
    double width;
    double noise_px;

    template <class T>
    bool operator()(const T* lens, T* residuals) const {
        residuals[0] = (lens[1] - T(middle.x)) * T(noise_px / (kPriorPrincipalPoint * width));
        residuals[1] = (lens[2] - T(middle.y)) * T(noise_px / (kPriorPrincipalPoint * width));
        residuals[2] = lens[3] * T(noise_px / kPriorK1);
        residuals[3] = lens[4] * T(noise_px / kPriorK2);
        return true;
    }
};

// Holds those of a block's numbers whose flag is false.
void hold(ceres::Problem& problem, double* block, const std::vector<bool>& free) {
    std::vector<int> held;
    for (std::size_t i = 0; i < free.size(); ++i) {
        if (!free[i]) held.push_back(static_cast<int>(i));
    }
    if (held.empty()) return;
    if (held.size() == free.size()) {
        problem.SetParameterBlockConstant(block);
    } else {
        problem.SetManifold(block, new ceres::SubsetManifold(static_cast<int>(free.size()), held));
    }
}

}  // namespace

std::optional<double> adjust(Bundle& bundle, const BundleOptions& options) {
    TurntableModel& model = bundle.model;
    const BundleFreedom& free = options.free;
    std::array<double, 5> lens{model.lens.f_px, model.lens.cx, model.lens.cy, model.lens.k1, model.lens.k2};
    std::array<double, 3> pose{model.pose.pan_rad, model.pose.tilt_rad, model.pose.roll_rad};
    const bool common = free.angles == AngleFreedom::kCommonStep;
    double step =
        model.angles_rad.size() > 1 ? model.angles_rad.back() / static_cast<double>(model.angles_rad.size() - 1) : 0;

    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::CauchyLoss loss(options.loss_px);
    PosedTurn directions(pose, common ? &step : nullptr, model.angles_rad);
    ownership.evaluation_callback = &directions;
    ceres::Problem problem(ownership);
    auto* ordering = new ceres::ParameterBlockOrdering;
    int observations = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            double* angle = common ? &step : &model.angles_rad[static_cast<std::size_t>(seen.view)];
            problem.AddResidualBlock(new Reprojection(seen, common ? static_cast<double>(seen.view) : 1.0, &directions),
                                     &loss, lens.data(), pose.data(), angle, &bundle.points[i].x);
            ordering->AddElementToGroup(angle, 1);
            ++observations;
        }
        if (!bundle.tracks[i].seen.empty()) ordering->AddElementToGroup(&bundle.points[i].x, 0);
    }
    if (observations == 0) {
        delete ordering;
        return std::nullopt;
    }
    ordering->AddElementToGroup(lens.data(), 1);
    ordering->AddElementToGroup(pose.data(), 1);
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<LensPrior, 4, 5>(new LensPrior{
            {model.lens.width / 2.0, model.lens.height / 2.0}, static_cast<double>(model.lens.width), options.loss_px}),
        nullptr, lens.data());
    hold(problem, lens.data(), {free.f, free.principal_point, free.principal_point, free.k1, free.k2});
    hold(problem, pose.data(), {free.pan, free.tilt, free.roll});
    if (free.f) problem.SetParameterLowerBound(lens.data(), 0, 0.1 * model.lens.width);
    if (common) {
        // nothing to hold
    } else if (free.angles == AngleFreedom::kHeld) {
        for (double& angle : model.angles_rad) {
            if (problem.HasParameterBlock(&angle)) problem.SetParameterBlockConstant(&angle);
        }
    } else if (problem.HasParameterBlock(model.angles_rad.data())) {
        problem.SetParameterBlockConstant(model.angles_rad.data());
    }

    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.linear_solver_ordering.reset(ordering);
    solver.max_num_iterations = options.most_iterations;
    solver.function_tolerance = options.enough;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    silence_ceres();
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (!summary.IsSolutionUsable()) return std::nullopt;
    model.lens.f_px = lens[0];
    model.lens.cx = lens[1];
    model.lens.cy = lens[2];
    model.lens.k1 = lens[3];
    model.lens.k2 = lens[4];
    model.pose = {pose[0], pose[1], pose[2]};
    if (common) {
        for (std::size_t i = 0; i < model.angles_rad.size(); ++i) model.angles_rad[i] = static_cast<double>(i) * step;
    }
    return 2 * summary.final_cost / observations;
}

}  // namespace rs::capture
