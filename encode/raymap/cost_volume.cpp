#include "encode/raymap/cost_volume.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace rs::encode {
namespace {

constexpr double kFarthestRow = 32000;  // fits in 32 bits in units of 1/65536
constexpr double kNearest = 0.05;       // axial depth, object radii
constexpr float kCostPerLevel = 5;

struct Rows {
    int begin = 0, end = 0;

    [[nodiscard]] int count() const { return end - begin; }
};

// For each level, the range of rows of one column of a volume that contains all rows with this level.
class ColumnLevels {
public:
    ColumnLevels(CostVolume& volume, int column)
        : pixels_(&volume.of(column, volume.box.top), static_cast<std::size_t>(volume.box.height())),
          costs_(volume.costs),
          rows_(static_cast<std::size_t>(volume.levels), {volume.box.height(), 0}) {
        for (int row = 0; row < volume.box.height(); ++row) {
            const PixelLevels& pixel = pixels_[static_cast<std::size_t>(row)];
            for (int n = 0; n < pixel.count; ++n) {
                Rows& rows = rows_[static_cast<std::size_t>(pixel.first + n)];
                rows.begin = std::min(rows.begin, row);
                rows.end = row + 1;
            }
        }
    }

    // Counted from the top of the box.
    [[nodiscard]] const Rows& rows(int level) const { return rows_[static_cast<std::size_t>(level)]; }

    // Calls change(row, cost) for each row that has the level and is not outside of the hull there.
    template <class Change>
    void for_each(int level, const Change& change) {
        for (int row = rows(level).begin; row < rows(level).end; ++row) {
            const PixelLevels& pixel = pixels_[static_cast<std::size_t>(row)];
            const int n = level - pixel.first;
            if (n < 0 || n >= pixel.count) continue;
            std::uint8_t& cost = costs_[pixel.begin + static_cast<std::uint32_t>(n)];
            if (cost != kOutsideCost) change(row, cost);
        }
    }

private:
    std::span<const PixelLevels> pixels_;
    std::vector<std::uint8_t>& costs_;
    std::vector<Rows> rows_;
};

// Points of one column of a view at one depth.
struct ColumnAtDepth {
    const WorkView& view;
    int column = 0;
    const HorizontalRay& ray;  // of the column
    double depth = 0;
    int top = 0;  // first row
    int rows = 0;

    [[nodiscard]] glm::dvec2 place() const { return ray.place_at(depth); }
};

// For each column and each of its levels: calls measure(ColumnAtDepth) for the rows that have the level, then
// change(row - first row, cost) for each of them inside the hull.
template <class Measure, class Change>
void for_each_level(CostVolume& volume, const WorkView& view, const DepthRange& range, const Measure& measure,
                    const Change& change) {
    for (int column = volume.box.left; column < volume.box.right; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        ColumnLevels of_column(volume, column);
        for (int level = 0; level < range.count; ++level) {
            const Rows rows = of_column.rows(level);
            if (rows.count() <= 0) continue;
            measure(ColumnAtDepth{.view = view,
                                  .column = column,
                                  .ray = ray,
                                  .depth = range.at(level),
                                  .top = volume.box.top + rows.begin,
                                  .rows = rows.count()});
            of_column.for_each(
                level, [&](int row, std::uint8_t& cost) { change(static_cast<std::size_t>(row - rows.begin), cost); });
        }
    }
}

// Projections of a column's points at one depth into a neighbor: one column, and rows that are linear in the row.
struct ProjectedRows {
    ProjectedColumn column;
    std::int32_t position_q16 = 0;
    std::int32_t step_q16 = 0;
};

std::optional<ProjectedRows> project_rows(const ColumnAtDepth& own, const WorkView& neighbour) {
    const double axial = own.ray.axial_at(own.depth);
    if (axial <= kNearest) return std::nullopt;
    const ProjectedColumn seen = neighbour.see(own.place());
    if (seen.axial <= kNearest) return std::nullopt;
    const double step = (neighbour.fl_y / seen.axial) * (axial / own.view.fl_y);
    const double at_top = neighbour.row_of(own.view.height_of(own.top + 0.5, axial), seen.axial);
    const double at_bottom = at_top + step * own.rows;
    if (!(std::abs(at_top) < kFarthestRow && std::abs(at_bottom) < kFarthestRow)) return std::nullopt;
    return ProjectedRows{seen, static_cast<std::int32_t>(std::lround(std::ldexp(at_top, 16))),
                         static_cast<std::int32_t>(std::lround(std::ldexp(step, 16)))};
}

// Matching costs of the rows against one neighbor.
void compare_column(const ColumnAtDepth& own, const WorkView& neighbour, std::uint8_t* costs) {
    std::fill(costs, costs + own.rows, kUnknownMatch);
    const std::optional<ProjectedRows> seen = project_rows(own, neighbour);
    if (!seen) return;
    // Interpolated between two columns of the neighbor, in 1/32 px.
    const double left = seen->column.column - 0.5;
    const auto c0 = static_cast<int>(std::floor(left));
    if (c0 < -1 || c0 >= neighbour.width) return;
    match_column({.own = own.view.columns.row(own.column) + own.top,
                  .first = neighbour.columns.row(std::max(c0, 0)),
                  .second = neighbour.columns.row(std::min(c0 + 1, neighbour.width - 1)),
                  .part = static_cast<int>((left - c0) * 32),
                  .rows = own.rows,
                  .height = neighbour.height,
                  .position_q16 = seen->position_q16,
                  .step_q16 = seen->step_q16},
                 costs);
}

// A neighbor's depth map with the rays of its columns.
struct NeighbourSurface {
    explicit NeighbourSurface(const DepthView& found) : view(found.view), depth(found.depth) {
        for (int column = 0; column < view.width; ++column) rays.push_back(view.ray_of(column + 0.5));
    }

