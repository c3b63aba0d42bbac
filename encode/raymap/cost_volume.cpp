#include "encode/raymap/cost_volume.hpp"

#include <algorithm>
#include <cmath>

namespace rs::encode {
namespace {

constexpr std::uint8_t kUnknown = 255;
constexpr std::uint8_t kOutside = 254;

// Rows [top, bottom) of one column at one depth against one neighbour.
void compare_column(const WorkView& view, const WorkView& neighbour, const HorizontalRay& ray, double depth, int column,
                    const ObjectBox& box, std::uint8_t* costs) {
    const int rows = box.height();
    std::fill(costs, costs + rows, kUnknown);
    const double axial = ray.axial_at(depth);
    if (axial <= 0.05) return;
    const SeenColumn seen = neighbour.see(ray.place_at(depth));
    if (seen.axial <= 0.05) return;
    // Between two columns of the neighbour, in 1/32 px.
    const double left = seen.column - 0.5;
    const auto c0 = static_cast<int>(std::floor(left));
    if (c0 < -1 || c0 >= neighbour.width) return;
    const int part = static_cast<int>((left - c0) * 32);
    const Rgba8* const first = neighbour.columns.row(std::max(c0, 0));
    const Rgba8* const second = neighbour.columns.row(std::min(c0 + 1, neighbour.width - 1));
    // Rows are linear in rows.
    const double scale = (neighbour.fl_y / seen.axial) * (axial / view.fl_y);
    const double at_top = neighbour.row_of(view.height_of(box.top + 0.5, axial), seen.axial);
    const Rgba8* const own = view.columns.row(column) + box.top;
    const auto step = static_cast<std::int64_t>(std::llround(std::ldexp(scale, 16)));
    auto position = static_cast<std::int64_t>(std::llround(std::ldexp(at_top, 16)));
    for (int n = 0; n < rows; ++n, position += step) {
        if (own[n].a == 0) continue;
        const std::int64_t row = position >> 16;
        if (row < 0 || row >= neighbour.height) continue;
        const Rgba8 a = first[row];
        const Rgba8 b = second[row];
        if (a.a * (32 - part) + b.a * part < 128 * 32) {
            costs[n] = kOutside;
            continue;
        }
        const auto difference = [&](int mine, int one, int other) {
            return std::abs(mine * 32 - one * (32 - part) - other * part);
        };
        const int sum =
            difference(own[n].r, a.r, b.r) + difference(own[n].g, a.g, b.g) + difference(own[n].b, a.b, b.b);
        costs[n] = static_cast<std::uint8_t>(std::min(sum / 96, kMostCost));
    }
}

// What the neighbours of one kind say of a pixel at a depth.
class KindCost {
public:
    void add(int cost) {
        if (cost == kUnknown) return;
        known_ = true;
        outside_ |= cost == kOutside;
        best_ = std::min(best_, cost);
        worst_ = std::max(worst_, cost);
    }
    [[nodiscard]] bool known() const { return known_; }
    [[nodiscard]] bool outside() const { return outside_; }
    [[nodiscard]] int cost() const { return (3 * best_ + std::min(worst_, best_ + 20)) / 4; }

private:
    int best_ = kMostCost;
    int worst_ = 0;
    bool known_ = false;
    bool outside_ = false;
};

int both(const KindCost& beside, const KindCost& across) {
    if (beside.outside() || across.outside()) return kOutsideCost;
    if (!across.known()) return beside.known() ? beside.cost() : kMostCost / 2;
    if (!beside.known()) return across.cost();
    return (beside.cost() + across.cost()) / 2;
}

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

CostVolume matching_costs(const WorkView& view, const Neighbours& neighbours, const DepthRange& range) {
    CostVolume volume;
    volume.box = object_box(view);
    volume.levels = range.count;
    if (volume.box.empty()) return volume;
    const auto rows = static_cast<std::size_t>(volume.box.height());
    const auto levels = static_cast<std::size_t>(range.count);
    volume.costs.resize(static_cast<std::size_t>(volume.box.width()) * rows * levels);
    std::vector<const WorkView*> all = neighbours.beside;
    all.insert(all.end(), neighbours.across.begin(), neighbours.across.end());
    std::vector<std::uint8_t> costs(rows * all.size());
    for (int column = volume.box.left; column < volume.box.right; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        std::uint8_t* const to = volume.at(column, volume.box.top);
        for (int level = 0; level < range.count; ++level) {
            for (std::size_t n = 0; n < all.size(); ++n) {
                compare_column(view, *all[n], ray, range.at(level), column, volume.box, costs.data() + n * rows);
            }
            for (std::size_t row = 0; row < rows; ++row) {
                KindCost beside;
                KindCost across;
                for (std::size_t n = 0; n < all.size(); ++n) {
                    (n < neighbours.beside.size() ? beside : across).add(costs[n * rows + row]);
                }
                to[row * levels + static_cast<std::size_t>(level)] = static_cast<std::uint8_t>(both(beside, across));
            }
        }
    }
    return volume;
}

void forbid_outside(CostVolume& volume, const WorkView& view, const VisualHull& hull, const DepthRange& range) {
    const ObjectBox& box = volume.box;
    std::vector<Interval> heights;
    for (int column = box.left; column < box.right; ++column) {
        const HorizontalRay ray = view.ray_of(column + 0.5);
        std::uint8_t* const costs = volume.at(column, box.top);
        for (int level = 0; level < range.count; ++level) {
            const double depth = range.at(level);
            const double axial = ray.axial_at(depth);
            hull.heights_above(ray.place_at(depth), heights);
            int row = box.top;
            const auto forbid_until = [&](int end) {
                for (; row < end; ++row) {
                    costs[static_cast<std::size_t>(row - box.top) * static_cast<std::size_t>(volume.levels) +
                          static_cast<std::size_t>(level)] = kOutsideCost;
                }
            };
            for (auto n = heights.rbegin(); n != heights.rend(); ++n) {
                const double top = std::clamp(view.row_of(n->high, axial), double(box.top), double(box.bottom));
                const double bottom = std::clamp(view.row_of(n->low, axial), double(box.top), double(box.bottom));
                forbid_until(static_cast<int>(std::ceil(top - 0.5)));
                row = std::max(row, static_cast<int>(std::ceil(bottom - 0.5)));
            }
            forbid_until(box.bottom);
        }
    }
}

}  // namespace rs::encode
