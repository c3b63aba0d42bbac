#include "encode/raymap/shape_map.hpp"

#include "encode/raymap/captured_view.hpp"
#include "encode/raymap/cost_volume.hpp"
#include "encode/raymap/silhouette_repair.hpp"
#include "encode/set/soft_coverage.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/object/yuv.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace rs::encode {
namespace {

constexpr int kSampleViews = 4;
constexpr double kMostContradicted = 0.01;
constexpr double kHullSpacing_px = 0.5;         // of the working pictures
constexpr int kHullLevels = 128;                // of depth, where silhouettes are asked whether they agree
constexpr std::size_t kKeptCosts = 256U << 20;  // bytes, of all pictures of the set
constexpr int kOverruledMargin_px = 4;
constexpr double kOverruledShares[] = {0.05, 0.1, 0.2, 0.3, 0.4};  // of the silhouettes, where no margin is enough
constexpr int kRepairMargin_px = 4;  // of pictures of half the working size: lost parts are looked for so far away
constexpr double kWidestBetweenRings_deg = 20;
constexpr int kNearSoft_px = 8;  // what is soft is told from what is around it, too

// Seen from the middle of the object, in radians.
double angle_between(const WorkView& a, const WorkView& b) {
    return std::acos(std::clamp(glm::dot(glm::normalize(a.place()), glm::normalize(b.place())), -1.0, 1.0));
}

std::string sector_text(const DepthView& from, const DepthView& to) {
    const auto azimuth_deg = [](const WorkView& view) {
        return static_cast<int>(std::lround(std::fmod(degrees(view.azimuth()) + 360, 360)));
    };
    return std::to_string(azimuth_deg(from.view)) + " and " + std::to_string(azimuth_deg(to.view)) + " degrees";
}

// What of the pictures a search looks for: the object, or what is soft behind and beside it (soft_pixels), which the
// object's silhouettes do not enclose.
enum class Layer { kSolid, kSoft };

// One ring's search for one layer; holds what its steps share.
class RingSearch {
public:
    RingSearch(const CaptureSet& set, const Rig& rig, const ViewRing& ring, const ShapeOptions& options,
               Layer layer = Layer::kSolid)
        : set_(set),
          rig_(rig),
          ring_(ring),
          options_(options),
          layer_(layer),
          views_(ring.views.size()),
          mended_(ring.views.size()),
          soft_(ring.views.size()),
          kept_costs_(ring.views.size()) {}

    // Each picture is passed to `keep`, with its number in the set, from any thread.
    Status read(Progress* progress, const std::function<void(int, const Image<Rgba8>&)>& keep) {
        const int longest = std::max(set_.width, set_.height);
        const int reduction = (longest + options_.working_size_px - 1) / options_.working_size_px;
        return for_each_in_parallel(static_cast<int>(views_.size()), "pictures for depth", progress,
                                    [&](int n) -> Status {
                                        const int v = ring_.views[static_cast<std::size_t>(n)];
                                        const Result<Image<Rgba8>> picture = read_upright_picture(set_, v);
                                        if (!picture) return picture.error();
                                        keep(v, *picture);
                                        const Camera& camera = rig_.views[static_cast<std::size_t>(v)].camera;
                                        WorkView& view = views_[static_cast<std::size_t>(n)].view;
                                        view = make_work_view(camera, *picture, reduction);
                                        Image<std::uint8_t>& soft = soft_[static_cast<std::size_t>(n)];
                                        soft = soft_pixels(view);
                                        if (layer_ == Layer::kSoft) cover_soft(view, soft);
                                        weaken_shading(view);
                                        return {};
                                    });
    }

    // The hull; `rings` are those next below and above, where there are such.
    void choose_hull(const std::vector<const RingSearch*>& rings) {
        find_margin({});
        beside_ = agreeing(rings);
        if (!beside_.empty()) find_margin(beside_);
    }

