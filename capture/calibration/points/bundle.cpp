#include "capture/calibration/points/bundle.hpp"

#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace rs::capture {

BundleFreedom free_parameters_beside(const KnownInputs& known) {
    BundleFreedom free;
    free.f = !known.f_px;
    free.pan = free.tilt = free.roll = !known.pose;
    free.principal_point = known.estimate_principal_point && !known.principal_point;
    free.angles = known.step_rad || known.angles_rad ? AngleFreedom::kConstant
                  : known.equal_steps                ? AngleFreedom::kCommonStep
                                                     : AngleFreedom::kEach;
    return free;
}

std::optional<glm::dvec2> project_point(const TurntableModel& model, const glm::dvec3& point, int view) {
    return project(model.lens, model.pose, turned(point, model.angles_rad[static_cast<std::size_t>(view)]));
}

std::optional<glm::dvec2> residual(const TurntableModel& model, const glm::dvec3& point, const Observation& seen) {
    const auto p = project_point(model, point, seen.view);
    if (!p) return std::nullopt;
    return *p - seen.p;
}

std::optional<glm::dvec2> residual(const TurnProjection& turn, const glm::dvec3& point, const Observation& seen) {
    const auto p = turn.project(point, static_cast<std::size_t>(seen.view));
    if (!p) return std::nullopt;
    return *p - seen.p;
}

namespace {

// An observation and its viewing ray; nothing if the distortion cannot be inverted.
struct ViewingRay {
    const Observation* seen = nullptr;
    std::optional<glm::dvec3> ray;  // in the object's frame
};

std::vector<ViewingRay> viewing_rays_of(const TurnProjection& turn, const Track& track) {
    std::vector<ViewingRay> viewing_rays;
    viewing_rays.reserve(track.seen.size());
    for (const Observation& seen : track.seen) {
        viewing_rays.push_back({&seen, turn.ray(seen.p, static_cast<std::size_t>(seen.view))});
    }
    return viewing_rays;
}

std::optional<glm::dvec3> triangulate_from(const TurnProjection& turn, std::span<const ViewingRay> viewing_rays) {
    glm::dmat3 normal(0.0);
    glm::dvec3 right_side(0.0);
    for (const ViewingRay& each : viewing_rays) {
        if (!each.ray) return std::nullopt;
        const glm::dmat3 across = glm::dmat3(1.0) - glm::outerProduct(*each.ray, *each.ray);
        normal += across;
        right_side += across * turn.centre(static_cast<std::size_t>(each.seen->view));
    }
    if (glm::determinant(normal) < 1e-6) return std::nullopt;
    glm::dvec3 p = glm::inverse(normal) * right_side;

    // A few Gauss-Newton steps on the reprojection error.
    constexpr double kSettled = 1e-10;
    for (int round = 0; round < 4; ++round) {
        glm::dmat3 hessian(0.0);
        glm::dvec3 gradient(0.0);
        for (const ViewingRay& each : viewing_rays) {
            const auto there = turn.project_with_jacobian(p, static_cast<std::size_t>(each.seen->view));
            if (!there) return std::nullopt;
            const glm::dvec2 r = there->px - each.seen->p;
            gradient += there->slope_x * r.x + there->slope_y * r.y;
            hessian +=
                glm::outerProduct(there->slope_x, there->slope_x) + glm::outerProduct(there->slope_y, there->slope_y);
        }
        if (!(std::abs(glm::determinant(hessian)) > 1e-9)) return std::nullopt;
        const glm::dvec3 step = glm::inverse(hessian) * gradient;
        p -= step;
        if (glm::dot(step, step) < kSettled * kSettled) break;
    }
    if (!(glm::length(glm::dvec2(p.x, p.z)) < 0.95)) return std::nullopt;
    for (const ViewingRay& each : viewing_rays) {
        if (!turn.project(p, static_cast<std::size_t>(each.seen->view))) return std::nullopt;
    }
    return p;
}

// The largest set of observations within limit_px of the point triangulated from two of them.
Track largest_consensus(const TurnProjection& turn, const Track& track, double limit_px) {
    constexpr std::size_t kMostPairs = 24;
    const std::size_t count = track.seen.size();
    const std::vector<ViewingRay> viewing_rays = viewing_rays_of(turn, track);
    Track best;
    std::size_t tried = 0;
    // Neighbours in the track first, then more distant pairs: near views share the most matches.
    for (std::size_t apart = 1; apart < count && tried < kMostPairs; ++apart) {
        for (std::size_t i = 0; i + apart < count && tried < kMostPairs; ++i, ++tried) {
            const std::array<ViewingRay, 2> pair{viewing_rays[i], viewing_rays[i + apart]};
            const auto p = triangulate_from(turn, pair);
            if (!p) continue;
            Track kept;
            for (const Observation& seen : track.seen) {
                const auto r = residual(turn, *p, seen);
                if (r && glm::length(seen.weight * *r) <= limit_px) kept.seen.push_back(seen);
            }
            if (kept.seen.size() > best.seen.size()) best = std::move(kept);
            if (best.seen.size() == count) return best;
        }
    }
    return best;
}

// Applies `make` to each track in parallel and collects the results in order; tracks without a result are dropped.
template <class Make>
Bundle collect_tracks(const TurntableModel& model, std::span<const Track> tracks, const Make& make) {
    std::vector<std::optional<std::pair<Track, glm::dvec3>>> made(tracks.size());
    constexpr std::size_t kGrain = 64;
    for_each_range(tracks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) made[i] = make(tracks[i]);
    });
    Bundle bundle{model, {}, {}};
    for (auto& each : made) {
        if (!each) continue;
        bundle.tracks.push_back(std::move(each->first));
        bundle.points.push_back(each->second);
    }
    return bundle;
}

}  // namespace

