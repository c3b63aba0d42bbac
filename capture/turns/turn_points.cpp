#include "capture/turns/turn_points.hpp"

#include "capture/calibration/points/bundle.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>

namespace rs::capture {
namespace {

constexpr double kBand_px = 2;             // of guided matching, and largest residual of a track
constexpr std::size_t kMostTracks = 3000;  // more only cost time
constexpr double kPairRatio = 0.85;        // Lowe's ratio: best distance / second best of another point
constexpr double kAgreeing = 0.04;         // distance of agreeing points, in object radii
constexpr double kLeastRadius = 0.25;      // of a point that gives a hypothesis, in object radii
constexpr double kLeastSide = 0.3;         // of a triangle that gives a hypothesis, in object radii
constexpr double kMostSideRatio = 1.15;    // of the scales by the sides of a triangle
constexpr int kTriangles = 50000;          // tried; few of them are similar
constexpr double kMostScale = 3;           // ratio of the cameras' distances, and its inverse

// Radius about the axis that contains the object in all views.
double reach_of(const TurnImages& turn, const TurntableModel& model) {
    const TableRays rays(model.lens, model.pose);
    double reach = 0;
    for (const CalibrationImage& image : turn.images) {
        for (int y = 0; y < image.alpha.height(); ++y) {
            for (int x = 0; x < image.alpha.width(); ++x) {
                const bool is_edge =
                    image.alpha(x, y) >= 128 && (x == 0 || image.alpha(x - 1, y) < 128 ||
                                                 x + 1 == image.alpha.width() || image.alpha(x + 1, y) < 128);
                if (!is_edge) continue;
                const auto ray = rays.through(glm::dvec2(x + 0.5, y + 0.5) * static_cast<double>(turn.reduction));
                if (ray) reach = std::max(reach, std::abs(ray->x) / std::hypot(ray->x, ray->z));
            }
        }
    }
    return std::min(1.05 * reach, 0.95);
}

double object_radius(std::span<const glm::dvec3> points) {
    std::vector<double> radii;
    for (const glm::dvec3& p : points) radii.push_back(std::hypot(p.x, p.z));
    if (radii.empty()) return 0;
    const auto high = radii.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(radii.size() - 1));
    std::ranges::nth_element(radii, high);
    return *high;
}

// X + iZ; a rotation by t about Y multiplies it by e^(-it).
std::complex<double> in_plan(const glm::dvec3& p) {
    return {p.x, p.z};
}

// Placement that maps `first` to `second` in least squares, by rotation and scale in plan, then height.
TurnPlacement fit_placement(std::span<const glm::dvec3> first, std::span<const glm::dvec3> second,
                            std::span<const PointPair> pairs) {
    std::complex<double> product = 0;
    double squares = 0;
    for (const PointPair& pair : pairs) {
        product += std::conj(in_plan(second[pair.second])) * in_plan(first[pair.first]);
        squares += std::norm(in_plan(second[pair.second]));
    }
    const std::complex<double> first_from_second = product / std::max(squares, 1e-12);
    const double distance = std::abs(first_from_second);
    double height = 0;
    for (const PointPair& pair : pairs) height += first[pair.first].y - distance * second[pair.second].y;
    return upright_placement(std::arg(first_from_second), distance, height / static_cast<double>(pairs.size()));
}

// Similarity that maps `first` to `second` in least squares (Umeyama, 1991).
TurnPlacement fit_similarity(std::span<const glm::dvec3> first, std::span<const glm::dvec3> second,
                             std::span<const PointPair> pairs) {
    Eigen::Matrix3Xd from(3, pairs.size()), to(3, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            from(k, static_cast<Eigen::Index>(i)) = first[pairs[i].first][k];
            to(k, static_cast<Eigen::Index>(i)) = second[pairs[i].second][k];
        }
    }
    const Eigen::Matrix4d fitted = Eigen::umeyama(from, to);
    const double scale = fitted.col(0).head<3>().norm();
    TurnPlacement placement;
    placement.distance = 1 / scale;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) placement.rotation[column][row] = fitted(row, column) / scale;
        placement.offset[column] = fitted(column, 3) / scale;
    }
    return placement;
}