    const WorkView& view;
    const Image<float>& depth;
    std::vector<HorizontalRay> rays;
};

// Costs of the distance to the surface of one neighbor, where they are below those in `least`.
void compare_depths(const ColumnAtDepth& own, const NeighbourSurface& found, float cost_per_unit, std::uint8_t* least) {
    const std::optional<ProjectedRows> seen = project_rows(own, found.view);
    if (!seen || !(seen->column.column >= 0 && seen->column.column < found.view.width)) return;
    const auto column = static_cast<int>(seen->column.column);
    const HorizontalRay& their_ray = found.rays[static_cast<std::size_t>(column)];
    compare_depth_column({.depths = found.depth.row(column),
                          .depth = static_cast<float>(glm::dot(own.place() - their_ray.foot, their_ray.along)),
                          .cost_per_unit = cost_per_unit,
                          .rows = own.rows,
                          .height = found.view.height,
                          .position_q16 = seen->position_q16,
                          .step_q16 = seen->step_q16},
                         least);
}

// The levels of a column's pixels that the hull allows.
class AllowedColumn {
public:
    AllowedColumn(const SampledHull& hull, const WorkView& view, const ObjectBox& box, int column,
                  const DepthRange& range)
        : first_(static_cast<std::size_t>(box.height())), last_(first_.size()), allowed_(first_.size()) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        for (int level = 0; level < range.count; ++level) {
            const double depth = range.at(level);
            const double axial = ray.axial_at(depth);
            for (const Interval& heights : hull.heights_above(ray.place_at(depth))) {
                const auto row_of = [&](double y) {
                    const double row = std::clamp(view.row_of(y, axial), double(box.top), double(box.bottom));
                    return static_cast<int>(std::ceil(row - 0.5)) - box.top;
                };
                const Run run{level, {row_of(heights.high), row_of(heights.low)}};
                if (run.rows.count() <= 0) continue;
                runs_.push_back(run);
                allow(static_cast<std::uint16_t>(level), run.rows);
            }
        }
    }

    [[nodiscard]] bool meets(int row) const { return allowed(row) > 0; }
    [[nodiscard]] int first(int row) const { return first_[static_cast<std::size_t>(row)]; }
    [[nodiscard]] int count(int row) const { return last_[static_cast<std::size_t>(row)] - first(row) + 1; }

    // Sets the costs of the allowed levels to 0.
    void clear(std::span<const PixelLevels> pixels, std::vector<std::uint8_t>& costs) const {
        for (std::size_t row = 0; row < pixels.size(); ++row) {
            const PixelLevels& pixel = pixels[row];
            if (pixel.count == allowed_[row]) std::fill_n(costs.data() + pixel.begin, pixel.count, 0);
        }
        for (const Run& run : runs_) {
            for (int row = run.rows.begin; row < run.rows.end; ++row) {
                const PixelLevels& pixel = pixels[static_cast<std::size_t>(row)];
                if (pixel.count == 0 || pixel.count == allowed(row)) continue;
                costs[pixel.begin + static_cast<std::uint32_t>(run.level - pixel.first)] = 0;
            }
        }
    }

private:
    struct Run {
        int level = 0;
        Rows rows;
    };
    [[nodiscard]] int allowed(int row) const { return allowed_[static_cast<std::size_t>(row)]; }

    // Called with ascending levels. Plain loops, for auto-vectorization.
    void allow(std::uint16_t level, const Rows& rows) {
        std::uint16_t* const first = first_.data();
        std::uint16_t* const last = last_.data();
        std::uint16_t* const allowed = allowed_.data();
        for (int row = rows.begin; row < rows.end; ++row) first[row] = allowed[row] == 0 ? level : first[row];
        for (int row = rows.begin; row < rows.end; ++row) ++allowed[row];
        std::fill(last + rows.begin, last + rows.end, level);
    }

    std::vector<Run> runs_;
    std::vector<std::uint16_t> first_, last_;  // [row]
    std::vector<std::uint16_t> allowed_;       // [row], number of allowed levels
};

}  // namespace

