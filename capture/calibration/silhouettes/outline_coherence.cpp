#include "capture/calibration/silhouettes/outline_coherence.hpp"

#include "capture/calibration/silhouettes/loose_numbers.hpp"
#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"
#include "capture/calibration/silhouettes/silhouette_coherence.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kMostSteps = 8;
constexpr int kFineSteps = 3;
constexpr double kLittle = 0.1;    // of cost: a step that gains less is not taken
constexpr double kWidth = 0.5;     // of differences, in deviations
constexpr double kOutlier_px = 1;  // of the turn
// Outlines that agree better are those of bodies that look alike from everywhere, and know no more for it.
constexpr double kFinest_px = 0.12;
// Views that contradict a ray by this much less than the strongest do not become the strongest beside it.
constexpr double kVerdictMargin_px = 1.5;
constexpr std::size_t kMostVerdicts = 8;
// A few rays say where the optimum is, all of them where it is exactly.
constexpr std::size_t kCoarseRaysPerView = 100;
// Outlines that leave more than this of the angles' variance are of a body that looks alike from all sides. What they
// say of the camera is in the small print of their errors: it has been seen to bend lens and tilt.
constexpr double kTellsOfAngles = 0.5;

// Shortfalls of some rays.
class CoherentRays final : public OutlineComparison {
public:
    CoherentRays(const LooseNumbers& numbers, const SilhouetteTurn& turn, double picture_px, std::size_t every)
        : numbers_(numbers), turn_(turn), picture_px_(picture_px), rays_{every, {}} {}

    // Px of the turn.
    std::vector<double> residuals(const Eigen::VectorXd& z) override {
        return consistency_residuals_px(turn_, in_turn(z), rays_, &depths_);
    }
    [[nodiscard]] Eigen::VectorXd widths() const override {
        return Eigen::VectorXd::Constant(numbers_.count(), kWidth);
    }

    // Only what contradicts a ray is asked again beside: quick, and near enough to go down by.
    void look_at(const Eigen::VectorXd& z) override {
        if (is_quick_) verdicts_ = ray_verdicts(turn_, in_turn(z), rays_, depths_, kVerdictMargin_px, kMostVerdicts);
    }
    std::vector<double> beside(const Eigen::VectorXd& z) override {
        return is_quick_ ? residuals_by_verdicts(turn_, in_turn(z), rays_, verdicts_) : residuals(z);
    }

    // Beside a body of revolution the few that contradict it would seem to know how it stands.
    void ask_all_views() { is_quick_ = false; }

private:
    [[nodiscard]] TurntableModel in_turn(const Eigen::VectorXd& z) const {
        TurntableModel model = numbers_.at(z);
        model.lens.f_px /= picture_px_;
        model.lens.cx /= picture_px_;
        model.lens.cy /= picture_px_;
        return model;
    }

    const LooseNumbers& numbers_;
    const SilhouetteTurn& turn_;
    double picture_px_;
    RaySelection rays_;
    RayDepths depths_;
    std::vector<RayVerdict> verdicts_;
    bool is_quick_ = true;
};

std::size_t most_rays_of_a_view(const SilhouetteTurn& turn) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < turn.views(); ++i) most = std::max(most, turn.edges(i).size());
    return most;
}

}  // namespace

std::optional<CoherenceFit> fit_coherence(const TurntableModel& model, const NumberPlaces& places,
                                          const Eigen::MatrixXd& covariance, const SilhouetteTurn& turn,
                                          double picture_px, const CoherenceOptions& options) {
    if (places.count == 0 || covariance.rows() != places.count || !covariance.allFinite()) return std::nullopt;
    const LooseNumbers numbers(model, places, covariance, 0.5 * turn.width_px() * picture_px, options.most_directions);
    if (numbers.count() == 0) return std::nullopt;
    const OutlineErrors errors{kIndependentPerView * static_cast<double>(turn.views()), kOutlier_px, kFinest_px, true};
    Eigen::VectorXd z = Eigen::VectorXd::Zero(numbers.count());
    int steps = kMostSteps;
    const std::size_t every = options.few_rays_first ? most_rays_of_a_view(turn) / kCoarseRaysPerView : 1;
    if (every > 1) {
        CoherentRays few(numbers, turn, picture_px, every);
        if (!OutlineAdjustment(few, errors).improve(z, kMostSteps, kLittle)) return std::nullopt;
        steps = kFineSteps;
    }
    CoherentRays rays(numbers, turn, picture_px, 1);
    if (!OutlineAdjustment(rays, errors).improve(z, steps, kLittle)) return std::nullopt;
    rays.ask_all_views();
    OutlineAdjustment found(rays, errors);
    const Eigen::MatrixXd information = found.information(z);
    CoherenceFit fit{numbers.at(z), numbers.told(covariance, information, options.untold_together), 0};
    fit.consistency_residual_px = picture_px * rms_px(found.residuals(z));
    if (!(fit.consistency_residual_px <= options.worst_px) || !(fit.model.lens.f_px > 0)) return std::nullopt;
    if (!(numbers.angles_left(information) <= kTellsOfAngles)) return std::nullopt;
    return fit;
}

}  // namespace rs::capture
