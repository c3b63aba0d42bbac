#include "encode/raymap/ring_depth_estimator.hpp"

#include "encode/raymap/captured_view.hpp"
#include "encode/raymap/silhouettes/lost_parts.hpp"
#include "encode/raymap/visibility.hpp"
#include "encode/set/soft_coverage.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/geometry/ray_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::encode {
namespace {

constexpr int kSampleViews = 4;
constexpr double kMaxContradicted = 0.01;   // share of the object, at which silhouettes agree
constexpr double kExactSilhouettes = 1e-4;  // share at which they are exact: traced 1e-5, segmented 5e-4 and more
constexpr double kHullSpacing_px = 0.5;     // of the working views
constexpr double kRepairSpacing_px = 1;     // of the half-sized views
constexpr int kHullLevels = 128;            // of depth, where silhouettes are tested for agreement
constexpr std::size_t kMaxKeptCosts = 256U << 20;  // bytes, for all photos of the set
constexpr int kTolerantMargin_px = 4;
constexpr double kToleratedShares[] = {0.05, 0.1, 0.2, 0.3, 0.4};  // of the silhouettes, where no margin is enough
constexpr int kRepairMargin_px = 4;       // of the half-sized views: how far from a silhouette missing rims are found
constexpr int kMaxRepairMargin_px = 4;    // widest margin of a hull whose silhouettes are repaired
constexpr double kRepairTolerated = 0.1;  // share of the silhouettes, where large missing parts are searched
constexpr double kLargePart = 0.1;        // area of a missing part relative to the object
constexpr double kMaxLackingShare = 0.2;  // of the photos; where more lack a large part, the rig is wrong
constexpr double kMaxRingDistance_deg = 20;
constexpr int kNearSoft_px = 8;  // soft surfaces are estimated together with their surroundings

// The angle between two cameras seen from the origin, radians.
double angle_between(const WorkView& a, const WorkView& b) {
    return std::acos(std::clamp(glm::dot(glm::normalize(a.place()), glm::normalize(b.place())), -1.0, 1.0));
}

std::string sector_text(const DepthView& from, const DepthView& to) {
    const auto azimuth_deg = [](const WorkView& view) {
        return static_cast<int>(std::lround(std::fmod(degrees(view.azimuth()) + 360, 360)));
    };
    return std::to_string(azimuth_deg(from.view)) + " and " + std::to_string(azimuth_deg(to.view)) + " degrees";
}

DepthRange range_of(int levels) {
    return {-kMaxDepth, 2 * kMaxDepth / (levels - 1), levels};
}

Image<float> depths_at(Image<float> levels, const DepthRange& range) {
    for (float& depth : levels.pixels()) depth = static_cast<float>(range.at(static_cast<double>(depth)));
    return levels;
}

// Converts axial depths in the rig's units at full size to distances from the foot of each working pixel's ray: the
// nearest depth of the pixel's block.
Image<float> known_depths(const WorkView& view, const Image<float>& axial, int reduction, double object_radius) {
    Image<float> depths(view.height, view.width, kNoDepth);
    for (int column = 0; column < view.width; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        for (int row = 0; row < view.height; ++row) {
            float nearest = 0;
            for (int i = 0; i < reduction * reduction; ++i) {
                const float depth = axial(column * reduction + i % reduction, row * reduction + i / reduction);
                if (depth > 0 && (nearest == 0 || depth < nearest)) nearest = depth;
            }
            if (nearest == 0 || view.at(column, row).a < kInside) continue;
            depths(row, column) = static_cast<float>(
                static_cast<double>(nearest) / object_radius * ray.horizontal_per_axial - ray.to_foot);
        }
    }
    return depths;
}

double contradicted_by(const VisualHull& hull, const std::vector<const WorkView*>& views) {
    return inconsistent_share(views, hull, range_of(kHullLevels));
}

bool agree_with(const std::vector<const WorkView*>& views, const VisualHull& hull) {
    return contradicted_by(hull, views) <= kMaxContradicted;
}

}  // namespace

