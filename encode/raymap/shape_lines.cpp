#include "encode/raymap/shape_lines.hpp"

#include "encode/raymap/captured_view.hpp"
#include "encode/raymap/line_grid.hpp"
#include "encode/raymap/semi_global.hpp"
#include "encode/raymap/visibility.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/format/content_coding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace rs::encode {
namespace {

// Depth buffer of one photo's surface points, splatted from a line's viewpoint onto the fine raster.
class LineRaster {
public:
    explicit LineRaster(const LineGrid& grid)
        : grid_(grid), depth_(grid.bands * grid.fine, grid.p_cells * grid.fine, kEmpty) {}

    void splat(const DepthView& source, const glm::dvec2& viewpoint) {
        std::fill(depth_.pixels().begin(), depth_.pixels().end(), kEmpty);
        for (int column = 0; column < source.view.width; ++column) {
            const HorizontalRay ray = source.view.ray_of(column + 0.5);
            for (int row = 0; row < source.view.height; ++row) {
                const float depth = source.depth(row, column);
                if (std::isnan(depth)) continue;
                const double y = source.view.height_of(row + 0.5, ray.axial_at(static_cast<double>(depth)));
                put(project_to_line(grid_, viewpoint, ray.place_at(static_cast<double>(depth)), y));
            }
        }
    }
    // Appends the depths within a cell to `found`.
    void append_depths(int p, int h, std::vector<float>& found) const {
        for (int x = p * grid_.fine; x < (p + 1) * grid_.fine; ++x) {
            const float* const depths = &depth_(h * grid_.fine, x);
            for (int y = 0; y < grid_.fine; ++y) {
                if (depths[y] < kEmpty) found.push_back(depths[y]);
            }
        }
    }

private:
    static constexpr float kEmpty = std::numeric_limits<float>::infinity();

    void put(const LinePoint& point) {
        const auto p = static_cast<int>(std::floor((point.p - grid_.p_low) * grid_.cells_per_unit * grid_.fine - 0.5));
        const auto h = static_cast<int>(std::floor((point.h - grid_.h_low) * grid_.bands_per_unit * grid_.fine - 0.5));
        const auto depth = static_cast<float>(point.depth);
        for (int x = std::max(p, 0); x <= std::min(p + 1, depth_.height() - 1); ++x) {
            for (int y = std::max(h, 0); y <= std::min(h + 1, depth_.width() - 1); ++y) {
                depth_(y, x) = std::min(depth_(y, x), depth);
            }
        }
    }

    const LineGrid& grid_;
    Image<float> depth_;  // (h, p)
};

// A cell with one surface, at the median of the depths; an empty cell where there are none. Reorders `found`.
ShapeCell make_cell(std::vector<float>& found) {
    ShapeCell cell;
    if (found.empty()) return cell;
    const auto depth = static_cast<double>(median_of(std::span<float>(found)));
    cell.depth = static_cast<std::uint8_t>(std::clamp(std::lround((depth + kHalfWidth) / kDepthStep), 0L, 255L));
    cell.shown = ShapeCell::kByBoth;
    return cell;
}

// Tests which cells of a column are inside the hull at which depth. Each depth is computed on first use, since the
// surfaces of a column have few.
class HullColumns {
public:
    HullColumns(const LineGrid& grid, const SampledHull& hull)
        : grid_(grid), hull_(hull), inside_(static_cast<std::size_t>(grid.bands * kDepths)) {}

    // Starts the column of this ray, which must outlive its use.
    void begin(const CellRay& ray) {
        ray_ = &ray;
        known_.fill(false);
        // Heights are scattered in memory: all are prefetched before the first is read.
        for (int d = 0; d < kDepths; ++d) {
            const std::span<const Interval> heights = hull_.heights_above(ray.place(d));
            heights_[static_cast<std::size_t>(d)] = heights;
            __builtin_prefetch(heights.data());
        }
    }
    [[nodiscard]] bool contains(int h, int d) {
        std::uint8_t* const bands = inside_.data() + d * grid_.bands;
        if (!known_[static_cast<std::size_t>(d)]) fill(d, bands);
        return bands[h] != 0;
    }

private:
    void fill(int d, std::uint8_t* bands) {
        known_[static_cast<std::size_t>(d)] = true;
        std::fill(bands, bands + grid_.bands, std::uint8_t{0});
        for (const Interval& i : heights_[static_cast<std::size_t>(d)]) {
            const int first = std::max(static_cast<int>(std::ceil(ray_->bands_at(i.low, d) - 0.5)), 0);
            const int last = std::min(static_cast<int>(std::floor(ray_->bands_at(i.high, d) - 0.5)), grid_.bands - 1);
            if (first <= last) std::fill(bands + first, bands + last + 1, std::uint8_t{1});
        }
    }