    // Where silhouettes agree, but some lack a part: points that the object's pictures of half the size show in a wider
    // hull, outside of those silhouettes, are added to them. Before any ring's match().
    Status mend_silhouettes(Progress* progress) {
        if (!silhouettes_agree_ || count() < 3) return {};
        RingSearch half(set_, rig_, ring_, options_);
        for (std::size_t n = 0; n < views_.size(); ++n) half.views_[n].view = halved(views_[n].view);
        const std::vector<const WorkView*> silhouettes = half.work_views({});
        half.sampled_hull_ = half.sampled(VisualHull(silhouettes, std::max(kRepairMargin_px, margin_px_)));
        if (Status status = half.search("depth at half size", progress, false); !status) return status;
        const auto hull = half.sampled(VisualHull(silhouettes, (margin_px_ + 1) / 2));
        std::vector<std::vector<RuledOutPoint>> points(views_.size());
        tbb::parallel_for(0, count(), [&](int n) {
            const Neighbours neighbours = half.neighbours_of(n);
            if (neighbours.beside.size() < 2) return;
            const auto v = static_cast<std::size_t>(n);
            points[v] = ruled_out(half.views_[v], neighbours.beside, half.range_of(n, neighbours).step,
                                  *half.sampled_hull_, *hull);
        });
        tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t n) {
            const Image<std::uint8_t> missing = missing_pixels(half.views_[n].view, points);
            if (std::ranges::all_of(missing.pixels(), [](int pixel) { return pixel == 0; })) return;
            mended_[n] = views_[n].view;
            fill_missing(*mended_[n], missing);
        });
        return {};
    }

    // The depths that the colours say.
    Status match(Progress* progress) {
        sampled_hull_ = sampled(silhouettes_agree_ ? VisualHull(work_views(beside_), margin_px_) : std::move(*hull_));
        hull_.reset();
        return search("depth", progress, true);
    }

    // The same again, now that there are depths that pictures can agree about: every second picture with what the
    // colours say of its neighbours, then the others with what those have found. If all went at once, neighbours would
    // take over one another's faults. A few evenly spread depths are kept for people.
    Status agree(Progress* progress, std::vector<FoundDepth>& samples) {
        const int every = std::max(1, (count() + kSampleViews - 1) / kSampleViews);
        const std::size_t first_sample = samples.size();
        samples.resize(first_sample + static_cast<std::size_t>((count() + every - 1) / every));
        std::vector<Image<float>> agreed(views_.size());
        for (const int first : {0, 1}) {
            const int of_these = (count() + 1 - first) / 2;
            Status status = for_each_in_parallel(of_these, "depth that agrees", progress, [&](int m) -> Status {
                const int n = first + 2 * m;
                const WorkView& view = views_[static_cast<std::size_t>(n)].view;
                const Neighbours neighbours = neighbours_of(n);
                const DepthRange range = range_of(n, neighbours);
                std::optional<CostVolume> kept = std::exchange(kept_costs_[static_cast<std::size_t>(n)], {});
                CostVolume costs = kept ? std::move(*kept) : colour_costs(n, neighbours, range);
                add_inconsistency(costs, view, neighbours, range);
                Image<float>& depth = agreed[static_cast<std::size_t>(n)];
                depth = depths_at(semi_global_levels(view, costs, options_.smoothness), range);
                if (n % every == 0) {
                    samples[first_sample + static_cast<std::size_t>(n / every)] = {
                        ring_.views[static_cast<std::size_t>(n)],
                        first_allowed(view, levels_within(*sampled_hull_, view, range), range), depth};
                }
                return {};
            });
            if (!status) return status;
            for (std::size_t n = static_cast<std::size_t>(first); n < views_.size(); n += 2) {
                views_[n].depth = std::move(agreed[n]);
            }
        }
        for (std::size_t n = 0; n < views_.size(); ++n) keep_layer(views_[n].depth, soft_[n]);
        return {};
    }

    [[nodiscard]] bool shows_soft() const {
        return std::ranges::any_of(soft_, [](const Image<std::uint8_t>& soft) {
            return std::ranges::any_of(soft.pixels(), [](int pixel) { return pixel != 0; });
        });
    }

    [[nodiscard]] SurfaceLayer surfaces() const {
        return {views_, *sampled_hull_, silhouettes_agree_, layer_ == Layer::kSolid};
    }

    [[nodiscard]] ShapeMap lines(const std::vector<SurfaceLayer>& layers, int planes) const {
        ShapeMap shape = make_shape_lines(layers, options_.lines);
        for (const int v : ring_.views) {
            for (int k = 0; k < planes; ++k) {
                const Camera& camera = rig_.views[static_cast<std::size_t>(v)].camera;
                shape.normal_lines.push_back(normal_line(camera, reference_plane(k, planes)));
            }
        }
        return shape;
    }

    void warn(const ShapeMap& shape, std::vector<std::string>& warnings) const {
        std::string missing;
        for (std::size_t n = 0; n < views_.size(); ++n) {
            const DepthView& view = views_[n];
            const std::string& name = rig_.views[static_cast<std::size_t>(ring_.views[n])].file_path;
            if (object_box(view.view).empty()) {
                warnings.push_back(name + " shows no object at all (its alpha is 0 everywhere)");
            }
            if (shape.gaps[n].lines != 0) continue;
            missing += (missing.empty() ? "" : ", ") + sector_text(view, views_[(n + 1) % views_.size()]);
        }
        if (views_.size() == 1) {
            warnings.push_back("there is one picture; it is shown as it is from everywhere");
        } else if (!missing.empty()) {
            warnings.push_back("there are no pictures between " + missing +
                               "; from there the nearest picture is shown as it is");
        }
    }