RingDepthEstimator::RingDepthEstimator(const CaptureSet& set, const Rig& rig, const ViewRing& ring,
                                       const ShapeOptions& options, Layer layer)
    : set_(set),
      rig_(rig),
      ring_(ring),
      options_(options),
      layer_(layer),
      views_(ring.views.size()),
      texture_(ring.views.size()),
      repaired_(ring.views.size()),
      soft_(ring.views.size()),
      kept_costs_(ring.views.size()) {
    const int longest = std::max(set.width, set.height);
    reduction_ = (longest + options.working_size_px - 1) / options.working_size_px;
}

void RingDepthEstimator::set_photo(std::size_t n, const Image<Rgba8>& image) {
    const Camera& camera = rig_.views[static_cast<std::size_t>(ring_.views[n])].camera;
    WorkView& view = views_[n].view;
    view = make_work_view(camera, image, reduction_);
    soft_[n] = soft_pixels(view);
    if (layer_ == Layer::kSoft) make_soft_opaque(view, soft_[n]);
    attenuate_shading(view);
    texture_[n] = measure_texture(view);
}

Status RingDepthEstimator::read_photos(Progress* progress, const PhotoSink& sink) {
    return for_each_in_parallel(count(), "photos for depth", progress, [&](int n) -> Status {
        const int v = ring_.views[static_cast<std::size_t>(n)];
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, read_upright_image(set_, v));
        sink(v, image);
        set_photo(static_cast<std::size_t>(n), image);
        return {};
    });
}

void RingDepthEstimator::choose_hull(const std::vector<const RingDepthEstimator*>& rings) {
    choose_margin({});
    adjacent_ = consistent_rings(rings);
    if (!adjacent_.empty()) choose_margin(adjacent_);
}

Status RingDepthEstimator::complete_masks(Progress* progress, const PhotoSink& sink) {
    // Places in a part that a mask lacks are ruled out in all other photos, too.
    const bool exact = margin_px_ == 1 && contradicted_ <= kExactSilhouettes;
    if (count() < 3 || exact) return {};
    RingDepthEstimator half(set_, rig_, ring_, options_);
    half.reduction_ = 2 * reduction_;
    for (std::size_t n = 0; n < views_.size(); ++n) half.views_[n].view = halve(views_[n].view);
    RS_ASSIGN_OR_RETURN(std::vector<Image<float>> missing, half.find_missing(*this, progress));
    missing_ = std::move(missing);

    std::vector<Image<float>> parts(views_.size());
    for_each_index(views_.size(),
                   [&](std::size_t n) { parts[n] = select_lost_part(half.views_[n].view, missing_[n]); });
    std::vector<std::size_t> lacking;
    for (std::size_t n = 0; n < views_.size(); ++n) {
        if (share_of(parts[n], half.views_[n].view) >= kLargePart) lacking.push_back(n);
    }
    if (static_cast<double>(lacking.size()) > kMaxLackingShare * static_cast<double>(views_.size())) return {};
    for (const std::size_t n : lacking) {
        RS_ASSIGN_OR_RETURN(const std::optional<Image<Rgba8>> image, paint_part(n, half, parts[n]));
        if (!image) continue;
        sink(ring_.views[n], *image);
        set_photo(n, *image);
    }
    return {};
}

void RingDepthEstimator::repair_silhouettes() {
    if (!silhouettes_agree_ || margin_px_ > kMaxRepairMargin_px) return;
    for (std::size_t n = 0; n < missing_.size(); ++n) {
        if (count_depths(missing_[n]) == 0) continue;
        repaired_[n] = views_[n].view;
        fill_missing(*repaired_[n], missing_[n]);
    }
}

Result<std::vector<Image<float>>> RingDepthEstimator::find_missing(const RingDepthEstimator& whole,
                                                                   Progress* progress) {
    const std::vector<const WorkView*> masks = silhouettes({});
    const auto tolerated = static_cast<int>(kRepairTolerated * static_cast<double>(masks.size()));
    const int narrow_px = (std::min(whole.margin_px_, kMaxRepairMargin_px) + 1) / 2;
    const int searched_px = whole.silhouettes_agree_ ? std::max(kRepairMargin_px, whole.margin_px_) : narrow_px;
    sampled_hull_ = sampled(VisualHull(masks, searched_px, tolerated), kRepairSpacing_px);
    RS_TRY(estimate_depths("depth at half size", progress, false));
    const auto hull = sampled(VisualHull(masks, narrow_px), kHullSpacing_px);
    std::vector<std::vector<RuledOutPoint>> points(views_.size());
    for_each_index(count(), [&](int n) {
        const Neighbours neighbours = neighbours_of(n);
        if (neighbours.beside.size() < 2) return;
        const auto v = static_cast<std::size_t>(n);
        points[v] = find_ruled_out(views_[v], neighbours.beside, range_of(n, neighbours).step, *sampled_hull_, *hull);
    });
    std::vector<Image<float>> missing(views_.size());
    for_each_index(views_.size(), [&](std::size_t n) { missing[n] = missing_depths(views_[n].view, points); });
    return missing;
}

