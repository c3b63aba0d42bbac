#pragma once
// How badly the colours of neighbouring pictures disagree, for every pixel of a picture and every depth.

#include "encode/raymap/column_match.hpp"
#include "encode/raymap/depth_range.hpp"
#include "encode/raymap/visual_hull.hpp"
#include "encode/raymap/work_view.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

// A rectangle of pixels, [left, right) x [top, bottom).
struct ObjectBox {
    int left = 0, top = 0, right = 0, bottom = 0;
    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] int height() const { return bottom - top; }
    [[nodiscard]] bool empty() const { return right <= left || bottom <= top; }
};

// The smallest box of all pixels with alpha above 0.
ObjectBox object_box(const WorkView& view);

// cost of pixel (column, row) at a level: costs[((column - left) * height + row - top) * levels + level]
struct CostVolume {
    ObjectBox box;
    int levels = 0;
    std::vector<std::uint8_t> costs;
    [[nodiscard]] const std::uint8_t* at(int column, int row) const { return costs.data() + index(column, row); }
    [[nodiscard]] std::uint8_t* at(int column, int row) { return costs.data() + index(column, row); }

    // Of level 0.
    [[nodiscard]] std::size_t index(int column, int row) const {
        return (static_cast<std::size_t>(column - box.left) * static_cast<std::size_t>(box.height()) +
                static_cast<std::size_t>(row - box.top)) *
               static_cast<std::size_t>(levels);
    }
};

// The pictures that one is compared with, at most two of a kind.
struct Neighbours {
    std::vector<const WorkView*> beside;  // of its ring
    std::vector<const WorkView*> across;  // of the rings below and above
};

// Each neighbour gives a cost, the mean absolute difference of R, G and B, at most kMostCost, which is also that of a
// point that falls on a transparent pixel; a neighbour that does not have the point in its frame gives none. Surfaces
// are seen by the pictures to one side at least, so the better side counts for most. Where there are neighbours of both
// kinds the mean of the two is taken: edges that lie level tell only those across something.
CostVolume matching_costs(const WorkView& view, const Neighbours& neighbours, const DepthRange& range);

// Points outside of the hull cost kOutsideCost.
void forbid_outside(CostVolume& volume, const WorkView& view, const SampledHull& hull, const DepthRange& range);

}  // namespace rs::encode
