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

// Shape maps of views with a known surface. Rings are independent, so that one is in memory at a time.
Status add_known_shapes(const ShapeMapInput& input, const ShapeOptions& options, RaySpaceObject& object,
                        Progress* progress, const RingDepthEstimator::PhotoSink& keep) {
    for (std::size_t r = 0; r < input.rings.size(); ++r) {
        RingDepthEstimator estimator(input.set, input.rig, input.rings[r], options);
        RS_TRY(estimator.read_photos(progress, keep));
        estimator.use_known_depths();
        object.rings[r].shape = estimator.make_shape({estimator.surfaces()}, object.rings[r].planes);
    }
    return {};
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
    if (!set.synthesized.empty()) {
        RS_TRY(add_known_shapes(input, options, object, progress, keep));
        return found;
    }
    std::vector<RingDepthEstimator> estimators;
    estimators.reserve(rings.size());
    for (const ViewRing& ring : rings) {
        estimators.emplace_back(set, rig, ring, options);
        RS_TRY(estimators.back().read_photos(progress, keep));
    }
    const auto choose_hulls = [&] {
        for (std::size_t r = 0; r < rings.size(); ++r) {
            std::vector<const RingDepthEstimator*> beside;
            if (r > 0) beside.push_back(&estimators[r - 1]);
            if (r + 1 < rings.size()) beside.push_back(&estimators[r + 1]);
            estimators[r].choose_hull(beside);
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
    for (std::size_t r = 0; r < rings.size(); ++r) {
        RS_TRY(estimators[r].enforce_consistency(progress, found.samples));
        Ring& ring = object.rings[r];
        std::vector<SurfaceLayer> layers = {estimators[r].surfaces()};
        RingDepthEstimator soft(whole, rig, rings[r], options, Layer::kSoft);
        if (estimators[r].has_soft_pixels()) {
            std::vector<DepthPreview> unused;
            RS_TRY(soft.read_photos(progress, [](int, const Image<Rgba8>&) {}));
            soft.choose_hull({});
            RS_TRY(soft.match_colors(progress));
            RS_TRY(soft.enforce_consistency(progress, unused));
            layers.push_back(soft.surfaces());
        }
        ring.shape = estimators[r].make_shape(layers, ring.planes);
        estimators[r].append_warnings(ring.shape, found.warnings);
    }
    found.completed = std::move(whole.completed);
    return found;
}

}  // namespace rs::encode