// Paints from the nearest photos; of two as near, first from the one that shows more of the part.
Result<std::optional<Image<Rgba8>>> RingDepthEstimator::paint_part(std::size_t n, const RingDepthEstimator& half,
                                                                   const Image<float>& part) const {
    constexpr int kFarthestPainter = 3;  // photos away
    RS_ASSIGN_OR_RETURN(Image<Rgba8> image, read_upright_image(set_, ring_.views[n]));
    LostPartPainter painter(half.views_[n].view, part, half.reduction_, std::move(image));
    for (int away = 1; away <= std::min(kFarthestPainter, count() / 2) && !painter.done(); ++away) {
        std::vector<Image<Rgba8>> images;
        images.reserve(2);
        std::vector<LostPartPainter::Painter> painters;
        for (const int sense : {-away, away}) {
            const auto from = static_cast<std::size_t>((static_cast<int>(n) + sense + count()) % count());
            if (degrees(angle_between(views_[n].view, views_[from].view)) > options_.lines.max_gap_deg) continue;
            RS_ASSIGN_OR_RETURN(Image<Rgba8> other, read_upright_image(set_, ring_.views[from]));
            images.push_back(std::move(other));
            painters.push_back({&half.views_[from], &images.back()});
        }
        if (painters.size() == 2 && painter.shown_by(painters[0]) < painter.shown_by(painters[1])) {
            std::swap(painters[0], painters[1]);
        }
        for (const LostPartPainter::Painter& from : painters) painter.paint_from(from);
    }
    if (!painter.half_done()) return std::optional<Image<Rgba8>>();
    return std::optional(std::move(painter).image());
}

void RingDepthEstimator::sample_hull() {
    sampled_hull_ = sampled(silhouettes_agree_ ? VisualHull(silhouettes(adjacent_), margin_px_) : std::move(*hull_),
                            kHullSpacing_px);
    hull_.reset();
}

Status RingDepthEstimator::match_colors(Progress* progress) {
    sample_hull();
    return estimate_depths("depth", progress, true);
}

Status RingDepthEstimator::enforce_consistency(Progress* progress, std::vector<DepthPreview>& samples) {
    const int every = std::max(1, (count() + kSampleViews - 1) / kSampleViews);
    const std::size_t first_sample = samples.size();
    samples.resize(first_sample + static_cast<std::size_t>((count() + every - 1) / every));
    std::vector<Image<float>> agreed(views_.size());
    for (const int first : {0, 1}) {
        const int of_these = (count() + 1 - first) / 2;
        Status status = for_each_in_parallel(of_these, "consistent depth", progress, [&](int m) -> Status {
            const int n = first + 2 * m;
            const WorkView& view = views_[static_cast<std::size_t>(n)].view;
            const Neighbours neighbours = neighbours_of(n);
            const DepthRange range = range_of(n, neighbours);
            std::optional<CostVolume> kept = std::exchange(kept_costs_[static_cast<std::size_t>(n)], {});
            CostVolume costs = kept ? std::move(*kept) : color_costs(n, neighbours, range);
            add_inconsistency(costs, view, neighbours, range);
            Image<float>& depth = agreed[static_cast<std::size_t>(n)];
            depth = depths_at(semi_global_levels(view, costs, options_.smoothness), range);
            if (n % every == 0) {
                samples[first_sample + static_cast<std::size_t>(n / every)] = {
                    ring_.views[static_cast<std::size_t>(n)],
                    first_allowed_depth(view, create_volume(*sampled_hull_, view, range), range), depth};
            }
            return {};
        });
        if (!status) return status;
        for (std::size_t n = static_cast<std::size_t>(first); n < views_.size(); n += 2) {
            views_[n].depth = std::move(agreed[n]);
        }
    }
    for (std::size_t n = 0; n < views_.size(); ++n) mask_layer(views_[n].depth, soft_[n]);
    for_each_index(views_.size(), [&](std::size_t n) {
        views_[n].occluders = find_occluders(views_[n], texture_[n], neighbours_of(static_cast<int>(n)).beside);
    });
    return {};
}