private:
    [[nodiscard]] int count() const { return static_cast<int>(views_.size()); }

    static Image<float> depths_at(Image<float> levels, const DepthRange& range) {
        for (float& depth : levels.pixels()) depth = static_cast<float>(range.at(static_cast<double>(depth)));
        return levels;
    }

    // What the colours say of each level that the hull allows.
    [[nodiscard]] CostVolume colour_costs(int n, const Neighbours& neighbours, const DepthRange& range) const {
        const WorkView& view = views_[static_cast<std::size_t>(n)].view;
        std::optional<Image<std::uint8_t>> near_soft;
        if (layer_ == Layer::kSoft) near_soft = dilated(soft_[static_cast<std::size_t>(n)], kNearSoft_px);
        CostVolume costs = levels_within(*sampled_hull_, view, range, near_soft ? &*near_soft : nullptr);
        match_colours(costs, view, neighbours, range);
        return costs;
    }

    void keep_layer(Image<float>& depth, const Image<std::uint8_t>& soft) const {
        std::ranges::transform(depth.pixels(), soft.pixels(), depth.pixels().begin(), [&](float value, int pixel) {
            return (pixel != 0) == (layer_ == Layer::kSoft) ? value : kNoDepth;
        });
    }

    // Of this ring and the others.
    [[nodiscard]] std::vector<const WorkView*> work_views(const std::vector<const RingSearch*>& others) const {
        std::vector<const WorkView*> all;
        const auto add = [&](const RingSearch& ring) {
            for (std::size_t n = 0; n < ring.views_.size(); ++n) {
                all.push_back(ring.mended_[n] ? &*ring.mended_[n] : &ring.views_[n].view);
            }
        };
        add(*this);
        for (const RingSearch* const ring : others) add(*ring);
        return all;
    }

    [[nodiscard]] std::unique_ptr<SampledHull> sampled(VisualHull hull) const {
        const double px = glm::length(views_.front().view.centre) / views_.front().view.fl_x;  // object radii
        return std::make_unique<SampledHull>(std::move(hull), kHullSpacing_px * px);
    }

    Status search(const char* label, Progress* progress, bool keep_costs) {
        return for_each_in_parallel(count(), label, progress, [&](int n) -> Status {
            DepthView& view = views_[static_cast<std::size_t>(n)];
            const Neighbours neighbours = neighbours_of(n);
            const DepthRange range = range_of(n, neighbours);
            CostVolume costs = colour_costs(n, neighbours, range);
            view.depth = depths_at(semi_global_levels(view.view, costs, options_.smoothness), range);
            if (keep_costs && costs.costs.size() <= kKeptCosts / rig_.views.size()) {
                kept_costs_[static_cast<std::size_t>(n)] = std::move(costs);
            }
            return {};
        });
    }

    [[nodiscard]] bool silhouettes_agree(const std::vector<const WorkView*>& views, const VisualHull& hull) const {
        return contradicted_share(views, hull, range_of(kHullLevels)) <= kMostContradicted;
    }

    // The narrowest margin at which the silhouettes agree. Where none does, since cameras do not stand where the rig
    // has them or cut-outs lack parts, the fewest silhouettes that must be overruled to leave the object whole: a hull
    // that cuts into it puts surfaces where no picture sees them.
    void find_margin(const std::vector<const RingSearch*>& beside) {
        const std::vector<const WorkView*> all = work_views(beside);
        overruled_share_ = 0;
        for (margin_px_ = 1; margin_px_ <= options_.widest_hull_margin_px; margin_px_ *= 2) {
            hull_ = std::make_unique<VisualHull>(all, margin_px_);
            silhouettes_agree_ = silhouettes_agree(all, *hull_);
            if (silhouettes_agree_) return;
        }
        margin_px_ = kOverruledMargin_px;
        for (const double share : kOverruledShares) {
            overruled_share_ = share;
            hull_ = std::make_unique<VisualHull>(all, margin_px_, overruled(all));
            if (silhouettes_agree(all, *hull_)) return;
        }
    }

    [[nodiscard]] int overruled(const std::vector<const WorkView*>& views) const {
        return static_cast<int>(overruled_share_ * static_cast<double>(views.size()));
    }

    // The rings whose silhouettes this one's, with the margin that these need among themselves, do not contradict:
    // rings may be calibrated each for itself only.
    [[nodiscard]] std::vector<const RingSearch*> agreeing(const std::vector<const RingSearch*>& rings) const {
        std::vector<const RingSearch*> found;
        for (const RingSearch* const ring : rings) {
            const std::vector<const WorkView*> both = work_views({ring});
            if (silhouettes_agree(both, VisualHull(both, margin_px_, overruled(both)))) found.push_back(ring);
        }
        return found;
    }

    [[nodiscard]] double gap_deg(int n) const { return degrees(gap_width(views_, static_cast<std::size_t>(n))); }

    // The pictures to either side and the nearest one of each ring beside this one, unless they are too far away to
    // compare.
    [[nodiscard]] Neighbours neighbours_of(int n) const {
        const int before = (n + count() - 1) % count();
        const int after = (n + 1) % count();
        Neighbours found;
        if (before != n && gap_deg(before) <= options_.lines.widest_gap_deg) {
            found.beside.push_back(&views_[static_cast<std::size_t>(before)]);
        }
        if (after != n && after != before && gap_deg(n) <= options_.lines.widest_gap_deg) {
            found.beside.push_back(&views_[static_cast<std::size_t>(after)]);
        }
        const WorkView& view = views_[static_cast<std::size_t>(n)].view;
        const auto angle_to = [&](const DepthView& other) { return angle_between(view, other.view); };
        for (const RingSearch* const ring : beside_) {
            const auto nearest =
                std::min_element(ring->views_.begin(), ring->views_.end(),
                                 [&](const DepthView& a, const DepthView& b) { return angle_to(a) < angle_to(b); });
            if (angle_to(*nearest) < radians(kWidestBetweenRings_deg)) found.across.push_back(&*nearest);
        }
        return found;
    }

    static DepthRange range_of(int levels) { return {-kDeepest, 2 * kDeepest / (levels - 1), levels}; }

    [[nodiscard]] DepthRange range_of(int n, const Neighbours& neighbours) const {
        const WorkView& view = views_[static_cast<std::size_t>(n)].view;
        double most_moved = 0;  // by a change of depth of one, in object radii
        for (const auto* const kind : {&neighbours.beside, &neighbours.across}) {
            for (const DepthView* const neighbour : *kind) {
                most_moved = std::max(most_moved, std::sin(angle_between(view, neighbour->view)));
            }
        }
        const double levels = 2 * kDeepest * most_moved * view.fl_x / glm::length(view.place()) / options_.level_px;
        return range_of(std::clamp(static_cast<int>(levels), options_.fewest_levels, options_.most_levels));
    }

    const CaptureSet& set_;
    const Rig& rig_;
    const ViewRing& ring_;
    const ShapeOptions& options_;
    Layer layer_;
    std::vector<DepthView> views_;
    std::vector<std::optional<WorkView>> mended_;        // silhouettes that lacked something
    std::vector<Image<std::uint8_t>> soft_;              // of each view
    std::vector<std::optional<CostVolume>> kept_costs_;  // of each view, from match() to agree()
    std::vector<const RingSearch*> beside_;
    std::unique_ptr<VisualHull> hull_;
    std::unique_ptr<SampledHull> sampled_hull_;  // kHullSpacing_px apart
    int margin_px_ = 1;
    double overruled_share_ = 0;
    bool silhouettes_agree_ = true;
};

}  // namespace

