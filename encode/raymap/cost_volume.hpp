#pragma once
// How unlikely each depth of each pixel of a picture is: by the colours of neighbouring pictures, and by the surfaces
// that these were found to show.

#include "encode/raymap/column_match.hpp"
#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"

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

// The levels first .. first + count - 1 that one pixel may have; the cost of level first + n is costs[begin + n].
struct PixelLevels {
    std::uint32_t begin = 0;
    std::uint16_t first = 0;
    std::uint16_t count = 0;  // 0: the pixel is not of the object
};

// Photographed objects fill a tenth to a fifth of the depths that are searched, and half of their box.
struct CostVolume {
    ObjectBox box;
    int levels = 0;                   // of the range
    std::vector<PixelLevels> pixels;  // [(column - box.left) * box.height() + row - box.top]
    std::vector<std::uint8_t> costs;

    [[nodiscard]] const PixelLevels& of(int column, int row) const {
        return pixels[static_cast<std::size_t>((column - box.left) * box.height() + row - box.top)];
    }
};

// Every pixel of the object with the levels of `range` (at most 65535) that the hull allows, from the first to the
// last. They cost nothing yet; what lies between but outside of the hull costs kOutsideCost. A pixel whose ray misses
// the hull has all levels, at that cost. Of `only` (as WorkView::columns; may be null), pixels that are not 0 there.
CostVolume levels_within(const SampledHull& hull, const WorkView& view, const DepthRange& range,
                         const Image<std::uint8_t>* only = nullptr);

// The depths of the first levels that the hull allows, as DepthView::depth.
Image<float> first_allowed(const WorkView& view, const CostVolume& costs, const DepthRange& range);

// The pictures that one is compared with, at most two of a kind, each with what it was found to show, if anything.
struct Neighbours {
    std::vector<const DepthView*> beside;  // of its ring
    std::vector<const DepthView*> across;  // of the rings below and above
};

// The colours. Each neighbour gives a cost, the mean absolute difference of R, G and B, at most kMostCost; one that
// does not have the point in its frame gives none, one that shows it transparent makes it cost kOutsideCost. Surfaces
// are seen by the pictures to one side at least, so the better side counts for most. Where there are neighbours of both
// kinds the mean of the two is taken: edges that lie level distinguish only those across something.
// What costs kOutsideCost stays as it is.
void match_colours(CostVolume& volume, const WorkView& view, const Neighbours& neighbours, const DepthRange& range);

// Adds how far a point is from the nearest of the surfaces that neighbours show where they see it: 5 for a level,
// kMostCost at most; nothing where none shows a surface there. So what two pictures agree about outweighs
// the colours of a few pixels.
void add_inconsistency(CostVolume& volume, const WorkView& view, const Neighbours& neighbours, const DepthRange& range);

}  // namespace rs::encode