void RingDepthEstimator::use_known_depths() {
    for_each_index(views_.size(), [&](std::size_t n) {
        DepthView& view = views_[n];
        const PackedView& known = *set_.synthesized[static_cast<std::size_t>(ring_.views[n])];
        view.depth = known_depths(view.view, known.depth(), reduction_, set_.upright.object_radius);
        view.occluders = Image<std::uint8_t>(view.depth.width(), view.depth.height(), 1);
    });
}

bool RingDepthEstimator::has_soft_pixels() const {
    return std::ranges::any_of(soft_, [](const Image<std::uint8_t>& soft) {
        return std::ranges::any_of(soft.pixels(), [](int pixel) { return pixel != 0; });
    });
}

ShapeMap RingDepthEstimator::make_shape(const std::vector<SurfaceLayer>& layers, int planes) const {
    ShapeMap shape = make_shape_lines(layers, options_.lines);
    for (const int v : ring_.views) {
        for (int k = 0; k < planes; ++k) {
            const Camera& camera = rig_.views[static_cast<std::size_t>(v)].camera;
            shape.normal_lines.push_back(normal_line(camera, reference_plane(k, planes)));
        }
    }
    return shape;
}

void RingDepthEstimator::append_warnings(const ShapeMap& shape, std::vector<std::string>& warnings) const {
    std::string missing;
    for (std::size_t n = 0; n < views_.size(); ++n) {
        const DepthView& view = views_[n];
        const std::string& name = rig_.views[static_cast<std::size_t>(ring_.views[n])].file_path;
        if (object_box(view.view).empty()) {
            warnings.push_back(name + " shows no object (its alpha is 0 everywhere)");
        }
        if (shape.gaps[n].lines != 0) continue;
        missing += (missing.empty() ? "" : ", ") + sector_text(view, views_[(n + 1) % views_.size()]);
    }
    if (views_.size() == 1) {
        warnings.push_back("there is only one image; it is shown unchanged from all directions");
    } else if (!missing.empty()) {
        warnings.push_back("there are no images between " + missing +
                           "; the nearest image is shown unchanged from there");
    }
}

CostVolume RingDepthEstimator::color_costs(int n, const Neighbours& neighbours, const DepthRange& range) const {
    const WorkView& view = views_[static_cast<std::size_t>(n)].view;
    std::optional<Image<std::uint8_t>> near_soft;
    if (layer_ == Layer::kSoft) near_soft = dilated(soft_[static_cast<std::size_t>(n)], kNearSoft_px);
    CostVolume costs = create_volume(*sampled_hull_, view, range, near_soft ? &*near_soft : nullptr);
    match_colours(costs, view, neighbours, range);
    return costs;
}

void RingDepthEstimator::mask_layer(Image<float>& depth, const Image<std::uint8_t>& soft) const {
    std::ranges::transform(depth.pixels(), soft.pixels(), depth.pixels().begin(), [&](float value, int pixel) {
        return (pixel != 0) == (layer_ == Layer::kSoft) ? value : kNoDepth;
    });
}

std::vector<const WorkView*> RingDepthEstimator::silhouettes(
    const std::vector<const RingDepthEstimator*>& others) const {
    std::vector<const WorkView*> all;
    const auto add = [&](const RingDepthEstimator& ring) {
        for (std::size_t n = 0; n < ring.views_.size(); ++n) {
            all.push_back(ring.repaired_[n] ? &*ring.repaired_[n] : &ring.views_[n].view);
        }
    };
    add(*this);
    for (const RingDepthEstimator* const ring : others) add(*ring);
    return all;
}

std::unique_ptr<SampledHull> RingDepthEstimator::sampled(VisualHull hull, double spacing_px) const {
    const double px = glm::length(views_.front().view.centre) / views_.front().view.fl_x;  // object radii
    return std::make_unique<SampledHull>(std::move(hull), spacing_px * px);
}

