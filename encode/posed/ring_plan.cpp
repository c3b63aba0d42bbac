#include "encode/posed/ring_plan.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/geometry/ring_axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace rs::encode {
namespace {

constexpr double kFrameMargin_px = 3;
constexpr int kBytesPerPixel = 8;  // colour and depth
constexpr double kLeastDensity = 0.5;
constexpr double kOutermost = 0.02;    // share of the photos that are ignored at either end of the elevations
constexpr double kTurnSpread_deg = 1;  // elevations of a turn's photos, from their mean
constexpr double kNearestTurn_radii = 1.25;
constexpr double kTurnGap_deg = 12.5;  // largest step of a turn
constexpr int kLeastViewsOfArc = 3;
constexpr double kArcMargin_deg = 10;  // rays of viewpoints farther away than the cameras lie beside the arc's views

double elevation_of(const glm::dvec3& direction) {
    return std::atan2(direction.y, std::hypot(direction.x, direction.z));
}

// Elevations of the photos.
struct Range {
    double low = 0, high = 0;
    [[nodiscard]] Range clamped(double largest) const {
        return {std::clamp(low, -largest, largest), std::clamp(high, -largest, largest)};
    }
};

Range elevation_range(std::span<const PosedPhoto> photos) {
    std::vector<double> elevations;
    for (const PosedPhoto& photo : photos) elevations.push_back(elevation_of(photo.camera.centre()));
    std::ranges::sort(elevations);
    const auto ignored = static_cast<std::size_t>(kOutermost * static_cast<double>(elevations.size()));
    return {elevations[ignored], elevations[elevations.size() - 1 - ignored]};
}

// Values from `low` to `high`, at most `step` apart.
std::vector<double> evenly(Range range, double step) {
    const int steps = static_cast<int>(std::ceil((range.high - range.low) / step - 0.001));
    std::vector<double> values;
    for (int n = 0; n <= steps; ++n) {
        values.push_back(steps == 0 ? (range.low + range.high) / 2 : range.low + (range.high - range.low) * n / steps);
    }
    return values;
}

// A camera in its ring's axes.
struct PlannedView {
    double azimuth_rad = 0;
    double elevation_rad = 0;
    double distance = 0;  // from the origin, of a photo; 0: as the photos in the middle
    int photo = -1;       // that is used as it is
};

// A ring or an arc of cameras.
struct PlannedRing {
    RingRotation rotation;
    double elevation_rad = 0;
    std::vector<PlannedView> views;
};

// Turns of a turntable: rings of photos, lowest first. The photos of steep ones are synthesized from the same places.
std::vector<PlannedRing> photographed_rings(std::span<const PosedPhoto> photos, double object_radius,
                                            const RingPlanOptions& options) {
    Rig rig;
    for (const PosedPhoto& photo : photos) rig.views.emplace_back().camera = photo.camera;
    std::vector<PlannedRing> rings;
    for (const ViewRing& found : find_rings(rig)) {
        PlannedRing ring{{}, found.elevation_rad, {}};
        const bool is_steep = std::abs(found.elevation_rad) > radians(options.steepest_deg);
        double spread = 0;
        double nearest = std::numeric_limits<double>::max();  // distance from the axis
        for (const int i : found.views) {
            const glm::dvec3 centre = rig.views[static_cast<std::size_t>(i)].camera.centre();
            const PlannedView view{std::atan2(centre.x, centre.z), elevation_of(centre), glm::length(centre),
                                   is_steep ? -1 : i};
            spread = std::max(spread, std::abs(view.elevation_rad - found.elevation_rad));
            nearest = std::min(nearest, std::hypot(centre.x, centre.z));
            ring.views.push_back(view);
        }
        double gap = 0;
        for (std::size_t n = 0; n < ring.views.size(); ++n) {
            const PlannedView& next = ring.views[(n + 1) % ring.views.size()];
            gap = std::max(gap, std::abs(std::remainder(next.azimuth_rad - ring.views[n].azimuth_rad, 2 * kPi)));
        }
        const bool is_turn = spread <= radians(kTurnSpread_deg) && gap <= radians(kTurnGap_deg);
        const bool is_usable = std::abs(found.elevation_rad) <= radians(options.steepest_turn_deg) &&
                               nearest >= kNearestTurn_radii * object_radius;
        if (is_turn && is_usable) rings.push_back(std::move(ring));
    }
    return rings;
}

PlannedRing synthetic_ring(double elevation, int level_views) {
    const int count = std::max(static_cast<int>(std::ceil(level_views * std::cos(elevation))), 8);
    PlannedRing ring{{}, elevation, {}};
    for (int n = 0; n < count; ++n) ring.views.push_back({2 * kPi * n / count, elevation});
    return ring;
}

// Rings about the object's axis: those of the photos, and synthetic ones between and beside them.
void add_rings(Range elevations, std::vector<PlannedRing> photographed, const RingPlanOptions& options,
               std::vector<PlannedRing>& rings) {
    const auto fill = [&](double low, double high, bool has_low, bool has_high) {
        const std::vector<double> between = evenly({low, high}, radians(options.step_deg));
        for (std::size_t n = has_low ? 1 : 0; n + (has_high ? 1 : 0) < between.size(); ++n) {
            rings.push_back(synthetic_ring(between[n], options.views));
        }
    };
    double low = elevations.low;
    bool has_low = false;
    for (PlannedRing& ring : photographed) {
        if (ring.elevation_rad > low) fill(low, ring.elevation_rad, has_low, true);
        low = ring.elevation_rad;
        has_low = true;
        rings.push_back(std::move(ring));
    }
    if (!has_low || elevations.high > low) fill(low, elevations.high, has_low, false);
}

// Arcs about an axis across the object's that show it from the elevation `from_rad` on upwards (side = 1) or downwards
// (-1).
void add_cap(double from_rad, int side, const RingPlanOptions& options, std::vector<PlannedRing>& rings) {
    // The ring's Z is the object's Y, its Y the object's X.
    const RingRotation rotation =
        ring_rotation(glm::transpose(glm::dmat3(glm::dvec3(0, 0, side), glm::dvec3(1, 0, 0), glm::dvec3(0, side, 0))));
    const double half = kPi / 2 - from_rad;
    for (const double elevation : evenly({-half, half}, radians(options.step_deg))) {
        const double cosine = std::sin(from_rad - radians(options.step_deg) / 2) / std::cos(elevation);
        if (cosine >= 1) continue;
        const double reach = std::acos(cosine) + radians(kArcMargin_deg);
        const int count = 1 + static_cast<int>(std::ceil(reach / kPi * options.views * std::cos(elevation)));
        if (count < kLeastViewsOfArc) continue;
        PlannedRing arc{rotation, elevation, {}};
        for (int n = 0; n < count; ++n) arc.views.push_back({reach * (2.0 * n / (count - 1) - 1), elevation});
        rings.push_back(std::move(arc));
    }
}

// The camera of a ring in the ring's axes, with the principal point at (0, 0). `distance` is from the ring's axis.
Camera upright_camera_at(const PlannedView& view, double distance, double px_per_unit) {
    const glm::dvec3 outwards(std::sin(view.azimuth_rad), 0, std::cos(view.azimuth_rad));
    const glm::dvec3 right(outwards.z, 0, -outwards.x);
    Camera camera;
    camera.world_from_camera =
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(outwards, 0),
                   glm::dvec4(distance * outwards + glm::dvec3(0, distance * std::tan(view.elevation_rad), 0), 1));
    // Rows and columns are as dense on the object as the photos' pixels.
    camera.fl_x = px_per_unit * distance;
    camera.fl_y = camera.fl_x * std::cos(view.elevation_rad);
    return camera;
}

