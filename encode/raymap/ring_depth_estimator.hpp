#pragma once
// Depth estimation for one ring of photos and one layer of surfaces. Its steps share the photos, their depth maps and
// the visual hull, and run in this order: read_photos(), choose_hull(), complete_masks() and, if that has painted
// anything, choose_hull() again, repair_silhouettes(), match_colors(), enforce_consistency(), make_shape(). Views with
// a known surface (CaptureSet::synthesized) need read_photos(), use_known_depths() and make_shape() only.

#include "encode/raymap/cost_volume.hpp"
#include "encode/raymap/shape_map.hpp"
#include "encode/raymap/silhouettes/silhouette_repair.hpp"
#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::encode {

/// The surfaces to estimate: the object, or soft coverage behind and beside it (soft_pixels), which the object's
/// silhouettes do not enclose.
enum class Layer { kSolid, kSoft };

class RingDepthEstimator {
public:
    /// Keeps references to all arguments.
    RingDepthEstimator(const CaptureSet& set, const Rig& rig, const ViewRing& ring, const ShapeOptions& options,
                       Layer layer = Layer::kSolid);

    /// Receives a photo and its index in the set.
    using PhotoSink = std::function<void(int, const Image<Rgba8>&)>;

    /// Reads the photos and makes their working views. Calls `sink` for each photo, from any thread.
    Status read_photos(Progress* progress, const PhotoSink& sink);

    /// Chooses the visual hull's margin. `rings` are the rings next below and above; they are used where their
    /// silhouettes agree with this ring's.
    void choose_hull(const std::vector<const RingDepthEstimator*>& rings);

    /// Finds parts of the object that masks lack, from depth at half size, and paints the large ones from neighboring
    /// photos (lost_parts.hpp), unless many photos lack one: then the rig is wrong. Calls `sink` for each changed
    /// photo, one after the other. Does nothing where the silhouettes agree exactly. Solid layer only.
    Status complete_masks(Progress* progress, const PhotoSink& sink);
    /// Adds the missing parts to the silhouettes of the hull (silhouette_repair.hpp), where the silhouettes agree. The
    /// photos are not changed.
    void repair_silhouettes();

    /// Estimates each photo's depth from colours.
    Status match_colors(Progress* progress);

    /// Estimates each photo's depth again, from colours and the neighbors' depths: first every second photo, then the
    /// others, which see the first ones' results; all at once would exchange errors. Then finds the occluders.
    /// Appends a few evenly spaced depth maps to `samples`.
    Status enforce_consistency(Progress* progress, std::vector<DepthPreview>& samples);

    /// Takes each view's depth from the set's synthesized views instead of estimating it. All depths may occlude.
    void use_known_depths();

    /// True if any photo has soft coverage.
    [[nodiscard]] bool has_soft_pixels() const;

    [[nodiscard]] SurfaceLayer surfaces() const {
        return {views_, sampled_hull_.get(), silhouettes_agree_, layer_ == Layer::kSolid};
    }

    [[nodiscard]] ShapeMap make_shape(const std::vector<SurfaceLayer>& layers, int planes) const;
    /// Appends a line for each empty photo, and one for the sectors without photos.
    void append_warnings(const ShapeMap& shape, std::vector<std::string>& warnings) const;

private:
    [[nodiscard]] int count() const { return static_cast<int>(views_.size()); }
    void set_photo(std::size_t n, const Image<Rgba8>& photo);
    // Called on the half-sized estimator of `whole`: for each of its views, the depths of the surface that other photos
    // show where its mask has no object.
    Result<std::vector<Image<float>>> find_missing(const RingDepthEstimator& whole, Progress* progress);
    // Paints a missing part. nullopt where no photo near enough shows it.
    Result<std::optional<Image<Rgba8>>> paint_part(std::size_t n, const RingDepthEstimator& half,
                                                   const Image<float>& part) const;

    // Matching costs of the levels that the hull allows.
    [[nodiscard]] CostVolume color_costs(int n, const Neighbours& neighbours, const DepthRange& range) const;
    // Removes depths of pixels that belong to the other layer.
    void mask_layer(Image<float>& depth, const Image<std::uint8_t>& soft) const;
    // The silhouettes of this ring and of others, repaired where they are.
    [[nodiscard]] std::vector<const WorkView*> silhouettes(const std::vector<const RingDepthEstimator*>& others) const;
    [[nodiscard]] std::unique_ptr<SampledHull> sampled(VisualHull hull, double spacing_px) const;
    void sample_hull();
    Status estimate_depths(const char* label, Progress* progress, bool keep_costs);
    void choose_margin(const std::vector<const RingDepthEstimator*>& beside);
    [[nodiscard]] int tolerated(const std::vector<const WorkView*>& views) const {
        return static_cast<int>(tolerated_share_ * static_cast<double>(views.size()));
    }
    [[nodiscard]] std::vector<const RingDepthEstimator*> consistent_rings(
        const std::vector<const RingDepthEstimator*>& rings) const;
    [[nodiscard]] double gap_deg(int n) const;
    [[nodiscard]] Neighbours neighbours_of(int n) const;
    [[nodiscard]] DepthRange range_of(int n, const Neighbours& neighbours) const;

    const CaptureSet& set_;
    const Rig& rig_;
    const ViewRing& ring_;
    const ShapeOptions& options_;
    Layer layer_;
    int reduction_ = 1;  // from the photos' size to the working size
    std::vector<DepthView> views_;
    std::vector<Image<std::uint8_t>> texture_;           // of each view
    std::vector<Image<float>> missing_;                  // of each view at half size; empty before find_missing()
    std::vector<std::optional<WorkView>> repaired_;      // silhouettes that had missing parts
    std::vector<Image<std::uint8_t>> soft_;              // of each view
    std::vector<std::optional<CostVolume>> kept_costs_;  // of each view, until enforce_consistency()
    std::vector<const RingDepthEstimator*> adjacent_;    // the consistent rings below and above
    std::unique_ptr<VisualHull> hull_;
    std::unique_ptr<SampledHull> sampled_hull_;
    int margin_px_ = 1;
    double tolerated_share_ = 0;  // of the silhouettes that may forbid a place of the hull
    double contradicted_ = 1;     // share of the object that the hull rules out at margin_px_
    bool silhouettes_agree_ = true;
};

}  // namespace rs::encode
