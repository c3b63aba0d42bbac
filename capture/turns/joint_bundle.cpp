#include "capture/turns/joint_bundle.hpp"

#include "capture/calibration/model/projection.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "rayspace/base/median.hpp"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace rs::capture {
namespace {

constexpr int kRounds = 4;
constexpr double kLeastLoss_px = 0.3;
constexpr double kOutlierDeviations = 4;
constexpr double kLeastOutlier_px = 0.8;

// Parameter blocks of a turn. Placement: rotation vector, offset, log distance.
struct TurnBlocks {
    std::array<double, 5> lens{};
    std::array<double, 3> pose{};
    std::vector<double> angles_rad;
    std::array<double, 7> placement{};
};

TurnBlocks blocks_of(const PlacedTurn& turn) {
    const Lens& lens = turn.model.lens;
    const CameraPose& pose = turn.model.pose;
    TurnBlocks blocks{{lens.f_px, lens.cx, lens.cy, lens.k1, lens.k2},
                      {pose.pan_rad, pose.tilt_rad, pose.roll_rad},
                      turn.model.angles_rad,
                      {}};
    ceres::RotationMatrixToAngleAxis(&turn.placement.rotation[0][0], blocks.placement.data());
    for (int k = 0; k < 3; ++k) blocks.placement[static_cast<std::size_t>(3 + k)] = turn.placement.offset[k];
    blocks.placement[6] = std::log(turn.placement.distance);
    return blocks;
}

void write_turn(const TurnBlocks& blocks, PlacedTurn& turn) {
    Lens& lens = turn.model.lens;
    lens.f_px = blocks.lens[0];
    lens.cx = blocks.lens[1];
    lens.cy = blocks.lens[2];
    lens.k1 = blocks.lens[3];
    lens.k2 = blocks.lens[4];
    turn.model.pose = {blocks.pose[0], blocks.pose[1], blocks.pose[2]};
    turn.model.angles_rad = blocks.angles_rad;
    ceres::AngleAxisToRotationMatrix(blocks.placement.data(), &turn.placement.rotation[0][0]);
    turn.placement.offset = {blocks.placement[3], blocks.placement[4], blocks.placement[5]};
    turn.placement.distance = std::exp(blocks.placement[6]);
}

struct PlacedReprojectionError {
    glm::dvec2 seen;

    template <class T>
    bool operator()(const T* lens, const T* pose, const T* angle, const T* placement, const T* point,
                    T* residual) const {
        using std::exp;
        T p[3];
        ceres::AngleAxisRotatePoint(placement, point, p);
        const T scale = exp(-placement[6]);
        for (int k = 0; k < 3; ++k) p[k] = (p[k] + placement[3 + k]) * scale;
        T px[2];
        if (!project_turned(lens, pose, *angle, p, px)) return false;
        residual[0] = px[0] - seen.x;
        residual[1] = px[1] - seen.y;
        return true;
    }
};

// Priors of a parameter block: (value - mean) / deviation for the numbers with a finite positive deviation.
template <int kSize>
struct BlockPrior {
    std::array<double, kSize> mean, deviation;

    template <class T>
    bool operator()(const T* value, T* residual) const {
        for (std::size_t k = 0; k < kSize; ++k) {
            const bool is_known = std::isfinite(deviation[k]) && deviation[k] > 0;
            residual[k] = is_known ? (value[k] - mean[k]) / deviation[k] : T(0);
        }
        return true;
    }
};

class JointProblem {
public:
    JointProblem(JointBundle& bundle, std::size_t reference, double loss_px)
        : bundle_(bundle), reference_(reference), loss_px_(loss_px) {
        for (const PlacedTurn& turn : bundle.turns) blocks_.push_back(blocks_of(turn));
    }

