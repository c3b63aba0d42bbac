#include "capture/calibration/silhouettes/outline_coherence.hpp"

#include "capture/calibration/silhouettes/silhouette_coherence.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr double kLoose_px = 0.01;  // combinations of numbers that move the picture by less are known
constexpr int kCoherenceRounds = 8;
constexpr int kFineRounds = 3;
constexpr int kCoherenceTries = 4;      // of a step, each more damped
constexpr double kFarthestStretch = 8;  // a step is doubled while that helps
constexpr double kLittle = 0.2;         // of cost, twice the log likelihood: no more rounds for less
constexpr double kWidth = 0.5;          // of differences, in deviations
constexpr double kOutlier_px = 1;       // of the turn: residuals far above it count no more
// Views that contradict a ray by this much less than the strongest do not become the strongest beside it.
constexpr double kVerdictMargin_px = 1.5;
constexpr std::size_t kMostVerdicts = 8;
// A few rays say where the optimum is, all of them where it is exactly.
constexpr std::size_t kCoarseRaysPerView = 100;
// Outlines that agree better are those of bodies that look alike from everywhere, and know no more for it.
constexpr double kFinest_px = 0.12;
// Neighbouring points of an outline are off alike: a view is worth this many independent ones.
constexpr double kIndependentRays = 24;
// Outlines that leave more than this of the angles' variance are of a body that looks alike from all sides. What they
// say of the camera is in the small print of their errors: it has been seen to bend lens and tilt.
constexpr double kTellsOfAngles = 0.5;

// Px by which one unit of each number moves the outline, roughly: what makes numbers of different units comparable.
Eigen::VectorXd px_per_unit(const TurntableModel& model, const NumberPlaces& places, const SilhouetteTurn& turn,
                            double picture_px) {
    const double f = model.lens.f_px;
    const double half_px = 0.5 * turn.width_px() * picture_px;
    const double slope = half_px / f;
    const std::array<double, kCameraNumbers> camera{slope, 1, 1,      f * std::pow(slope, 3), f * std::pow(slope, 5),
                                                    f,     f, half_px};
    Eigen::VectorXd px = Eigen::VectorXd::Ones(places.count);
    for (std::size_t k = 0; k < kCameraNumbers; ++k) {
        if (places.camera[k] >= 0) px(places.camera[k]) = camera[k];
    }
    for (const int place : places.angles) {
        if (place >= 0) px(place) = half_px;
    }
    if (places.step >= 0) px(places.step) = half_px * static_cast<double>(places.angles.size());
    return px;
}

// The loosest combinations of numbers, each column one deviation of one.
Eigen::MatrixXd loosest(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& px, Eigen::Index most) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(px.asDiagonal() * covariance * px.asDiagonal());
    if (parts.info() != Eigen::Success) return {};
    const Eigen::Index n = covariance.rows();
    Eigen::Index count = 0;
    while (count < std::min(n, most) && parts.eigenvalues()(n - 1 - count) > kLoose_px * kLoose_px) ++count;
    Eigen::MatrixXd columns(n, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        columns.col(k) = px.cwiseInverse().asDiagonal() * parts.eigenvectors().col(n - 1 - k) *
                         std::sqrt(parts.eigenvalues()(n - 1 - k));
    }
    return columns;
}

// How much of the angles' variance outlines leave, 0 .. 1.
double angles_left(const NumberPlaces& places, const Eigen::MatrixXd& columns, const Eigen::MatrixXd& of_outlines) {
    const Eigen::Index n = columns.cols();
    const Eigen::MatrixXd after = (Eigen::MatrixXd::Identity(n, n) + of_outlines).inverse();
    double before = 0, left = 0;
    for (const int place : places.angles) {
        if (place < 0) continue;
        before += columns.row(place).squaredNorm();
        left += columns.row(place).dot(after * columns.row(place).transpose());
    }
    return before > 0 ? left / before : 1;
}

