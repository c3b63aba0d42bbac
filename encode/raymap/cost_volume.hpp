#pragma once
// Matching cost volume of a photo: the cost of each depth level of each pixel, from the colours of neighboring photos
// and from their depth maps.

#include "encode/raymap/column_match.hpp"
#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

/// A rectangle of pixels, [left, right) x [top, bottom).
struct ObjectBox {
    int left = 0, top = 0, right = 0, bottom = 0;
    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] int height() const { return bottom - top; }
    [[nodiscard]] bool empty() const { return right <= left || bottom <= top; }
};

/// The bounding box of all pixels with alpha above 0.
ObjectBox object_box(const WorkView& view);

/// The levels first .. first + count - 1 of one pixel; the cost of level first + n is costs[begin + n].
struct PixelLevels {
    std::uint32_t begin = 0;
    std::uint16_t first = 0;
    std::uint16_t count = 0;  // 0: the pixel is not part of the object
};

/// A sparse cost volume: only the levels that the hull allows are stored, a tenth to a fifth of all.
struct CostVolume {
    ObjectBox box;
    int levels = 0;                   // of the depth range
    std::vector<PixelLevels> pixels;  // [(column - box.left) * box.height() + row - box.top]
    std::vector<std::uint8_t> costs;

    [[nodiscard]] const PixelLevels& of(int column, int row) const {
        return pixels[static_cast<std::size_t>((column - box.left) * box.height() + row - box.top)];
    }
};

/// Creates the volume of the object's pixels, with the levels of `range` (at most 65535) from the first to the last
/// that the hull allows. Levels inside the hull cost 0, levels between them but outside of it kOutsideCost. A pixel
/// whose ray misses the hull has all levels, at kOutsideCost. \param only  if not null, only its pixels that are not 0
/// are part of the volume; transposed as WorkView::columns is.
CostVolume create_volume(const SampledHull& hull, const WorkView& view, const DepthRange& range,
                         const Image<std::uint8_t>* only = nullptr);

/// The depth at which each pixel's ray enters the hull, as DepthView::depth.
Image<float> first_allowed_depth(const WorkView& view, const CostVolume& costs, const DepthRange& range);

/// The photos that a photo is compared with, at most two of each kind.
struct Neighbours {
    std::vector<const DepthView*> beside;  // in the same ring
    std::vector<const DepthView*> across;  // in the rings below and above
};

/// Sets the costs from colours. Each neighbor gives the mean absolute difference of R, G and B, at most kMaxCost; none
/// where the point is outside of its frame; kOutsideCost where it is transparent there. A surface is seen from one side
/// at least, so that the better neighbor of a kind has most of the weight. Where there are neighbors of both kinds
/// their mean is taken, since horizontal edges can be matched only across rings. Costs that are kOutsideCost already
/// are kept.
void match_colours(CostVolume& volume, const WorkView& view, const Neighbours& neighbours, const DepthRange& range);

/// Adds the distance of a point from the nearest surface in the neighbors' depth maps at its projections: 5 per level,
/// at most kMaxCost; nothing where none has a depth there. So the depth of another photo outweighs the colours of a
/// few pixels.
void add_inconsistency(CostVolume& volume, const WorkView& view, const Neighbours& neighbours, const DepthRange& range);

}  // namespace rs::encode