Status RingDepthEstimator::estimate_depths(const char* label, Progress* progress, bool keep_costs) {
    return for_each_in_parallel(count(), label, progress, [&](int n) -> Status {
        DepthView& view = views_[static_cast<std::size_t>(n)];
        const Neighbours neighbours = neighbours_of(n);
        const DepthRange range = range_of(n, neighbours);
        CostVolume costs = color_costs(n, neighbours, range);
        view.depth = depths_at(semi_global_levels(view.view, costs, options_.smoothness), range);
        if (keep_costs && costs.costs.size() <= kMaxKeptCosts / rig_.views.size()) {
            kept_costs_[static_cast<std::size_t>(n)] = std::move(costs);
        }
        return {};
    });
}

// Chooses the narrowest margin at which the silhouettes agree. Where none does, because the rig is inaccurate or masks
// lack parts, chooses the smallest share of silhouettes that must be tolerated to leave the object whole: a hull that
// cuts into the object puts surfaces where no photo sees them.
void RingDepthEstimator::choose_margin(const std::vector<const RingDepthEstimator*>& beside) {
    const std::vector<const WorkView*> all = silhouettes(beside);
    tolerated_share_ = 0;
    for (margin_px_ = 1; margin_px_ <= options_.max_hull_margin_px; margin_px_ *= 2) {
        hull_ = std::make_unique<VisualHull>(all, margin_px_);
        contradicted_ = contradicted_by(*hull_, all);
        silhouettes_agree_ = contradicted_ <= kMaxContradicted;
        if (silhouettes_agree_) return;
    }
    margin_px_ = kTolerantMargin_px;
    for (const double share : kToleratedShares) {
        tolerated_share_ = share;
        hull_ = std::make_unique<VisualHull>(all, margin_px_, tolerated(all));
        if (agree_with(all, *hull_)) return;
    }
}

// The rings whose silhouettes agree with this one's at this ring's margin. Others may have been calibrated separately.
std::vector<const RingDepthEstimator*> RingDepthEstimator::consistent_rings(
    const std::vector<const RingDepthEstimator*>& rings) const {
    std::vector<const RingDepthEstimator*> found;
    for (const RingDepthEstimator* const ring : rings) {
        const std::vector<const WorkView*> both = silhouettes({ring});
        if (agree_with(both, VisualHull(both, margin_px_, tolerated(both)))) found.push_back(ring);
    }
    return found;
}

double RingDepthEstimator::gap_deg(int n) const {
    return degrees(gap_width(views_, static_cast<std::size_t>(n)));
}

// The photos on either side and the nearest photo of each adjacent ring, unless they are too far away to compare.
Neighbours RingDepthEstimator::neighbours_of(int n) const {
    const int before = (n + count() - 1) % count();
    const int after = (n + 1) % count();
    Neighbours found;
    if (before != n && gap_deg(before) <= options_.lines.max_gap_deg) {
        found.beside.push_back(&views_[static_cast<std::size_t>(before)]);
    }
    if (after != n && after != before && gap_deg(n) <= options_.lines.max_gap_deg) {
        found.beside.push_back(&views_[static_cast<std::size_t>(after)]);
    }
    const WorkView& view = views_[static_cast<std::size_t>(n)].view;
    const auto angle_to = [&](const DepthView& other) { return angle_between(view, other.view); };
    for (const RingDepthEstimator* const ring : adjacent_) {
        const auto nearest =
            std::min_element(ring->views_.begin(), ring->views_.end(),
                             [&](const DepthView& a, const DepthView& b) { return angle_to(a) < angle_to(b); });
        if (angle_to(*nearest) < radians(kMaxRingDistance_deg)) found.across.push_back(&*nearest);
    }
    return found;
}

DepthRange RingDepthEstimator::range_of(int n, const Neighbours& neighbours) const {
    const WorkView& view = views_[static_cast<std::size_t>(n)].view;
    double most_moved = 0;  // object radii across the neighbour's line of sight per object radius of depth
    for (const auto* const kind : {&neighbours.beside, &neighbours.across}) {
        for (const DepthView* const neighbour : *kind) {
            most_moved = std::max(most_moved, std::sin(angle_between(view, neighbour->view)));
        }
    }
    const double levels = 2 * kMaxDepth * most_moved * view.fl_x / glm::length(view.place()) / options_.level_px;
    return rs::encode::range_of(std::clamp(static_cast<int>(levels), options_.min_levels, options_.max_levels));
}

}  // namespace rs::encode