// Of combinations whose variances were 1: what `of_outlines` makes of them if outlines are off by untold_together times
// as much as they say; never more than before.
Eigen::MatrixXd variance_with(const Eigen::MatrixXd& of_outlines, double untold_together) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(of_outlines);
    const Eigen::ArrayXd told = parts.eigenvalues().array().max(0);
    const Eigen::ArrayXd variance = (1 + untold_together * untold_together * told) / (1 + told).square();
    return parts.eigenvectors() * variance.min(1).matrix().asDiagonal() * parts.eigenvectors().transpose();
}

// Shortfalls of some rays along the combinations, and their cost.
class Outlines {
public:
    Outlines(const TurntableModel& model, const NumberPlaces& places, const SilhouetteTurn& turn, double picture_px,
             const Eigen::MatrixXd& columns, std::size_t every)
        : model_(model), places_(places), turn_(turn), picture_px_(picture_px), columns_(columns), rays_{every, {}} {}

    [[nodiscard]] TurntableModel at(const Eigen::VectorXd& z) const { return stepped(model_, places_, columns_ * z); }

    // Px of the turn.
    [[nodiscard]] Eigen::VectorXd residuals(const Eigen::VectorXd& z) {
        return vector_of(consistency_residuals_px(turn_, in_turn(z), rays_, &depths_));
    }

    // Geman-McClure's, so that what is cut out wrong counts little.
    [[nodiscard]] static double robust_sum(const Eigen::VectorXd& residuals) {
        return (residuals.array().square() / (1 + residuals.array().square() / (kOutlier_px * kOutlier_px))).sum();
    }

    // What a squared residual counts for, if those given are what outlines are usually off.
    [[nodiscard]] double weight(const Eigen::VectorXd& residuals) const {
        const double finest = kFinest_px * kFinest_px * static_cast<double>(residuals.size());
        return kIndependentRays * static_cast<double>(turn_.views()) / std::max(robust_sum(residuals), finest);
    }

    // After residuals(z). Only what contradicts a ray at z is asked again beside z: quick, and near enough to go down
    // by.
    [[nodiscard]] Eigen::MatrixXd quick_slopes(const Eigen::VectorXd& z, Eigen::Index rays) const {
        const auto verdicts = ray_verdicts(turn_, in_turn(z), rays_, depths_, kVerdictMargin_px, kMostVerdicts);
        return slopes(z, rays, [&](const Eigen::VectorXd& there) {
            return vector_of(residuals_by_verdicts(turn_, in_turn(there), rays_, verdicts));
        });
    }

    // What the outlines tell of the combinations. All views are asked: beside a body of revolution the few that
    // contradict it would seem to know how it stands.
    [[nodiscard]] Eigen::MatrixXd information(const Eigen::VectorXd& z, const Eigen::VectorXd& found) {
        const Eigen::MatrixXd exact =
            slopes(z, found.size(), [&](const Eigen::VectorXd& there) { return residuals(there); });
        return exact.transpose() * weights(found).asDiagonal() * exact;
    }

    // Of each ray's square in the cost.
    [[nodiscard]] Eigen::VectorXd weights(const Eigen::VectorXd& found) const {
        const Eigen::ArrayXd tail = 1 + found.array().square() / (kOutlier_px * kOutlier_px);
        return weight(found) / tail.square();
    }

private:
    [[nodiscard]] TurntableModel in_turn(const Eigen::VectorXd& z) const {
        TurntableModel model = at(z);
        model.lens.f_px /= picture_px_;
        model.lens.cx /= picture_px_;
        model.lens.cy /= picture_px_;
        return model;
    }
    template <typename Residuals>
    Eigen::MatrixXd slopes(const Eigen::VectorXd& z, Eigen::Index rays, const Residuals& residuals_at) const {
        Eigen::MatrixXd result(rays, columns_.cols());
        for (Eigen::Index k = 0; k < columns_.cols(); ++k) {
            Eigen::VectorXd before = z, behind = z;
            before(k) -= kWidth;
            behind(k) += kWidth;
            result.col(k) = (residuals_at(behind) - residuals_at(before)) / (2 * kWidth);
        }
        return result;
    }
    static Eigen::VectorXd vector_of(const std::vector<double>& found) {
        return Eigen::Map<const Eigen::VectorXd>(found.data(), static_cast<Eigen::Index>(found.size()));
    }