// True if the sides of the triangles of three pairs are proportional and not short.
bool are_similar(const std::array<PointPair, 3>& pairs, std::span<const glm::dvec3> first,
                 std::span<const glm::dvec3> second, double radius) {
    double least = kMostScale, most = 1 / kMostScale;
    for (std::size_t k = 0; k < 3; ++k) {
        const PointPair &a = pairs[k], &b = pairs[(k + 1) % 3];
        const double side = glm::distance(first[a.first], first[b.first]);
        const double scale = side / std::max(glm::distance(second[a.second], second[b.second]), 1e-9);
        if (side < kLeastSide * radius) return false;
        least = std::min(least, scale);
        most = std::max(most, scale);
    }
    return most < kMostSideRatio * least && most < kMostScale && least > 1 / kMostScale;
}

std::vector<PointPair> agreeing(const TurnPlacement& placement, std::span<const glm::dvec3> first,
                                std::span<const glm::dvec3> second, std::span<const PointPair> pairs, double limit) {
    std::vector<PointPair> found;
    for (const PointPair& pair : pairs) {
        const glm::dvec3 off = placement.common_from_turn(second[pair.second]) - first[pair.first];
        if (glm::dot(off, off) <= limit * limit) found.push_back(pair);
    }
    return found;
}

float feature_distance(std::int32_t product) {
    constexpr float kSquare = static_cast<float>(kDescriptorUnit) * kDescriptorUnit;
    return std::sqrt(std::max(0.0F, 1 - static_cast<float>(product) / kSquare));
}

// Most similar point of `second` for a descriptor, and the distances to it and to the next point.
struct NearestPoints {
    std::size_t track = 0;
    float best = 2, next = 2;
};

NearestPoints nearest_points(std::span<const std::int32_t> products, const std::vector<std::size_t>& track_of) {
    NearestPoints found;
    for (std::size_t i = 0; i < track_of.size(); ++i) {
        const float distance = feature_distance(products[i]);
        if (distance < found.best) {
            if (track_of[i] != found.track) found.next = found.best;
            found.track = track_of[i];
            found.best = distance;
        } else if (track_of[i] != found.track) {
            found.next = std::min(found.next, distance);
        }
    }
    return found;
}

}  // namespace

Result<TurnPoints> find_turn_points(const TurnImages& turn, const TurntableModel& model) {
    RS_ASSIGN_OR_RETURN(const PointTracker tracker, PointTracker::detect(turn.images, turn.reduction, {}, nullptr));
    RS_ASSIGN_OR_RETURN(std::vector<Track> tracks,
                        tracker.track_guided(model, reach_of(turn, model), kBand_px * turn.reduction));
    Bundle bundle = make_robust_bundle(model, tracks, kBand_px * turn.reduction);
    TurnPoints found;
    const std::size_t every = (bundle.tracks.size() + kMostTracks - 1) / kMostTracks;
    for (std::size_t i = 0; i < bundle.tracks.size(); i += std::max<std::size_t>(every, 1)) {
        const std::vector<Observation>& seen = bundle.tracks[i].seen;
        for (const std::size_t at : {std::size_t{0}, seen.size() / 2, seen.size() - 1}) {
            const std::span<const std::int16_t> descriptor = tracker.descriptor_of(seen[at]);
            found.descriptors.insert(found.descriptors.end(), descriptor.begin(), descriptor.end());
            found.track_of.push_back(found.tracks.size());
        }
        found.points.push_back(bundle.points[i]);
        found.tracks.push_back(std::move(bundle.tracks[i]));
    }
    return found;
}

