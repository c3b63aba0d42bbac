#include "capture/calibration/points/patch_alignment.hpp"

#include "capture/calibration/points/patch.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace rs::capture {
namespace {

constexpr double kFarthest_rad = 0.75;  // from the reference view; beyond, the surface is too oblique
constexpr double kMostCurvature = 0.1;  // 1/px
constexpr std::size_t kFewestAligned = 3;

double nearest_turn(double angle_rad) {
    return std::remainder(angle_rad, 2 * kPi);
}

// A point with a surface patch through it, in the reference camera's frame: two vectors perpendicular to the line of
// sight and one along it, each one (reduced) px long at the point's depth, and the surface's slope and curvature in
// depth.
struct Facet {
    Observation reference;
    glm::dvec3 point{0.0};
    glm::dvec3 along_x{0.0};
    glm::dvec3 along_y{0.0};
    glm::dvec3 away{0.0};
    glm::dvec2 slope{0.0};
    glm::dvec3 curvature{0.0};  // 1/px, for i^2 / 2, j^2 / 2, i j
    [[nodiscard]] glm::dvec3 at(double i, double j) const {
        const double depth =
            slope.x * i + slope.y * j + 0.5 * curvature.x * i * i + 0.5 * curvature.y * j * j + curvature.z * i * j;
        return point + along_x * i + along_y * j + away * depth;
    }
};

std::optional<Facet> facet_of(const Bundle& bundle, std::size_t i, int reduction) {
    const TurntableModel& model = bundle.model;
    Facet facet;
    facet.reference = reference_observation(model, bundle.tracks[i]);
    facet.point = bundle.points[i];
    const auto view = static_cast<std::size_t>(facet.reference.view);
    const Camera camera = object_camera(model, view);
    const double depth = glm::dot(facet.point - camera.centre(), camera.forward());
    if (depth <= 0) return std::nullopt;
    facet.along_x = camera.right() * (depth / camera.fl_x * reduction);
    facet.along_y = -camera.up() * (depth / camera.fl_x * reduction);
    facet.away = camera.forward() * (depth / camera.fl_x * reduction);
    return facet;
}

// Predicted warp of the facet in a view, px of the reduced images.
std::optional<Warp> predict_warp(const TurnProjection& projection, const Facet& facet, std::size_t view,
                                 int reduction) {
    const auto seen = [&](const glm::dvec3& p) { return projection.project(p, view); };
    // Differences over a few px, about the extent of the patch: gives the quadratic that the patch observes.
    constexpr double kReach_px = 4;
    const auto centre = seen(facet.point);
    const auto left = seen(facet.at(-kReach_px, 0)), right = seen(facet.at(kReach_px, 0));
    const auto upper = seen(facet.at(0, -kReach_px)), lower = seen(facet.at(0, kReach_px));
    const auto corner = seen(facet.at(kReach_px, kReach_px)), opposite = seen(facet.at(-kReach_px, -kReach_px));
    const auto deeper = seen(facet.point + facet.away);
    if (!centre || !left || !right || !upper || !lower || !corner || !opposite || !deeper) return std::nullopt;
    const double scale = 1.0 / reduction;
    const double first = scale / (2 * kReach_px), second = scale / (kReach_px * kReach_px);
    Warp warp;
    warp.centre = *centre * scale;
    warp.matrix = glm::dmat2((*right - *left) * first, (*lower - *upper) * first);
    warp.bent[0] = (*left + *right - 2.0 * *centre) * second;
    warp.bent[1] = (*upper + *lower - 2.0 * *centre) * second;
    warp.bent[2] = 0.5 * ((*corner + *opposite - 2.0 * *centre) * second - warp.bent[0] - warp.bent[1]);
    warp.deeper = (*deeper - *centre) * scale;
    return warp;
}

// Result: [view][point].
std::vector<std::vector<std::optional<Alignment>>> align_all(std::span<const CalibrationImage> turn, int reduction,
                                                             const TurntableModel& model,
                                                             const std::vector<std::optional<Facet>>& facets,
                                                             const std::vector<std::optional<Patch>>& patches,
                                                             bool curvature_is_known) {
    std::vector<std::vector<std::optional<Alignment>>> found(turn.size());
    const TurnProjection projection(model);
    for_each_index(turn.size(), [&](std::size_t view) {
        const PatchImage image(turn[view]);
        found[view].resize(facets.size());
        for (std::size_t i = 0; i < facets.size(); ++i) {
            if (!facets[i]) continue;
            auto& here = found[view][i];
            const auto reference = static_cast<std::size_t>(facets[i]->reference.view);
            if (reference == view) {
                here = Alignment{facets[i]->reference, glm::dmat2(1.0), {}, {}};
                continue;
            }
            const double apart = nearest_turn(model.angles_rad[view] - model.angles_rad[reference]);
            if (std::abs(apart) > kFarthest_rad) continue;
            const auto warp = predict_warp(projection, *facets[i], view, reduction);
            if (warp) here = align(image, *patches[i], *warp, curvature_is_known);
            if (here) {
                here->seen.p *= static_cast<double>(reduction);
                here->seen.view = static_cast<int>(view);
            }
        }
    });
    return found;
}

// Estimates the facet's slope and curvature from its alignments in all views.
void estimate_shape(Facet& facet, const TurnProjection& projection, int reduction,
                    const std::vector<std::vector<std::optional<Alignment>>>& found, std::size_t point) {
    constexpr double kSlopeInformation = 1e-3;  // towards facing the camera
    glm::dvec2 slope(0.0);
    glm::dvec3 curvature(0.0), information(1 / (kTypicalCurvature * kTypicalCurvature));
    double moved = kSlopeInformation;
    for (std::size_t view = 0; view < found.size(); ++view) {
        const auto& seen = found[view][point];
        if (!seen || seen->seen.view == facet.reference.view) continue;
        const auto warp = predict_warp(projection, facet, view, reduction);
        if (!warp) continue;
        for (int k = 0; k < 2; ++k) slope[k] += glm::dot(seen->matrix[k] - warp->matrix[k], warp->deeper);
        moved += glm::dot(warp->deeper, warp->deeper);
        curvature += seen->curvature * seen->curvature_information;
        information += seen->curvature_information;
    }
    facet.slope += slope / moved;
    facet.curvature = glm::clamp(curvature / information, -kMostCurvature, kMostCurvature);
}

}  // namespace

