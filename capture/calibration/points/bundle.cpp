#include "capture/calibration/points/bundle.hpp"

#include "capture/calibration/points/reprojection.hpp"
#include "rayspace/base/median.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

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

glm::dvec3 object_point(const TurntableModel& model, int view, const glm::dvec3& p_in_table) {
    return turned(p_in_table, -model.angles_rad[static_cast<std::size_t>(view)]);
}

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

std::optional<glm::dvec2> projected(const TurntableModel& model, const glm::dvec3& point, int view) {
    return project(model.lens, model.pose, turned(point, model.angles_rad[static_cast<std::size_t>(view)]));
}

std::optional<glm::dvec2> residual(const TurntableModel& model, const glm::dvec3& point, const Observation& seen) {
    const auto p = projected(model, point, seen.view);
    if (!p) return std::nullopt;
    return *p - seen.p;
}

std::optional<glm::dvec3> triangulated(const TurntableModel& model, const Track& track) {
    glm::dmat3 normal(0.0);
    glm::dvec3 right_side(0.0);
    for (const Observation& seen : track.seen) {
        const auto ray = table_ray(model.lens, model.pose, seen.p);
        if (!ray) return std::nullopt;
        const glm::dvec3 d = object_point(model, seen.view, *ray);
        const glm::dvec3 centre = object_point(model, seen.view, {0, 0, 1});
        const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(d, d);
        normal += across;
        right_side += across * centre;
    }
    if (glm::determinant(normal) < 1e-6) return std::nullopt;
    glm::dvec3 p = glm::inverse(normal) * right_side;

    // A few Gauss-Newton steps on the reprojection error, derivatives by differences.
    for (int round = 0; round < 4; ++round) {
        glm::dmat3 hessian(0.0);
        glm::dvec3 gradient(0.0);
        for (const Observation& seen : track.seen) {
            const auto r = residual(model, p, seen);
            if (!r) return std::nullopt;
            constexpr double kStep = 1e-5;
            std::array<glm::dvec2, 3> slope;
            for (int k = 0; k < 3; ++k) {
                glm::dvec3 moved = p;
                moved[k] += kStep;
                const auto there = residual(model, moved, seen);
                if (!there) return std::nullopt;
                slope[static_cast<std::size_t>(k)] = (*there - *r) / kStep;
            }
            for (int k = 0; k < 3; ++k) {
                gradient[k] += glm::dot(slope[static_cast<std::size_t>(k)], *r);
                for (int l = 0; l < 3; ++l) {
                    hessian[l][k] += glm::dot(slope[static_cast<std::size_t>(k)], slope[static_cast<std::size_t>(l)]);
                }
            }
        }
        if (!(std::abs(glm::determinant(hessian)) > 1e-9)) return std::nullopt;
        p -= glm::inverse(hessian) * gradient;
    }
    if (!(glm::length(glm::dvec2(p.x, p.z)) < 0.95)) return std::nullopt;
    for (const Observation& seen : track.seen) {
        if (!residual(model, p, seen)) return std::nullopt;
    }
    return p;
}

Bundle make_bundle(const TurntableModel& model, std::span<const Track> tracks) {
    Bundle bundle{model, {}, {}};
    for (const Track& track : tracks) {
        if (const auto point = triangulated(model, track)) {
            bundle.tracks.push_back(track);
            bundle.points.push_back(*point);
        }
    }
    return bundle;
}

namespace {

// The observations that agree with the point of two of them, for the pair with which most do.
Track agreeing(const TurntableModel& model, const Track& track, double limit_px) {
    constexpr std::size_t kMostPairs = 24;
    const std::size_t count = track.seen.size();
    Track best;
    std::size_t tried = 0;
    // Pairs of neighbours in the track first, then farther ones: near views share the most matches.
    for (std::size_t apart = 1; apart < count && tried < kMostPairs; ++apart) {
        for (std::size_t i = 0; i + apart < count && tried < kMostPairs; ++i, ++tried) {
            const auto p = triangulated(model, Track{{track.seen[i], track.seen[i + apart]}});
            if (!p) continue;
            Track kept;
            for (const Observation& seen : track.seen) {
                const auto r = residual(model, *p, seen);
                if (r && glm::length(seen.weight * *r) <= limit_px) kept.seen.push_back(seen);
            }
            if (kept.seen.size() > best.seen.size()) best = std::move(kept);
            if (best.seen.size() == count) return best;
        }
    }
    return best;
}

}  // namespace

Bundle make_agreeing_bundle(const TurntableModel& model, std::span<const Track> tracks, double limit_px) {
    Bundle bundle{model, {}, {}};
    for (const Track& track : tracks) {
        // The point of two rays is less exact than that of all.
        Track kept = agreeing(model, track, 1.5 * limit_px);
        if (kept.seen.size() < 3) continue;
        if (const auto point = triangulated(model, kept)) {
            bundle.tracks.push_back(std::move(kept));
            bundle.points.push_back(*point);
        }
    }
    drop_outliers(bundle, limit_px);
    return bundle;
}

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
    ceres::Problem problem(ownership);
    auto* ordering = new ceres::ParameterBlockOrdering;
    int observations = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            double* angle = common ? &step : &model.angles_rad[static_cast<std::size_t>(seen.view)];
            problem.AddResidualBlock(new Reprojection(seen, common ? static_cast<double>(seen.view) : 1.0), &loss,
                                     lens.data(), pose.data(), angle, &bundle.points[i].x);
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
    solver.function_tolerance = 1e-7;
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

int drop_outliers(Bundle& bundle, double limit_px) {
    int dropped = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        Track track;
        for (const Observation& seen : bundle.tracks[i].seen) {
            const auto r = residual(bundle.model, bundle.points[i], seen);
            if (r && glm::length(seen.weight * *r) <= limit_px) {
                track.seen.push_back(seen);
            } else {
                ++dropped;
            }
        }
        if (track.seen.size() < 3) continue;
        bundle.tracks[kept] = std::move(track);
        bundle.points[kept] = bundle.points[i];
        ++kept;
    }
    bundle.tracks.resize(kept);
    bundle.points.resize(kept);
    return dropped;
}

std::vector<int> observations_per_view(std::span<const Track> tracks, std::size_t views) {
    std::vector<int> counts(views, 0);
    for (const Track& track : tracks) {
        for (const Observation& seen : track.seen) ++counts[static_cast<std::size_t>(seen.view)];
    }
    return counts;
}

int observation_count(const Bundle& bundle) {
    std::size_t count = 0;
    for (const Track& track : bundle.tracks) count += track.seen.size();
    return static_cast<int>(count);
}

double rms_px(const Bundle& bundle) {
    double sum = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            if (const auto r = residual(bundle.model, bundle.points[i], seen)) sum += glm::dot(*r, *r);
        }
    }
    return std::sqrt(sum / std::max(1, observation_count(bundle)));
}

double robust_deviation_px(const Bundle& bundle) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            const auto r = residual(bundle.model, bundle.points[i], seen);
            if (!r) continue;
            const glm::dvec2 weighted = seen.weight * *r;
            sizes.push_back(std::abs(weighted.x));
            sizes.push_back(std::abs(weighted.y));
        }
    }
    return 1.4826 * median(std::move(sizes));
}

}  // namespace rs::capture
