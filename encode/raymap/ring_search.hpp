#pragma once
// One ring's search for one layer of surfaces; holds what its steps share. In this order: read(), choose_hull(),
// complete_cut_outs() and, if that has painted anything, choose_hull() again, mend_silhouettes(), match(), agree(),
// lines().

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

// What of the pictures a search looks for: the object, or what is soft behind and beside it (soft_pixels), which the
// object's silhouettes do not enclose.
enum class Layer { kSolid, kSoft };

class RingSearch {
public:
    // Refers to all of them.
    RingSearch(const CaptureSet& set, const Rig& rig, const ViewRing& ring, const ShapeOptions& options,
               Layer layer = Layer::kSolid);

    // Each picture is passed to `keep`, with its number in the set, from any thread.
    using Keep = std::function<void(int, const Image<Rgba8>&)>;
    Status read(Progress* progress, const Keep& keep);

    // The hull; `rings` are those next below and above, where there are such.
    void choose_hull(const std::vector<const RingSearch*>& rings);

    // Finds what cut-outs lack, by points that the object's pictures of half the size show, and paints large parts
    // of it (lost_parts.hpp), if few pictures lack one: else the rig is at fault. Those pictures are passed to `keep`,
    // one after the other. Nothing is searched where the silhouettes contradict one another nowhere. Not for the soft
    // layer.
    Status complete_cut_outs(Progress* progress, const Keep& keep);
    // Where the silhouettes agree, what was found is added to them (silhouette_repair.hpp), not to the pictures.
    void mend_silhouettes();

    // The depths that the colours show.
    Status match(Progress* progress);

    // The same again, now that there are depths that pictures can agree about: every second picture with what the
    // colours show of its neighbours, then the others with what those have found. If all went at once, neighbours would
    // take over one another's faults. A few evenly spread depths are kept for people.
    Status agree(Progress* progress, std::vector<FoundDepth>& samples);

    [[nodiscard]] bool shows_soft() const;

    [[nodiscard]] SurfaceLayer surfaces() const {
        return {views_, *sampled_hull_, silhouettes_agree_, layer_ == Layer::kSolid};
    }

    [[nodiscard]] ShapeMap lines(const std::vector<SurfaceLayer>& layers, int planes) const;
    void warn(const ShapeMap& shape, std::vector<std::string>& warnings) const;

private:
    [[nodiscard]] int count() const { return static_cast<int>(views_.size()); }
    void take(std::size_t n, const Image<Rgba8>& picture);
    // Of each picture of half the size, this search's: what the others show of the object where it has none.
    Result<std::vector<Image<float>>> find_missing(const RingSearch& whole, Progress* progress);
    // Nothing where no picture near enough shows it.
    Result<std::optional<Image<Rgba8>>> completed(std::size_t n, const RingSearch& half,
                                                  const Image<float>& part) const;

    // What the colours show of each level that the hull allows.
    [[nodiscard]] CostVolume colour_costs(int n, const Neighbours& neighbours, const DepthRange& range) const;
    void keep_layer(Image<float>& depth, const Image<std::uint8_t>& soft) const;
    // Of this ring and the others.
    [[nodiscard]] std::vector<const WorkView*> work_views(const std::vector<const RingSearch*>& others) const;
    [[nodiscard]] std::unique_ptr<SampledHull> sampled(VisualHull hull, double spacing_px) const;
    Status search(const char* label, Progress* progress, bool keep_costs);
    void find_margin(const std::vector<const RingSearch*>& beside);
    [[nodiscard]] int overruled(const std::vector<const WorkView*>& views) const {
        return static_cast<int>(overruled_share_ * static_cast<double>(views.size()));
    }
    [[nodiscard]] std::vector<const RingSearch*> agreeing(const std::vector<const RingSearch*>& rings) const;
    [[nodiscard]] double gap_deg(int n) const;
    [[nodiscard]] Neighbours neighbours_of(int n) const;
    [[nodiscard]] DepthRange range_of(int n, const Neighbours& neighbours) const;

    const CaptureSet& set_;
    const Rig& rig_;
    const ViewRing& ring_;
    const ShapeOptions& options_;
    Layer layer_;
    int reduction_ = 1;  // of the pictures to the working size
    std::vector<DepthView> views_;
    std::vector<Image<float>> missing_;                  // of each view at half the size; empty before it is found
    std::vector<std::optional<WorkView>> mended_;        // silhouettes that lacked something
    std::vector<Image<std::uint8_t>> soft_;              // of each view
    std::vector<std::optional<CostVolume>> kept_costs_;  // of each view, from match() to agree()
    std::vector<const RingSearch*> beside_;
    std::unique_ptr<VisualHull> hull_;
    std::unique_ptr<SampledHull> sampled_hull_;
    int margin_px_ = 1;
    double overruled_share_ = 0;
    double contradicted_ = 1;  // by the last margin that was tried, share of the object
    bool silhouettes_agree_ = true;
};

}  // namespace rs::encode