struct Frame {
    double left = 0, right = 0, top = 0, bottom = 0;
};

// Frame of a cylinder about the axis; the same for all cameras of a ring.
Frame frame_of(const Camera& camera, const SignedVolume::Bounds& object) {
    Frame frame{1e30, -1e30, 1e30, -1e30};
    constexpr int kPoints = 64;
    for (int n = 0; n < kPoints; ++n) {
        const double azimuth = 2 * kPi * n / kPoints;
        for (const double y : {object.low.y, object.high.y}) {
            const glm::dvec3 seen =
                camera.project({object.radius * std::sin(azimuth), y, object.radius * std::cos(azimuth)});
            frame = {std::min(frame.left, seen.x), std::max(frame.right, seen.x), std::min(frame.top, seen.y),
                     std::max(frame.bottom, seen.y)};
        }
    }
    return frame;
}

// Sets one size for all views, with the object in the middle of each.
void frame_views(Rig& rig, const SignedVolume::Bounds& object) {
    double width = 0, height = 0;
    std::vector<Frame> frames;
    for (const RigView& view : rig.views) {
        frames.push_back(frame_of(view.camera, object));
        width = std::max(width, frames.back().right - frames.back().left + 2 * kFrameMargin_px);
        height = std::max(height, frames.back().bottom - frames.back().top + 2 * kFrameMargin_px);
    }
    const auto even = [](double size) { return 2 * static_cast<int>(std::ceil(size / 2)); };
    for (std::size_t n = 0; n < rig.views.size(); ++n) {
        Camera& camera = rig.views[n].camera;
        camera.width = even(width);
        camera.height = even(height);
        camera.cx = camera.width / 2.0 - (frames[n].left + frames[n].right) / 2;
        camera.cy = camera.height / 2.0 - (frames[n].top + frames[n].bottom) / 2;
    }
}