const Observation& reference_observation(const TurntableModel& model, const Track& track) {
    glm::dvec2 sum(0.0);
    const auto angle = [&](const Observation& seen) { return model.angles_rad[static_cast<std::size_t>(seen.view)]; };
    for (const Observation& seen : track.seen) sum += glm::dvec2(std::cos(angle(seen)), std::sin(angle(seen)));
    const double middle = std::atan2(sum.y, sum.x);
    return *std::min_element(track.seen.begin(), track.seen.end(), [&](const Observation& a, const Observation& b) {
        return std::abs(nearest_turn(angle(a) - middle)) < std::abs(nearest_turn(angle(b) - middle));
    });
}

std::vector<Track> align_tracks(std::span<const CalibrationImage> turn, int reduction, const Bundle& bundle,
                                std::size_t known) {
    const TurntableModel& model = bundle.model;
    const std::size_t points = bundle.points.size();
    std::vector<std::optional<Facet>> facets(points);
    for (std::size_t i = 0; i < points; ++i) facets[i] = facet_of(bundle, i, reduction);

    std::vector<std::optional<Patch>> patches(points);
    for_each_index(turn.size(), [&](std::size_t view) {
        const PatchImage image(turn[view]);
        for (std::size_t i = 0; i < points; ++i) {
            if (!facets[i] || facets[i]->reference.view != static_cast<int>(view)) continue;
            patches[i] = extract_patch(image, facets[i]->reference.p * (1.0 / reduction));
            if (!patches[i]) facets[i].reset();
        }
    });

    // The first pass estimates slope and curvature of the surface around each point from all views; the second holds
    // them constant and estimates the positions.
    std::vector<std::vector<std::optional<Alignment>>> found =
        align_all(turn, reduction, model, facets, patches, false);
    const TurnProjection projection(model);
    for_each_index(points, [&](std::size_t i) {
        if (facets[i]) estimate_shape(*facets[i], projection, reduction, found, i);
    });
    found = align_all(turn, reduction, model, facets, patches, true);

    std::vector<Track> tracks(points);
    for (std::size_t view = 0; view < turn.size(); ++view) {
        for (std::size_t i = 0; i < points; ++i) {
            if (!found[view][i]) continue;
            tracks[i].seen.push_back(found[view][i]->seen);
        }
    }
    for (std::size_t i = 0; i < std::min(known, points); ++i) {
        if (tracks[i].seen.size() >= kFewestAligned) continue;
        tracks[i] = bundle.tracks[i];
        for (Observation& seen : tracks[i].seen) seen.weight = glm::dmat2(kDetectedWeight);
    }
    std::erase_if(tracks, [](const Track& track) { return track.seen.size() < kFewestAligned; });
    return tracks;
}

