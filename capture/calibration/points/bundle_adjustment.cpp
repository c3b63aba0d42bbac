#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/reprojection.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace rs::capture {

void silence_ceres() {
    static const bool done = [] {
        FLAGS_minloglevel = google::GLOG_FATAL;  // failed steps are normal; the summary reports real failures
        return true;
    }();
    static_cast<void>(done);
}

namespace {

constexpr double kShortestFocalLength = 0.1;  // relative to the image width

// Parameter blocks for Ceres: the free camera numbers as one block, so that no block is partly constant; angles are
// those of the model itself.
class ParameterBlocks {
public:
    ParameterBlocks(TurntableModel& model, const BundleFreedom& free)
        : model_(model), angles_(free.angles), camera_{&model.lens.f_px,     &model.lens.cx,      &model.lens.cy,
                                                       &model.lens.k1,       &model.lens.k2,      &model.pose.pan_rad,
                                                       &model.pose.tilt_rad, &model.pose.roll_rad} {
        const std::array<bool, kCameraParameters> is_free{
            free.f, free.principal_point, free.principal_point, free.k1, free.k2, free.pan, free.tilt, free.roll};
        for (std::size_t k = 0; k < kCameraParameters; ++k) {
            if (!is_free[k]) continue;
            places_.push_back(k);
            values_.push_back(*camera_[k]);
        }
        const std::size_t views = model.angles_rad.size();
        if (views > 1) step_rad_ = model.angles_rad.back() / static_cast<double>(views - 1);
    }

    // Indices of the free camera numbers, in the order of their parameter block.
    [[nodiscard]] const std::vector<std::size_t>& camera_indices() const { return places_; }
    [[nodiscard]] double* camera() { return values_.data(); }

    // Null if the view's angle is constant.
    [[nodiscard]] double* angle(int view) {
        if (angles_ == AngleFreedom::kCommonStep) return &step_rad_;
        if (angles_ == AngleFreedom::kConstant || view == 0) return nullptr;
        return &model_.angles_rad[static_cast<std::size_t>(view)];
    }
    // Rotation of a view per unit of angle(view).
    [[nodiscard]] double turns(int view) const { return angles_ == AngleFreedom::kCommonStep ? view : 1; }

    void write_to_model() {
        for (std::size_t i = 0; i < places_.size(); ++i) *camera_[places_[i]] = values_[i];
        if (angles_ != AngleFreedom::kCommonStep) return;
        for (std::size_t i = 0; i < model_.angles_rad.size(); ++i) {
            model_.angles_rad[i] = static_cast<double>(i) * step_rad_;
        }
    }

private:
    TurntableModel& model_;
    AngleFreedom angles_;
    std::array<double*, kCameraParameters> camera_;  // pointers into the model
    std::vector<std::size_t> places_;
    std::vector<double> values_;
    double step_rad_ = 0;
};

// State shared by all observations, computed before each evaluation.
class EvaluatedModel final : public ceres::EvaluationCallback {
public:
    EvaluatedModel(const TurntableModel& model, ParameterBlocks& numbers, bool f_is_free)
        : model_(model), numbers_(numbers), f_is_free_(f_is_free) {}

    void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) override {
        if (!new_evaluation_point) return;
        numbers_.write_to_model();
        reprojections_.emplace(model_);
        is_valid_lens_ = !f_is_free_ || model_.lens.f_px >= kShortestFocalLength * model_.lens.width;
    }

    // False if a step has led to an invalid lens. Used instead of a bound, which would make Ceres do a line search at
    // each step.
    [[nodiscard]] bool is_valid_lens() const { return is_valid_lens_; }
    [[nodiscard]] const Lens& lens() const { return model_.lens; }
    [[nodiscard]] const Reprojections& reprojections() const { return *reprojections_; }

private:
    const TurntableModel& model_;
    ParameterBlocks& numbers_;
    bool f_is_free_;
    std::optional<Reprojections> reprojections_;
    bool is_valid_lens_ = true;
};

// Parameter blocks are the free camera numbers, the view's angle and the point; the first two only if they exist.
class ReprojectionCost final : public ceres::CostFunction {
public:
    ReprojectionCost(const EvaluatedModel& now, ParameterBlocks& numbers, const Observation& seen)
        : now_(now), places_(numbers.camera_indices()), seen_(seen), turns_(numbers.turns(seen.view)) {
        if (!places_.empty()) mutable_parameter_block_sizes()->push_back(static_cast<int>(places_.size()));
        has_angle_ = numbers.angle(seen.view) != nullptr;
        if (has_angle_) mutable_parameter_block_sizes()->push_back(1);
        mutable_parameter_block_sizes()->push_back(3);
        set_num_residuals(2);
    }

    bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
        if (!now_.is_valid_lens()) return false;
        const double* at = parameters[parameter_block_sizes().size() - 1];
        const glm::dvec3 point(at[0], at[1], at[2]);
        if (jacobians == nullptr) {
            const auto off = residual(now_.reprojections().turn(), point, seen_);
            if (off) write(seen_.weight * *off, residuals);
            return off.has_value();
        }
        const auto reprojection = now_.reprojections().of(point, seen_);
        if (!reprojection) return false;
        write(reprojection->residual, residuals);
        if (!places_.empty()) {
            if (double* by_camera = *jacobians++) {
                for (std::size_t i = 0; i < places_.size(); ++i) {
                    write(reprojection->by_camera[places_[i]], by_camera + i, places_.size());
                }
            }
        }
        if (has_angle_) {
            if (double* by_angle = *jacobians++) write(turns_ * reprojection->by_angle, by_angle);
        }
        if (double* by_point = *jacobians) {
            for (std::size_t k = 0; k < 3; ++k) write(reprojection->by_point[k], by_point + k, 3);
        }
        return true;
    }

private:
    // Writes a vector as a column of two rows.
    static void write(const glm::dvec2& v, double* column, std::size_t row = 1) {
        column[0] = v.x;
        column[row] = v.y;
    }

    const EvaluatedModel& now_;
    const std::vector<std::size_t>& places_;
    const Observation& seen_;
    double turns_;
    bool has_angle_;
};

// Lens prior. The parameter block is the free camera numbers; constants are included, so that costs are comparable.
class LensPrior final : public ceres::CostFunction {
public:
    LensPrior(const EvaluatedModel& now, const Lens& lens, const std::vector<std::size_t>& places, double noise_px)
        : now_(now), places_(places), middle_(lens.width / 2.0, lens.height / 2.0) {
        const double per_middle = noise_px / (kPriorPrincipalPoint * lens.width);
        per_deviation_ = {per_middle, per_middle, noise_px / kPriorK1, noise_px / kPriorK2};
        mutable_parameter_block_sizes()->push_back(static_cast<int>(places.size()));
        set_num_residuals(static_cast<int>(per_deviation_.size()));
    }

    bool Evaluate(const double* const* /*parameters*/, double* residuals, double** jacobians) const override {
        const Lens& lens = now_.lens();
        const std::array<double, 4> off{lens.cx - middle_.x, lens.cy - middle_.y, lens.k1, lens.k2};
        for (std::size_t i = 0; i < off.size(); ++i) residuals[i] = off[i] * per_deviation_[i];
        if (jacobians == nullptr || jacobians[0] == nullptr) return true;
        std::fill_n(jacobians[0], off.size() * places_.size(), 0.0);
        for (std::size_t column = 0; column < places_.size(); ++column) {
            const std::size_t place = places_[column];
            if (place < CameraParameter::kCx || place > CameraParameter::kK2) continue;
            const std::size_t row = place - CameraParameter::kCx;
            jacobians[0][row * places_.size() + column] = per_deviation_[row];
        }
        return true;
    }

private:
    const EvaluatedModel& now_;
    const std::vector<std::size_t>& places_;
    glm::dvec2 middle_;
    std::array<double, 4> per_deviation_{};
};

}  // namespace

std::optional<double> adjust(Bundle& bundle, const BundleOptions& options) {
    const int observations = observation_count(bundle);
    if (observations == 0) return std::nullopt;
    ParameterBlocks numbers(bundle.model, options.free);
    EvaluatedModel now(bundle.model, numbers, options.free.f);
    ceres::CauchyLoss loss(options.loss_px);
    LensPrior prior(now, bundle.model.lens, numbers.camera_indices(), options.loss_px);
    std::deque<ReprojectionCost> costs;

    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ownership.disable_all_safety_checks = true;
    ownership.evaluation_callback = &now;
    ceres::Problem problem(ownership);
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    std::vector<double*> blocks;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            blocks.clear();
            if (!numbers.camera_indices().empty()) blocks.push_back(numbers.camera());
            if (double* angle = numbers.angle(seen.view)) {
                blocks.push_back(angle);
                ordering->AddElementToGroup(angle, 1);
            }
            blocks.push_back(&bundle.points[i].x);
            problem.AddResidualBlock(&costs.emplace_back(now, numbers, seen), &loss, blocks);
        }
        if (!bundle.tracks[i].seen.empty()) ordering->AddElementToGroup(&bundle.points[i].x, 0);
    }
    if (!numbers.camera_indices().empty()) {
        // In a group of its own: within a group, Ceres orders the blocks by their addresses.
        ordering->AddElementToGroup(numbers.camera(), 2);
        problem.AddResidualBlock(&prior, nullptr, numbers.camera());
    }

    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_SCHUR;
    solver.linear_solver_ordering = ordering;
    solver.max_num_iterations = options.max_iterations;
    solver.function_tolerance = options.function_tolerance;
    solver.num_threads = 1;
    solver.logging_type = ceres::SILENT;
    silence_ceres();
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (!summary.IsSolutionUsable()) return std::nullopt;
    numbers.write_to_model();
    return 2 * summary.final_cost / observations;
}

}  // namespace rs::capture