std::optional<glm::dvec3> triangulate(const TurntableModel& model, const Track& track) {
    const TurnProjection turn(model);
    return triangulate_from(turn, viewing_rays_of(turn, track));
}

Bundle make_bundle(const TurntableModel& model, std::span<const Track> tracks) {
    const TurnProjection turn(model);
    return collect_tracks(model, tracks, [&](const Track& track) -> std::optional<std::pair<Track, glm::dvec3>> {
        const auto point = triangulate_from(turn, viewing_rays_of(turn, track));
        if (!point) return std::nullopt;
        return std::pair{track, *point};
    });
}

Bundle make_robust_bundle(const TurntableModel& model, std::span<const Track> tracks, double limit_px) {
    const TurnProjection turn(model);
    Bundle bundle =
        collect_tracks(model, tracks, [&](const Track& track) -> std::optional<std::pair<Track, glm::dvec3>> {
            // A point from two rays is less accurate than one from all.
            Track kept = largest_consensus(turn, track, 1.5 * limit_px);
            if (kept.seen.size() < 3) return std::nullopt;
            const auto point = triangulate_from(turn, viewing_rays_of(turn, kept));
            if (!point) return std::nullopt;
            return std::pair{std::move(kept), *point};
        });
    drop_outliers(bundle, limit_px);
    return bundle;
}

int drop_outliers(Bundle& bundle, double limit_px) {
    const TurnProjection turn(bundle.model);
    int dropped = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        Track track;
        for (const Observation& seen : bundle.tracks[i].seen) {
            const auto r = residual(turn, bundle.points[i], seen);
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
    const TurnProjection turn(bundle.model);
    double sum = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            if (const auto r = residual(turn, bundle.points[i], seen)) sum += glm::dot(*r, *r);
        }
    }
    return std::sqrt(sum / std::max(1, observation_count(bundle)));
}

double robust_deviation_px(const Bundle& bundle) {
    const TurnProjection turn(bundle.model);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            const auto r = residual(turn, bundle.points[i], seen);
            if (!r) continue;
            const glm::dvec2 weighted = seen.weight * *r;
            sizes.push_back(std::abs(weighted.x));
            sizes.push_back(std::abs(weighted.y));
        }
    }
    return 1.4826 * median(std::move(sizes));
}

}  // namespace rs::capture