ObjectBox object_box(const WorkView& view) {
    ObjectBox box{view.width, view.height, 0, 0};
    for (int column = 0; column < view.width; ++column) {
        for (int row = 0; row < view.height; ++row) {
            if (view.at(column, row).a == 0) continue;
            box = {std::min(box.left, column), std::min(box.top, row), std::max(box.right, column + 1),
                   std::max(box.bottom, row + 1)};
        }
    }
    return box;
}

CostVolume create_volume(const SampledHull& hull, const WorkView& view, const DepthRange& range,
                         const Image<std::uint8_t>* only) {
    CostVolume volume;
    volume.box = object_box(view);
    volume.levels = range.count;
    const ObjectBox& box = volume.box;
    if (box.empty()) return volume;
    volume.pixels.resize(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
    const auto pixels_of = [&](int column) {
        return std::span(volume.pixels)
            .subspan(static_cast<std::size_t>(column - box.left) * static_cast<std::size_t>(box.height()),
                     static_cast<std::size_t>(box.height()));
    };
    std::vector<AllowedColumn> columns;
    columns.reserve(static_cast<std::size_t>(box.width()));
    std::uint32_t costs = 0;
    for (int column = box.left; column < box.right; ++column) {
        const AllowedColumn& allowed = columns.emplace_back(hull, view, box, column, range);
        const std::span<PixelLevels> pixels = pixels_of(column);
        for (int row = 0; row < box.height(); ++row) {
            if (view.at(column, box.top + row).a == 0) continue;
            if (only != nullptr && (*only)(box.top + row, column) == 0) continue;
            const bool meets = allowed.meets(row);
            PixelLevels& pixel = pixels[static_cast<std::size_t>(row)];
            pixel = {costs, static_cast<std::uint16_t>(meets ? allowed.first(row) : 0),
                     static_cast<std::uint16_t>(meets ? allowed.count(row) : range.count)};
            costs += pixel.count;
        }
    }
    volume.costs.assign(costs, kOutsideCost);
    for (int column = box.left; column < box.right; ++column) {
        columns[static_cast<std::size_t>(column - box.left)].clear(pixels_of(column), volume.costs);
    }
    return volume;
}

Image<float> first_allowed_depth(const WorkView& view, const CostVolume& costs, const DepthRange& range) {
    Image<float> depth(view.height, view.width, kNoDepth);
    for (int column = costs.box.left; column < costs.box.right; ++column) {
        for (int row = costs.box.top; row < costs.box.bottom; ++row) {
            const PixelLevels& pixel = costs.of(column, row);
            if (pixel.count == 0 || costs.costs[pixel.begin] == kOutsideCost) continue;
            depth(row, column) = static_cast<float>(range.at(pixel.first));
        }
    }
    return depth;
}

void match_colours(CostVolume& volume, const WorkView& view, const Neighbours& neighbours, const DepthRange& range) {
    const ObjectBox& box = volume.box;
    if (box.empty()) return;
    std::vector<const DepthView*> all = neighbours.beside;
    all.insert(all.end(), neighbours.across.begin(), neighbours.across.end());
    std::vector<std::uint8_t> costs(static_cast<std::size_t>(box.height()) * all.size());
    std::vector<std::uint8_t> merged(static_cast<std::size_t>(box.height()));
    const auto compare = [&](const ColumnAtDepth& own) {
        for (std::size_t n = 0; n < all.size(); ++n) {
            compare_column(own, all[n]->view, costs.data() + n * static_cast<std::size_t>(own.rows));
        }
        merge_matches(costs.data(), own.rows, static_cast<int>(neighbours.beside.size()),
                      static_cast<int>(neighbours.across.size()), merged.data());
    };
    for_each_level(volume, view, range, compare, [&](std::size_t row, std::uint8_t& cost) { cost = merged[row]; });
}

void add_inconsistency(CostVolume& volume, const WorkView& view, const Neighbours& neighbours,
                       const DepthRange& range) {
    const ObjectBox& box = volume.box;
    if (box.empty()) return;
    std::vector<NeighbourSurface> surfaces;
    for (const auto* const kind : {&neighbours.beside, &neighbours.across}) {
        for (const DepthView* const neighbour : *kind) surfaces.emplace_back(*neighbour);
    }
    const auto cost_per_unit = static_cast<float>(kCostPerLevel / range.step);
    std::vector<std::uint8_t> least(static_cast<std::size_t>(box.height()));
    const auto approach = [&](const ColumnAtDepth& own) {
        std::fill(least.begin(), least.end(), kUnknownMatch);
        for (const NeighbourSurface& surface : surfaces) {
            compare_depths(own, surface, cost_per_unit, least.data());
        }
    };
    for_each_level(volume, view, range, approach, [&](std::size_t row, std::uint8_t& cost) {
        if (least[row] == kUnknownMatch) return;
        cost = static_cast<std::uint8_t>(std::min(cost + least[row], kOutsideCost - 1));
    });
}

}  // namespace rs::encode