    const TurntableModel& model_;
    const NumberPlaces& places_;
    const SilhouetteTurn& turn_;
    double picture_px_;
    const Eigen::MatrixXd& columns_;
    RaySelection rays_;
    RayDepths depths_;
};

struct Descent {
    Eigen::VectorXd z;
    Eigen::VectorXd residuals;
};

// From z down to where outlines and what was known before (z of variance 1 around 0) are likeliest together.
Descent descended(Outlines& outlines, const Eigen::VectorXd& from, int rounds) {
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(from.size(), from.size());
    Descent at{from, outlines.residuals(from)};
    double damping = 1e-3;
    for (int round = 0; round < rounds; ++round) {
        const double weight = outlines.weight(at.residuals);
        const Eigen::MatrixXd slopes = outlines.quick_slopes(at.z, at.residuals.size());
        const Eigen::VectorXd weights = outlines.weights(at.residuals);
        const Eigen::MatrixXd of_outlines = slopes.transpose() * weights.asDiagonal() * slopes;
        const Eigen::VectorXd gradient = slopes.transpose() * weights.cwiseProduct(at.residuals) + at.z;
        const double cost_before = weight * Outlines::robust_sum(at.residuals) + at.z.squaredNorm();
        double cost = cost_before;
        bool better = false;
        for (int i = 0; i < kCoherenceTries && !better; ++i) {
            Eigen::MatrixXd damped = unit + of_outlines;
            damped.diagonal() *= 1 + damping;
            const Eigen::VectorXd step = damped.ldlt().solve(-gradient);
            // Shortfalls grow from nothing, so slopes at one place say too little of the next.
            const Eigen::VectorXd start = at.z;
            for (double stretch = 1; stretch <= kFarthestStretch; stretch *= 2) {
                const Eigen::VectorXd there = start + stretch * step;
                const Eigen::VectorXd tried = outlines.residuals(there);
                const double tried_cost = weight * Outlines::robust_sum(tried) + there.squaredNorm();
                if (!(tried_cost < cost)) break;
                cost = tried_cost;
                at.z = there;
                at.residuals = tried;
                better = true;
            }
            damping = better ? damping / 5 : damping * 8;
        }
        if (!better || cost_before - cost < kLittle) break;
    }
    return at;
}

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
    const Eigen::MatrixXd columns =
        loosest(covariance, px_per_unit(model, places, turn, picture_px), options.most_directions);
    const Eigen::Index n = columns.cols();
    if (n == 0) return std::nullopt;
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    int rounds = kCoherenceRounds;
    const std::size_t every = options.few_rays_first ? most_rays_of_a_view(turn) / kCoarseRaysPerView : 1;
    if (every > 1) {
        Outlines few(model, places, turn, picture_px, columns, every);
        z = descended(few, z, kCoherenceRounds).z;
        rounds = kFineRounds;
    }
    Outlines outlines(model, places, turn, picture_px, columns, 1);
    const auto [found, residuals] = descended(outlines, z, rounds);
    const Eigen::MatrixXd of_outlines = outlines.information(found, residuals);
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(n, n);
    CoherenceFit fit{outlines.at(found), covariance, 0};
    fit.consistency_residual_px =
        picture_px * std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
    if (!(fit.consistency_residual_px <= options.worst_px) || !(fit.model.lens.f_px > 0)) return std::nullopt;
    if (!(angles_left(places, columns, of_outlines) <= kTellsOfAngles)) return std::nullopt;
    fit.covariance += columns * (variance_with(of_outlines, options.untold_together) - unit) * columns.transpose();
    return fit;
}

}  // namespace rs::capture
