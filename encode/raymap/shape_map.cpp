#include "encode/raymap/shape_map.hpp"

#include "encode/raymap/ring_depth_estimator.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/object/yuv.hpp"

#include <utility>

namespace rs::encode {
namespace {

std::string lost_parts_text(const CompletedImages& completed, const Rig& rig) {
    const std::string first = rig.views[static_cast<std::size_t>(completed.begin()->first)].file_path;
    const std::string count = std::to_string(completed.size());
    return (completed.size() == 1 ? "the mask of " + first + " lacks" : count + " masks lack") +
           " a large part that neighbouring photos show" +
           (completed.size() == 1 ? "" : " (" + first + " is the first)") +
           "; it is painted from these; correct the masks to use the photos' own pixels";
}

bool has_known_surface(const CaptureSet& set, const ViewRing& ring) {
    return !set.synthesized.empty() && set.synthesized[static_cast<std::size_t>(ring.views.front())] != nullptr;
}

}  // namespace

Result<ShapeMapOutput> add_shape_maps(const ShapeMapInput& input, const ShapeOptions& options, RaySpaceObject& object,
                                      Progress* progress) {
    const CaptureSet& set = input.set;
    const Rig& rig = input.rig;
    const std::vector<ViewRing>& rings = input.rings;
    RS_CHECK(set.completed.empty());
    ShapeMapOutput found;
    const auto keep = [&](int v, const Image<Rgba8>& image) {
        if (input.keep_images) object.images[static_cast<std::size_t>(v)] = planar_from_rgba(image);
    };
    std::vector<std::size_t> photographed;  // rings
    std::vector<RingDepthEstimator> estimators;
    estimators.reserve(rings.size());
    for (std::size_t r = 0; r < rings.size(); ++r) {
        RingDepthEstimator estimator(set, rig, rings[r], options);
        RS_TRY(estimator.read_photos(progress, keep));
        if (has_known_surface(set, rings[r])) {
            estimator.use_known_depths();
            object.rings[r].shape = estimator.make_shape({estimator.surfaces()}, object.rings[r].planes);
            continue;
        }
        photographed.push_back(r);
        estimators.push_back(std::move(estimator));
    }
    const auto choose_hulls = [&] {
        for (std::size_t i = 0; i < estimators.size(); ++i) {
            std::vector<const RingDepthEstimator*> beside;
            if (i > 0) beside.push_back(&estimators[i - 1]);
            if (i + 1 < estimators.size()) beside.push_back(&estimators[i + 1]);
            estimators[i].choose_hull(beside);
        }
    };
    choose_hulls();
    CaptureSet whole = set;  // with completed masks
    const auto keep_completed = [&](int v, const Image<Rgba8>& image) {
        keep(v, image);
        whole.completed.insert_or_assign(v, image);
    };
    for (RingDepthEstimator& estimator : estimators) {
        RS_TRY(estimator.complete_masks(progress, keep_completed));
    }
    if (!whole.completed.empty()) {
        found.warnings.push_back(lost_parts_text(whole.completed, rig));
        choose_hulls();
    }
    for (RingDepthEstimator& estimator : estimators) estimator.repair_silhouettes();
    for (RingDepthEstimator& estimator : estimators) {
        RS_TRY(estimator.match_colors(progress));
    }
    for (std::size_t i = 0; i < estimators.size(); ++i) {
        RingDepthEstimator& estimator = estimators[i];
        RS_TRY(estimator.enforce_consistency(progress, found.samples));
        Ring& ring = object.rings[photographed[i]];
        std::vector<SurfaceLayer> layers = {estimator.surfaces()};
        RingDepthEstimator soft(whole, rig, rings[photographed[i]], options, Layer::kSoft);
        if (estimator.has_soft_pixels()) {
            std::vector<DepthPreview> unused;
            RS_TRY(soft.read_photos(progress, [](int, const Image<Rgba8>&) {}));
            soft.choose_hull({});
            RS_TRY(soft.match_colors(progress));
            RS_TRY(soft.enforce_consistency(progress, unused));
            layers.push_back(soft.surfaces());
        }
        ring.shape = estimator.make_shape(layers, ring.planes);
        estimator.append_warnings(ring.shape, found.warnings);
    }
    found.completed = std::move(whole.completed);
    return found;
}

}  // namespace rs::encode