// Distances and density of the photos' cameras in the middle.
struct PhotoScale {
    double distance = 0;
    double px_per_unit = 0;  // at the axis
};

PhotoScale scale_of(std::span<const PosedPhoto> photos) {
    std::vector<double> distances;
    std::vector<double> densities;
    for (const PosedPhoto& photo : photos) {
        distances.push_back(glm::length(photo.camera.centre()));
        densities.push_back(photo.camera.fl_x / distances.back());
    }
    return {median(distances), median(densities)};
}

void add_views(const std::vector<PlannedRing>& planned, const PhotoScale& scale, const RingPlanOptions& options,
               RingPlan& plan) {
    plan.rig.views.clear();
    plan.rings.clear();
    plan.photos.clear();
    for (const PlannedRing& ring : planned) {
        ViewRing views{ring.elevation_rad, {}, ring.rotation};
        for (const PlannedView& planned_view : ring.views) {
            const double cosine = std::cos(planned_view.elevation_rad);
            // A photo that is resampled needs the density of the photo's own focal length.
            const double px_per_unit = planned_view.photo < 0 ? scale.px_per_unit : scale.px_per_unit / cosine;
            const double distance =
                planned_view.distance > 0
                    ? planned_view.distance * cosine
                    : std::max(scale.distance * cosine, options.least_distance_radii * plan.rig.object_radius);
            views.views.push_back(static_cast<int>(plan.rig.views.size()));
            char name[32];
            std::snprintf(name, sizeof name, "images/%04d.png", views.views.back());
            RigView& view = plan.rig.views.emplace_back();
            view.file_path = name;
            plan.photos.push_back(planned_view.photo);
            view.camera = in_object_axes(upright_camera_at(planned_view, distance, px_per_unit), ring.rotation);
        }
        plan.rings.push_back(std::move(views));
    }
}

}  // namespace

Result<RingPlan> plan_rings(std::span<const PosedPhoto> photos, const SignedVolume::Bounds& object,
                            const RingPlanOptions& options) {
    const Range photographed = elevation_range(photos);
    const double steepest = radians(options.steepest_deg);
    const double beyond = steepest + radians(options.step_deg) / 2;
    const bool has_upper_cap = photographed.high > beyond;
    const bool has_lower_cap = photographed.low < -beyond;
    RingPlan plan;
    plan.lowest_deg = has_lower_cap ? -90 : degrees(photographed.low);
    plan.highest_deg = has_upper_cap ? 90 : degrees(photographed.high);
    const double half_height = std::max(std::abs(object.low.y), std::abs(object.high.y));
    const bool has_cap = has_upper_cap || has_lower_cap;
    plan.rig.object_radius = has_cap ? std::hypot(object.radius, half_height) : object.radius;

    std::vector<PlannedRing> turns = photographed_rings(photos, plan.rig.object_radius, options);
    const double from_above = turns.empty() ? steepest : std::max(steepest, turns.back().elevation_rad);
    const double from_below = turns.empty() ? steepest : std::max(steepest, -turns.front().elevation_rad);
    std::vector<PlannedRing> planned;
    add_rings(photographed.clamped(steepest), std::move(turns), options, planned);
    if (has_upper_cap) add_cap(from_above, 1, options, planned);
    if (has_lower_cap) add_cap(from_below, -1, options, planned);

    PhotoScale scale = scale_of(photos);
    const double density = scale.px_per_unit;
    for (double part = 1; part >= kLeastDensity; part *= 0.9) {
        scale.px_per_unit = part * density;
        add_views(planned, scale, options, plan);
        frame_views(plan.rig, object);
        const Camera& camera = plan.rig.views.front().camera;
        const auto bytes =
            static_cast<std::int64_t>(plan.rig.views.size()) * camera.width * camera.height * kBytesPerPixel;
        const bool fits = camera.width <= kMaxImageSide_px && camera.height <= kMaxImageSide_px;
        if (fits && bytes <= options.memory_bytes) return plan;
    }
    return Error{"views as dense as the photos take more than " + std::to_string(options.memory_bytes >> 20) +
                 " MiB; make the photos smaller"};
}

}  // namespace rs::encode