    const LineGrid& grid_;
    const SampledHull& hull_;
    const CellRay* ray_ = nullptr;
    std::array<std::span<const Interval>, kDepths> heights_;
    std::array<bool, kDepths> known_{};
    std::vector<std::uint8_t> inside_;  // [d * bands + h]
};

// Moves surfaces outside of the hull to the nearest depth inside, along the line's ray. Sets meets_hull[h] to 1 for
// each surface whose ray meets the hull at all; surfaces whose ray misses it stay where they are.
void clamp_to_hull(const LineGrid& grid, const CellRay& ray, HullColumns& hull, ShapeCell* cells,
                   std::uint8_t* meets_hull) {
    if (std::all_of(cells, cells + grid.bands, [](const ShapeCell& cell) { return !cell.has_surface(); })) return;
    hull.begin(ray);
    for (int h = 0; h < grid.bands; ++h) {
        ShapeCell& cell = cells[h];
        if (!cell.has_surface()) continue;
        const std::optional<std::uint8_t> depth = nearest_depth(cell.depth, [&](int d) { return hull.contains(h, d); });
        meets_hull[h] = depth ? 1 : 0;
        cell.depth = depth.value_or(cell.depth);
    }
}

// Computes the cells of one line from the depth maps of the photos on either side of it.
class LineSurfaces {
public:
    explicit LineSurfaces(const LineGrid& grid)
        : grid_(grid),
          from_first_(grid),
          from_second_(grid),
          cells_(static_cast<std::size_t>(grid.p_cells) * static_cast<std::size_t>(grid.bands)) {}

    // The cells of one layer, [p * bands + h]; valid until the next call.
    const std::vector<ShapeCell>& compute(const SurfaceLayer& layer, const ViewPair& photos, double floating_share) {
        from_first_.splat(photos.first, photos.viewpoint);
        from_second_.splat(photos.second, photos.viewpoint);
        for (int p = 0; p < grid_.p_cells; ++p) {
            for (int h = 0; h < grid_.bands; ++h) {
                find_depths(p, h);
                cells_[static_cast<std::size_t>(p * grid_.bands + h)] = make_cell(found_);
            }
        }
        if (layer.hull != nullptr) {
            move_into_hull(layer, photos.viewpoint);
            if (layer.in_front) remove_small_components(grid_, floating_share, cells_.data());
        }
        for (int p = 0; p < grid_.p_cells; ++p) {
            ShapeCell* const column = cells_.data() + p * grid_.bands;
            if (!layer.in_front) avoid_foreground(grid_, photos, p, column);
            // Depths found within silhouettes that contradict one another are not reliable.
            if (layer.silhouettes_agree) classify_visibility(grid_, photos, p, column);
        }
        return cells_;
    }

private:
    void move_into_hull(const SurfaceLayer& layer, const glm::dvec2& viewpoint) {
        std::vector<std::uint8_t> meets_hull(cells_.size(), 0);
        HullColumns hull(grid_, *layer.hull);
        for (int p = 0; p < grid_.p_cells; ++p) {
            const auto column = static_cast<std::size_t>(p * grid_.bands);
            clamp_to_hull(grid_, CellRay(grid_, viewpoint, p), hull, cells_.data() + column,
                          meets_hull.data() + column);
        }
        if (layer.silhouettes_agree) remove_cells_outside_hull(grid_, meets_hull, cells_.data());
    }
    // The depths that the photos have within a cell.
    void find_depths(int p, int h) {
        found_.clear();
        from_first_.append_depths(p, h, found_);
        from_second_.append_depths(p, h, found_);
    }

    const LineGrid& grid_;
    LineRaster from_first_, from_second_;
    std::vector<float> found_;
    std::vector<ShapeCell> cells_;
};

struct HeightRange {
    double low = 1e30, high = -1e30;
};

// The heights of all surface points at the reference distance, projected from the reference viewpoint.
HeightRange height_range(const std::vector<SurfaceLayer>& layers, double distance, double height) {
    HeightRange range;
    std::vector<const DepthView*> sources;
    for (const SurfaceLayer& layer : layers) {
        for (const DepthView& source : layer.ring) sources.push_back(&source);
    }
    for (const DepthView* const each : sources) {
        const DepthView& source = *each;
        for (int column = 0; column < source.view.width; ++column) {
            const HorizontalRay ray = source.view.ray_of(column + 0.5);
            for (int row = 0; row < source.view.height; ++row) {
                const float depth = source.depth(row, column);
                if (std::isnan(depth)) continue;
                const double y = source.view.height_of(row + 0.5, ray.axial_at(static_cast<double>(depth)));
                const double h = height + (y - height) * distance / (distance + static_cast<double>(depth));
                range.low = std::min(range.low, h);
                range.high = std::max(range.high, h);
            }
        }
    }
    if (range.low > range.high) range = {-0.1, 0.1};
    return range;
}

// The number of depth steps by which a surface may be moved to save bits, so that a point seen from the middle of the
// widest gap with lines moves by options.depth_shift_px at most.
int max_shift_steps(const std::vector<DepthView>& ring, const ShapeMap& map, double px_per_radius,
                    const ShapeLinesOptions& options) {
    double widest = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        if (map.gaps[n].lines > 0) widest = std::max(widest, gap_width(ring, n));
    }
    const double step_px = kDepthStep * std::sin(widest / 2) * px_per_radius;
    return static_cast<int>(std::min<double>(options.max_depth_shift, options.depth_shift_px / step_px));
}

}  // namespace

