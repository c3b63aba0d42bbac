#include "capture/calibration/silhouettes/coherence_fit.hpp"

#include "capture/calibration/silhouettes/consistency_residuals.hpp"
#include "capture/calibration/silhouettes/free_parameters.hpp"
#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kMostSteps = 8;
constexpr int kFineSteps = 3;
constexpr double kLittle = 0.1;    // of cost: smaller gains stop the iteration
constexpr double kWidth = 0.5;     // of differences, in deviations
constexpr double kOutlier_px = 1;  // of the turn
// Lower limit of the deviation: smaller residuals are those of bodies that look the same from all sides, and carry no
// more information.
constexpr double kFinest_px = 0.12;
// A view whose contradiction is weaker by more than this does not become the strongest for a similar
// model.
constexpr double kVerdictMargin_px = 1.5;
constexpr std::size_t kMostVerdicts = 8;
// A few rays locate the optimum approximately, all rays refine it.
constexpr std::size_t kCoarseRaysPerView = 100;
// If silhouettes leave more than this share of the angles' variance, the body looks the same from all sides. Such
// silhouettes are not used: their small errors have been observed to distort lens and tilt.
constexpr double kMaxAngleVarianceShare = 0.5;

// Consistency residuals of a selection of rays, searched near `depths` once these are filled in.
SilhouetteComparison consistency_comparison(const FreeParameters& numbers, const SilhouetteTurn& turn, double image_px,
                                            const RaySelection& rays, RayDepths& depths) {
    const auto in_turn = [&numbers, image_px](const Eigen::VectorXd& z) {
        TurntableModel model = numbers.at(z);
        for (double* const px : {&model.lens.f_px, &model.lens.cx, &model.lens.cy}) *px /= image_px;
        return model;
    };
    const auto residuals = [&turn, &rays, &depths, in_turn](const Eigen::VectorXd& z) {
        return consistency_residuals_px(turn, in_turn(z), rays, &depths);
    };
    // Compares only the views that contradict a ray: accurate enough for derivatives.
    const auto beside = [&turn, &rays, &depths, in_turn](const Eigen::VectorXd& z) -> SilhouetteResiduals {
        auto verdicts = find_contradictions(turn, in_turn(z), rays, depths, kVerdictMargin_px, kMostVerdicts);
        return [&turn, &rays, in_turn, verdicts = std::move(verdicts)](const Eigen::VectorXd& there) {
            return residuals_from_contradictions(turn, in_turn(there), rays, verdicts);
        };
    };
    return {residuals, Eigen::VectorXd::Constant(numbers.count(), kWidth), beside};
}

std::size_t most_rays_of_a_view(const SilhouetteTurn& turn) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < turn.views(); ++i) most = std::max(most, turn.edges(i).size());
    return most;
}

}  // namespace

std::optional<CoherenceFit> fit_coherence(const TurntableModel& model, const ParameterIndices& places,
                                          const Eigen::MatrixXd& covariance, const SilhouetteTurn& turn,
                                          double image_px, const CoherenceOptions& options) {
    if (places.count == 0 || covariance.rows() != places.count || !covariance.allFinite()) return std::nullopt;
    const FreeParameters numbers(model, places, covariance, 0.5 * turn.width_px() * image_px, options.most_directions);
    if (numbers.count() == 0) return std::nullopt;
    const SilhouetteErrors errors{kIndependentPerView * static_cast<double>(turn.views()), kOutlier_px, kFinest_px,
                                  true};
    Eigen::VectorXd z = Eigen::VectorXd::Zero(numbers.count());
    int steps = kMostSteps;
    const std::size_t every = options.few_rays_first ? most_rays_of_a_view(turn) / kCoarseRaysPerView : 1;
    if (every > 1) {
        const RaySelection few{every, {}};
        RayDepths depths;
        const SilhouetteComparison coarse = consistency_comparison(numbers, turn, image_px, few, depths);
        if (!SilhouetteAdjustment(coarse, errors).improve(z, kMostSteps, kLittle)) return std::nullopt;
        steps = kFineSteps;
    }
    const RaySelection all{1, {}};
    RayDepths depths;
    SilhouetteComparison rays = consistency_comparison(numbers, turn, image_px, all, depths);
    if (!SilhouetteAdjustment(rays, errors).improve(z, steps, kLittle)) return std::nullopt;
    // For a body of revolution, the few contradicting views would seem to determine its orientation, so the final
    // information is computed from all views.
    rays.beside = nullptr;
    SilhouetteAdjustment found(rays, errors);
    const Eigen::MatrixXd information = found.information(z);
    CoherenceFit fit{numbers.at(z),
                     numbers.updated_covariance(covariance, information, options.common_error_factor, 1, 1), 0};
    fit.consistency_residual_px = image_px * rms_px(found.residuals(z));
    if (!(fit.consistency_residual_px <= options.worst_px) || !(fit.model.lens.f_px > 0)) return std::nullopt;
    if (!(numbers.remaining_angle_variance(information) <= kMaxAngleVarianceShare)) return std::nullopt;
    return fit;
}

}  // namespace rs::capture