Result<FoundShapes> add_shape_maps(const CaptureSet& set, const Rig& rig, const std::vector<ViewRing>& rings,
                                   const ShapeOptions& options, bool keep_pictures, RaySpaceObject& object,
                                   Progress* progress) {
    FoundShapes found;
    const auto keep = [&](int v, const Image<Rgba8>& picture) {
        if (keep_pictures) object.pictures[static_cast<std::size_t>(v)] = planar_from_rgba(picture);
    };
    std::vector<RingSearch> searches;
    searches.reserve(rings.size());
    for (const ViewRing& ring : rings) {
        searches.emplace_back(set, rig, ring, options);
        if (const Status status = searches.back().read(progress, keep); !status) return status.error();
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
        std::vector<const RingSearch*> beside;
        if (r > 0) beside.push_back(&searches[r - 1]);
        if (r + 1 < rings.size()) beside.push_back(&searches[r + 1]);
        searches[r].choose_hull(beside);
    }
    for (const auto step : {&RingSearch::mend_silhouettes, &RingSearch::match}) {
        for (RingSearch& search : searches) {
            if (const Status status = (search.*step)(progress); !status) return status.error();
        }
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
        if (const Status status = searches[r].agree(progress, found.samples); !status) return status.error();
        Ring& ring = object.rings[r];
        std::vector<SurfaceLayer> layers = {searches[r].surfaces()};
        RingSearch soft(set, rig, rings[r], options, Layer::kSoft);
        if (searches[r].shows_soft()) {
            std::vector<FoundDepth> unused;
            if (const Status status = soft.read(progress, [](int, const Image<Rgba8>&) {}); !status)
                return status.error();
            soft.choose_hull({});
            if (const Status status = soft.match(progress); !status) return status.error();
            if (const Status status = soft.agree(progress, unused); !status) return status.error();
            layers.push_back(soft.surfaces());
        }
        ring.shape = searches[r].lines(layers, ring.planes);
        searches[r].warn(ring.shape, found.warnings);
    }
    return found;
}

}  // namespace rs::encode