namespace {

constexpr int kStep_px = 7;  // about the width of the patch window at half its maximum

// Grid of cells of one step per view that contain a point.
class Occupancy {
public:
    Occupancy(const TurntableModel& model, int step_px)
        : width_(model.lens.width),
          height_(model.lens.height),
          step_px_(step_px),
          columns_(width_ / step_px + 1),
          rows_(height_ / step_px + 1),
          taken_(model.angles_rad.size() * static_cast<std::size_t>(columns_ * rows_), false) {}

    [[nodiscard]] bool is_free(const Observation& seen) const {
        const auto at = place(seen);
        return at && !taken_[*at];
    }
    void take(const Track& track) {
        for (const Observation& seen : track.seen) {
            if (const auto at = place(seen)) taken_[*at] = true;
        }
    }

private:
    // Nothing outside the image.
    [[nodiscard]] std::optional<std::size_t> place(const Observation& seen) const {
        if (!(seen.p.x >= 0 && seen.p.x < width_ && seen.p.y >= 0 && seen.p.y < height_)) return std::nullopt;
        const int column = static_cast<int>(seen.p.x) / step_px_, row = static_cast<int>(seen.p.y) / step_px_;
        return static_cast<std::size_t>((seen.view * rows_ + row) * columns_ + column);
    }

    int width_, height_, step_px_, columns_, rows_;
    std::vector<bool> taken_;
};

// Track of a point with observations predicted by the model in the views of another track.
std::optional<Track> expected_track(const TurnProjection& turn, const glm::dvec3& point, const Track& like) {
    Track track;
    for (const Observation& seen : like.seen) {
        const auto p = turn.project(point, static_cast<std::size_t>(seen.view));
        if (!p) return std::nullopt;
        track.seen.push_back({seen.view, *p});
    }
    return track;
}

}  // namespace

void grow_patches(Bundle& bundle, int reduction, int most) {
    const int room = most - observation_count(bundle);
    if (room <= 0) return;
    const TurntableModel& model = bundle.model;
    const TurnProjection turn(model);
    Occupancy occupied(model, kStep_px * reduction);
    for (const Track& track : bundle.tracks) occupied.take(track);
    Bundle grown;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        const auto view = static_cast<std::size_t>(reference_observation(model, bundle.tracks[i]).view);
        const Camera camera = object_camera(model, view);
        const double depth = glm::dot(bundle.points[i] - camera.centre(), camera.forward());
        const double step = kStep_px * reduction * depth / camera.fl_x;
        for (const glm::dvec3& aside : {-camera.right(), camera.right(), -camera.up(), camera.up()}) {
            const glm::dvec3 point = bundle.points[i] + aside * step;
            auto track = expected_track(turn, point, bundle.tracks[i]);
            if (!track || !occupied.is_free(reference_observation(model, *track))) continue;
            occupied.take(*track);
            grown.tracks.push_back(std::move(*track));
            grown.points.push_back(point);
        }
    }
    const std::size_t count = grown.tracks.size();
    const double share = std::min(1.0, room / std::max(1.0, static_cast<double>(observation_count(grown))));
    const auto kept_of_first = [&](std::size_t i) { return std::floor(share * static_cast<double>(i)); };
    for (std::size_t i = 0; i < count; ++i) {
        if (kept_of_first(i) == kept_of_first(i + 1)) continue;
        bundle.tracks.push_back(std::move(grown.tracks[i]));
        bundle.points.push_back(grown.points[i]);
    }
}

}  // namespace rs::capture
