#include "encode/posed/ring_plan.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace rs::encode {
namespace {

constexpr double kFrameMargin_px = 3;
constexpr int kBytesPerPixel = 8;  // colour and depth
constexpr double kLeastDensity = 0.5;
constexpr double kOutermost = 0.02;  // share of the photos that are ignored at either end of the elevations

// Pixels per unit at the axis, of the photos in the middle.
double photo_density(std::span<const PosedPhoto> photos) {
    std::vector<double> densities;
    for (const PosedPhoto& photo : photos) densities.push_back(photo.camera.fl_x / glm::length(photo.camera.centre()));
    return median(densities);
}

std::pair<double, double> elevation_range(std::span<const PosedPhoto> photos, double highest_rad) {
    std::vector<double> elevations;
    for (const PosedPhoto& photo : photos) {
        const glm::dvec3 centre = photo.camera.centre();
        elevations.push_back(
            std::clamp(std::atan2(centre.y, std::hypot(centre.x, centre.z)), -highest_rad, highest_rad));
    }
    std::ranges::sort(elevations);
    const auto ignored = static_cast<std::size_t>(kOutermost * static_cast<double>(elevations.size()));
    return {elevations[ignored], elevations[elevations.size() - 1 - ignored]};
}

// Cameras of a ring with the principal point at (0, 0).
Rig make_upright_ring(double elevation_rad, int count, double distance, double px_per_unit) {
    Rig ring;
    for (int n = 0; n < count; ++n) {
        const double azimuth = 2 * kPi * n / count;
        const glm::dvec3 outwards(std::sin(azimuth), 0, std::cos(azimuth));
        RigView view;
        Camera& camera = view.camera;
        const glm::dvec3 right(outwards.z, 0, -outwards.x);
        camera.world_from_camera =
            glm::dmat4(glm::dvec4(right, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(outwards, 0),
                       glm::dvec4(distance * outwards + glm::dvec3(0, distance * std::tan(elevation_rad), 0), 1));
        camera.fl_x = px_per_unit * distance;
        camera.fl_y = camera.fl_x * std::cos(elevation_rad);
        ring.views.push_back(std::move(view));
    }
    return ring;
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

Rig make_rig(const std::vector<double>& elevations, const SignedVolume::Bounds& object, const RingPlanOptions& options,
             double px_per_unit) {
    Rig rig;
    rig.object_radius = object.radius;
    for (const double elevation : elevations) {
        const int count = std::max(static_cast<int>(std::lround(options.views * std::cos(elevation))),
                                   std::min(options.least_views, options.views));
        const Rig ring = make_upright_ring(elevation, count, options.distance_radii * object.radius, px_per_unit);
        for (const RigView& view : ring.views) {
            rig.views.push_back(view);
            char name[32];
            std::snprintf(name, sizeof name, "images/%04d.png", static_cast<int>(rig.views.size() - 1));
            rig.views.back().file_path = name;
        }
    }
    frame_views(rig, object);
    return rig;
}

}  // namespace

Result<RingPlan> plan_rings(std::span<const PosedPhoto> photos, const SignedVolume::Bounds& object,
                            const RingPlanOptions& options) {
    RingPlan plan;
    const auto [lowest, highest] = elevation_range(photos, radians(options.highest_deg));
    const double range_deg = degrees(highest - lowest);
    plan.rings = 1 + static_cast<int>(std::ceil(range_deg / options.step_deg - 0.01));
    std::vector<double> elevations;
    for (int r = 0; r < plan.rings; ++r) {
        elevations.push_back(plan.rings == 1 ? (lowest + highest) / 2
                                             : lowest + (highest - lowest) * r / (plan.rings - 1));
    }
    plan.lowest_deg = degrees(elevations.front());
    plan.highest_deg = degrees(elevations.back());
    double density = photo_density(photos);
    for (double part = 1; part >= kLeastDensity; part *= 0.9) {
        plan.rig = make_rig(elevations, object, options, part * density);
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
