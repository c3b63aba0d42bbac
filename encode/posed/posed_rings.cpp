#include "encode/posed/posed_rings.hpp"

#include "encode/posed/depth_fusion.hpp"
#include "encode/set/set_checks.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/geometry/rig_conventions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rs::encode {
namespace {

constexpr double kNearPhoto_deg = 2;  // between the directions of a photo and a view that shows it almost unchanged

Result<std::vector<PosedPhoto>> read_photos(const CaptureSet& set, Progress* progress) {
    std::vector<PosedPhoto> photos(set.captured.views.size());
    const int count = static_cast<int>(photos.size());
    RS_TRY(for_each_in_parallel(count, "photos", progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        const RigView& view = set.captured.views[n];
        RS_ASSIGN_OR_RETURN(Image<Rgba8> image, read_upright_image(set, i));
        photos[n] = {image_path(set.folder, view).string(), view.camera, std::move(image)};
        return {};
    }));
    return photos;
}

Result<SignedVolume> reconstruct_surface(std::span<const PosedPhoto> photos, const PosedOptions& options,
                                         Progress* progress) {
    RS_ASSIGN_OR_RETURN(const CarvedHull hull, carve_hull(photos, options.hull, progress));
    RS_ASSIGN_OR_RETURN(const std::vector<PhotoDepth> depths,
                        estimate_photo_depths(photos, hull.volume, options.depth, progress));
    return fuse_depths(hull.volume, depths, progress);
}

// Share of the synthesized views that a photo shows from nearly the same direction.
double photographed_share(std::span<const PosedPhoto> photos, const RingPlan& plan) {
    const double least_cosine = std::cos(radians(kNearPhoto_deg));
    double near = 0, all = 0;
    for (std::size_t n = 0; n < plan.photos.size(); ++n) {
        if (plan.photos[n] >= 0) continue;
        const glm::dvec3 direction = glm::normalize(plan.rig.views[n].camera.centre());
        const bool is_near = std::ranges::any_of(photos, [&](const PosedPhoto& photo) {
            return glm::dot(direction, glm::normalize(photo.camera.centre())) >= least_cosine;
        });
        near += is_near ? 1 : 0;
        all += 1;
    }
    return all > 0 ? near / all : 0;
}

std::string summary(std::span<const PosedPhoto> photos, const RingPlan& plan) {
    const auto whole = [](double degrees) { return std::to_string(std::lround(degrees)); };
    const auto synthesized = std::ranges::count(plan.photos, -1);
    const auto used = static_cast<std::ptrdiff_t>(plan.photos.size()) - synthesized;
    return "the cameras are not one turn: " + std::to_string(synthesized) + " views, for " +
           std::to_string(plan.rings.size()) + " rings at elevations of " + whole(plan.lowest_deg) + " to " +
           whole(plan.highest_deg) + " degrees, are synthesized from " + std::to_string(photos.size()) + " photos, " +
           whole(100 * photographed_share(photos, plan)) + " % of them within " + whole(kNearPhoto_deg) +
           " degrees of a photo" + (used > 0 ? "; " + std::to_string(used) + " photos are used as they are" : "");
}

}  // namespace

Result<CaptureSet> with_rings(CaptureSet set, const PosedOptions& options, Progress* progress) {
    if (!set.posed) return set;
    const Result<std::vector<PosedPhoto>> photos = read_photos(set, progress);
    if (!photos) return photos.error();
    const Result<SignedVolume> surface = reconstruct_surface(*photos, options, progress);
    if (!surface) return Error{set.file.string() + ": " + surface.error().message};
    const auto bounds = surface->bounds();
    if (!bounds) return Error{set.file.string() + ": no surface is left of the object; check the masks"};
    Result<RingPlan> plan = plan_rings(*photos, *bounds, options.rings);
    if (!plan) return Error{set.file.string() + ": " + plan.error().message};

    set.warnings.push_back(summary(*photos, *plan));
    set.posed = false;
    set.upright.views = std::move(plan->rig.views);
    set.upright.object_radius = plan->rig.object_radius;
    // Views about other axes than Y are posed photos for other programs.
    const bool has_cap = std::ranges::any_of(plan->rings, [](const ViewRing& r) { return !r.rotation.is_identity(); });
    if (!has_cap) set.upright.extras.erase(kPosedKey);
    const Rig captured = std::exchange(set.captured, set.upright);
    for (std::size_t n = 0; n < plan->photos.size(); ++n) {
        if (plan->photos[n] < 0) continue;
        set.captured.views[n] = captured.views[static_cast<std::size_t>(plan->photos[n])];
        set.upright.views[n].file_path = set.captured.views[n].file_path;
        set.resampled = true;
    }
    set.rings = std::move(plan->rings);
    set.width = set.upright.views.front().camera.width;
    set.height = set.upright.views.front().camera.height;
    const ViewSynthesizer synthesizer(*photos, *surface, options.synthesis, progress);
    set.synthesized.resize(set.upright.views.size());
    const int count = static_cast<int>(set.synthesized.size());
    RS_TRY(for_each_in_parallel(count, "synthesized views", progress, [&](int i) -> Status {
        const auto n = static_cast<std::size_t>(i);
        if (plan->photos[n] >= 0) return {};
        set.synthesized[n] = std::make_shared<const PackedView>(synthesizer.synthesize(set.upright.views[n].camera));
        return {};
    }));
    return set;
}

}  // namespace rs::encode
