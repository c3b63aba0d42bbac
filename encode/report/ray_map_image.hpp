#pragma once
// Figure of an RS map: the (x, u) space of a ring's reference planes, as in figure 1 of the paper (Sakagawa et al.),
// with the source photo of every cell as its colour.

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <optional>

namespace rs::encode {

/// Draws x from left to right and u from top (u_half) to bottom (-u_half), a square of `cell_px` pixels per cell.
/// Planes are one below the other in their order, so that the azimuth of the rays increases from top to bottom through
/// all of them. Hues go once round the colour circle in the ring's turning order; of neighbouring photos one is darker.
/// Cells without a photo are transparent. The size of a cell is chosen for about 512 px across, and at most 4096 px
/// down. Of maps with more than kMaxImageSide_px cells on a side, every n-th cell is drawn. \param plane a single
/// plane; nullopt: all \return      an error if the ring has no such plane
Result<Image<Rgba8>> ray_map_image(const Ring& ring, std::optional<int> plane = {});

/// Colour of the photo at place `place` of `count` in turning order.
Rgba8 ray_map_colour(std::size_t place, std::size_t count);

}  // namespace rs::encode