double gap_width(const std::vector<DepthView>& ring, std::size_t n) {
    const double width = ring[(n + 1) % ring.size()].view.azimuth() - ring[n].view.azimuth();
    return width > 0 ? width : width + 2 * kPi;
}

ShapeMap make_shape_lines(const std::vector<SurfaceLayer>& layers, const ShapeLinesOptions& options) {
    ShapeMap map;
    const std::vector<DepthView>& ring = layers.front().ring;
    const double count = static_cast<double>(ring.size());
    LineGrid grid;
    double scale = 0;  // px per object radius, along rows and columns
    double scale_y = 0;
    for (const DepthView& source : ring) {
        grid.distance += glm::length(source.view.centre) / count;
        grid.height += source.view.centre_y / count;
        scale += source.view.fl_x / glm::length(source.view.centre) / count;
        scale_y += source.view.fl_y / glm::length(source.view.centre) / count;
    }
    const HeightRange heights = height_range(layers, grid.distance, grid.height);
    const double cell = options.cell_px / scale;
    const double band = options.cell_px / scale_y;
    map.p_cells = std::clamp(static_cast<int>(std::ceil(2 * kHalfWidth / cell)), 1, 4096);
    map.p_half_q20 = fixed_point(kHalfWidth, 20);
    map.p_cells_per_unit_q12 = fixed_point(map.p_cells / (2 * kHalfWidth), 12);
    map.bands = std::clamp(static_cast<int>(std::ceil((heights.high - heights.low) / band)) + 2, 1, 4096);
    map.h_low_q20 = fixed_point(heights.low - band, 20);
    map.bands_per_unit_q12 = fixed_point(1 / band, 12);
    map.reference_distance_q20 = fixed_point(grid.distance, 20);
    map.reference_height_q20 = fixed_point(grid.height, 20);
    map.depth_low_q20 = fixed_point(-kHalfWidth, 20);
    map.depth_step_q24 = fixed_point(kDepthStep, 24);
    map.jump = options.jump;
    map.thickness = options.thickness;
    grid.p_cells = map.p_cells;
    grid.bands = map.bands;
    grid.p_low = -kHalfWidth;
    grid.h_low = heights.low - band;
    grid.cells_per_unit = map.p_cells / (2 * kHalfWidth);
    grid.bands_per_unit = 1 / band;
    grid.fine = options.raster_points;

    std::uint32_t lines = 0;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const double width_deg = degrees(gap_width(ring, n));
        const bool wide = ring.size() < 2 || width_deg > options.max_gap_deg;
        const int count_of_gap =
            wide ? 0 : std::clamp(static_cast<int>(std::ceil(width_deg / options.line_deg - 0.01)) - 1, 1, 1024);
        map.gaps.push_back({static_cast<std::uint16_t>(count_of_gap), lines});
        lines += static_cast<std::uint32_t>(count_of_gap);
    }
    const std::size_t line_cells = static_cast<std::size_t>(map.p_cells) * static_cast<std::size_t>(map.bands);
    map.cells.resize(lines * line_cells);

    // From the first layer only; the soft layer consists of many pieces by its nature.
    std::vector<double> floating(ring.size());
    for_each_index(ring.size(), [&](std::size_t n) { floating[n] = floating_share(ring[n].depth); });

    for_each_index(ring.size(), [&](std::size_t n) {
        const ShapeGap& gap = map.gaps[n];
        LineSurfaces surfaces(grid);
        for (int s = 0; s < gap.lines; ++s) {
            const double part = (s + 0.5) / gap.lines;
            const std::size_t next = (n + 1) % ring.size();
            const glm::dvec2 viewpoint = glm::mix(ring[n].view.centre, ring[next].view.centre, part);
            ShapeCell* const cells = map.cells.data() + (gap.first_line + static_cast<std::size_t>(s)) * line_cells;
            for (const SurfaceLayer& layer : layers) {
                const std::vector<ShapeCell>& found = surfaces.compute(
                    layer, {layer.ring[n], layer.ring[next], viewpoint}, std::min(floating[n], floating[next]));
                for (std::size_t i = 0; i < line_cells; ++i) {
                    if (!cells[i].has_surface()) cells[i] = found[i];
                }
            }
        }
    });
    shape_coding::snap_depths(map, max_shift_steps(ring, map, scale, options));
    return map;
}

}  // namespace rs::encode