    [[nodiscard]] bool solve() {
        add_observations();
        for (std::size_t t = 0; t < blocks_.size(); ++t) add_turn(t);
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::SPARSE_SCHUR;
        options.max_num_iterations = 40;
        options.num_threads = 2;
        options.logging_type = ceres::SILENT;
        silence_ceres();
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem_, &summary);
        if (!summary.IsSolutionUsable()) return false;
        for (std::size_t t = 0; t < blocks_.size(); ++t) write_turn(blocks_[t], bundle_.turns[t]);
        return true;
    }

private:
    void add_observations() {
        for (JointTrack& track : bundle_.tracks) {
            for (const JointObservation& seen : track.seen) {
                TurnBlocks& of = blocks_[seen.turn];
                problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<PlacedReprojectionError, 2, 5, 3, 1, 7, 3>(
                                              new PlacedReprojectionError{seen.p}),
                                          new ceres::CauchyLoss(loss_px_), of.lens.data(), of.pose.data(),
                                          &of.angles_rad[seen.view], of.placement.data(), &track.point.x);
            }
        }
    }

    // Deviation of a prior in units of that of the observations, half the loss.
    [[nodiscard]] double weighted(double deviation) const { return deviation / (0.5 * loss_px_); }

    void add_turn(std::size_t t) {
        TurnBlocks& of = blocks_[t];
        if (!problem_.HasParameterBlock(of.lens.data())) return;
        const ModelDeviations& known = bundle_.deviations[t];
        add_prior<5>(of.lens, {known.f_px, known.cx, known.cy, known.k1, known.k2});
        add_prior<3>(of.pose, {std::hypot(known.axis_position_px / of.lens[0], 1e-6), known.tilt_rad, known.roll_rad});
        for (std::size_t i = 0; i < of.angles_rad.size(); ++i) {
            double* const angle = &of.angles_rad[i];
            if (!problem_.HasParameterBlock(angle)) continue;
            const double deviation = i < known.angles_rad.size() ? known.angles_rad[i] : 0;
            if (i == 0 || !(deviation > 0)) {
                problem_.SetParameterBlockConstant(angle);
            } else {
                add_prior<1>(std::span<double, 1>(angle, 1), {deviation});
            }
        }
        if (t == reference_) {
            problem_.SetParameterBlockConstant(of.placement.data());
        } else if (bundle_.turns[t].placement.is_upright()) {
            problem_.SetManifold(of.placement.data(), new ceres::SubsetManifold(7, {0, 2, 3, 5}));
        }
    }

    template <std::size_t kSize>
    void add_prior(std::span<double, kSize> block, const std::array<double, kSize>& deviation) {
        BlockPrior<static_cast<int>(kSize)> prior;
        std::vector<int> held;
        for (std::size_t k = 0; k < kSize; ++k) {
            prior.mean[k] = block[k];
            prior.deviation[k] = weighted(deviation[k]);
            if (!(deviation[k] > 0)) held.push_back(static_cast<int>(k));
        }
        if (held.size() == kSize) {
            problem_.SetParameterBlockConstant(block.data());
            return;
        }
        if (!held.empty()) {
            problem_.SetManifold(block.data(), new ceres::SubsetManifold(static_cast<int>(kSize), held));
        }
        constexpr int kNumbers = static_cast<int>(kSize);
        problem_.AddResidualBlock(
            new ceres::AutoDiffCostFunction<BlockPrior<kNumbers>, kNumbers, kNumbers>(new BlockPrior<kNumbers>(prior)),
            nullptr, block.data());
    }

    JointBundle& bundle_;
    std::size_t reference_;
    double loss_px_;
    std::vector<TurnBlocks> blocks_;
    ceres::Problem problem_;
};

std::optional<glm::dvec2> joint_residual(const JointBundle& bundle, const JointTrack& track,
                                         const JointObservation& seen) {
    const PlacedTurn& turn = bundle.turns[seen.turn];
    const glm::dvec3 p = turned(turn.placement.turn_from_common(track.point), turn.model.angles_rad[seen.view]);
    const auto px = project(turn.model.lens, turn.model.pose, p);
    if (!px) return std::nullopt;
    return *px - seen.p;
}

// 1.4826 times the median of the residuals' components.
double robust_joint_deviation_px(const JointBundle& bundle) {
    std::vector<double> sizes;
    for (const JointTrack& track : bundle.tracks) {
        for (const JointObservation& seen : track.seen) {
            if (const auto r = joint_residual(bundle, track, seen)) {
                sizes.push_back(std::abs(r->x));
                sizes.push_back(std::abs(r->y));
            }
        }
    }
    return sizes.empty() ? 0 : 1.4826 * median(std::move(sizes));
}

bool spans_turns(const JointTrack& track) {
    return std::ranges::any_of(track.seen,
                               [&](const JointObservation& seen) { return seen.turn != track.seen.front().turn; });
}

// Drops far observations, then tracks that no two turns share any more.
void drop_joint_outliers(JointBundle& bundle, double limit_px) {
    for (JointTrack& track : bundle.tracks) {
        std::erase_if(track.seen, [&](const JointObservation& seen) {
            const auto r = joint_residual(bundle, track, seen);
            return !r || glm::length(*r) > limit_px;
        });
    }
    std::erase_if(bundle.tracks, [](const JointTrack& track) { return track.seen.size() < 3 || !spans_turns(track); });
}

std::vector<JointFit> joint_fits(const JointBundle& bundle) {
    std::vector<JointFit> fits(bundle.turns.size());
    for (const JointTrack& track : bundle.tracks) {
        for (const JointObservation& seen : track.seen) {
            const auto r = joint_residual(bundle, track, seen);
            if (!r) continue;
            ++fits[seen.turn].observations;
            fits[seen.turn].rms_px += glm::dot(*r, *r);
        }
    }
    for (JointFit& fit : fits) {
        fit.rms_px = fit.observations > 0 ? std::sqrt(fit.rms_px / static_cast<double>(fit.observations)) : 0;
    }
    return fits;
}

}  // namespace

Result<std::vector<JointFit>> adjust_jointly(JointBundle& bundle, std::size_t reference) {
    double loss_px = 2 * std::max(kLeastLoss_px, robust_joint_deviation_px(bundle));
    const std::vector<PlacedTurn> single = bundle.turns;
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t t = 0; t < single.size(); ++t) bundle.turns[t].model = single[t].model;  // means of the priors
        if (!JointProblem(bundle, reference, loss_px).solve())
            return Error{"the bundle adjustment over the turns fails"};
        const double deviation_px = robust_joint_deviation_px(bundle);
        loss_px = std::max(kLeastLoss_px, 2 * deviation_px);
        drop_joint_outliers(bundle, std::max(kLeastOutlier_px, kOutlierDeviations * deviation_px));
    }
    return joint_fits(bundle);
}

}  // namespace rs::capture
