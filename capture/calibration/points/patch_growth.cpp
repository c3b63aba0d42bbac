#include "capture/calibration/points/patch_growth.hpp"

#include "capture/calibration/points/patch_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace rs::capture {
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