std::vector<PointPair> match_points(const TurnPoints& first, const TurnPoints& second) {
    const PackedDescriptors packed(second.descriptors);
    std::vector<NearestPoints> nearest(first.track_of.size());
    for_each_index(nearest.size(), [&](std::size_t i) {
        std::vector<std::int32_t> products(packed.stride());
        descriptor_products(std::span(first.descriptors).subspan(i * kDescriptorNumbers, kDescriptorNumbers), packed,
                            products);
        nearest[i] = nearest_points(products, second.track_of);
    });
    std::vector<NearestPoints> best(first.tracks.size());  // over the descriptors of a track
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        NearestPoints& of_track = best[first.track_of[i]];
        if (nearest[i].best < kPairRatio * nearest[i].next && nearest[i].best < of_track.best) of_track = nearest[i];
    }
    std::vector<PointPair> pairs;
    for (std::size_t i = 0; i < best.size(); ++i) {
        if (best[i].best < 2) pairs.push_back({i, best[i].track});
    }
    return pairs;
}

std::vector<PointPair> pairs_near(std::span<const glm::dvec3> first_points, std::span<const glm::dvec3> second_points,
                                  std::span<const PointPair> pairs) {
    return agreeing({}, first_points, second_points, pairs, kAgreeing * object_radius(first_points));
}

std::optional<PointRegistration> register_points(std::span<const glm::dvec3> first_points,
                                                 std::span<const glm::dvec3> second_points,
                                                 std::span<const PointPair> pairs) {
    const double radius = object_radius(first_points);
    const double limit = kAgreeing * radius;
    std::vector<PointPair> best;
    for (const PointPair& pair : pairs) {
        const double first_radius = std::abs(in_plan(first_points[pair.first]));
        const double scale = first_radius / std::max(std::abs(in_plan(second_points[pair.second])), 1e-9);
        if (first_radius < kLeastRadius * radius || scale > kMostScale || scale < 1 / kMostScale) continue;
        const TurnPlacement placement = fit_placement(first_points, second_points, std::span(&pair, 1));
        std::vector<PointPair> found = agreeing(placement, first_points, second_points, pairs, limit);
        if (found.size() > best.size()) best = std::move(found);
    }
    PointRegistration registration;
    constexpr int kRounds = 5;
    for (int round = 0; round < kRounds && !best.empty(); ++round) {
        registration.placement = fit_placement(first_points, second_points, best);
        best = agreeing(registration.placement, first_points, second_points, pairs, limit);
    }
    if (best.size() < kFewestPairs) return std::nullopt;
    registration.pairs = std::move(best);
    return registration;
}

std::optional<PointRegistration> register_reoriented_points(std::span<const glm::dvec3> first_points,
                                                            std::span<const glm::dvec3> second_points,
                                                            std::span<const PointPair> pairs) {
    if (pairs.size() < kFewestReorientedPairs) return std::nullopt;
    const double radius = object_radius(first_points);
    const double limit = kAgreeing * radius;
    std::mt19937 random(1);
    std::vector<PointPair> best;
    for (int i = 0; i < kTriangles; ++i) {
        const std::array<PointPair, 3> triangle{pairs[random() % pairs.size()], pairs[random() % pairs.size()],
                                                pairs[random() % pairs.size()]};
        if (!are_similar(triangle, first_points, second_points, radius)) continue;
        const TurnPlacement placement = fit_similarity(first_points, second_points, triangle);
        std::vector<PointPair> found = agreeing(placement, first_points, second_points, pairs, limit);
        if (found.size() > best.size()) best = std::move(found);
    }
    PointRegistration registration;
    constexpr int kRounds = 5;
    for (int round = 0; round < kRounds && best.size() >= kFewestReorientedPairs; ++round) {
        registration.placement = fit_similarity(first_points, second_points, best);
        best = agreeing(registration.placement, first_points, second_points, pairs, limit);
    }
    if (best.size() < kFewestReorientedPairs || axis_tilt_deg(registration.placement) < kLeastAxisTilt_deg) {
        return std::nullopt;
    }
    registration.pairs = std::move(best);
    return registration;
}

}  // namespace rs::capture
