#pragma once
// What a turntable's disc shows of the plate where the object hides it: the other pixels of the same circle show it.

#include "capture/photos/background/turntable_disc.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>

namespace rs::capture {

// 255 on the disc and around it, up to `reach` of its radius beyond its rim or a blurred rim's width, whichever is
// more.
Image<std::uint8_t> disc_mask(const TurntableDisc& disc, int width, int height, double reach = 0);

// Where the object stands on the disc with a foot that looks the same from all sides, so that nothing moves there:
// what does not look like the bare disc, shaded or not, on circles of which the object hides the greater part, and
// hangs together with what is `swept` (not 0 where motion shows the object). 255 there, outside of `swept`.
Image<std::uint8_t> still_foot(const TurntableDisc& disc, ConstImageView<Rgba8> still,
                               ConstImageView<std::uint8_t> known, ConstImageView<std::uint8_t> swept);

// bridge_rows() for a plate with a disc: gaps on the disc are bridged along the circles about the axis, from the known
// ends of an arc to each other, and rows around the disc run on behind it.
void bridge_gaps(const std::optional<TurntableDisc>& disc, Image<Rgba8>& plate, Image<std::uint8_t>& known);

}  // namespace rs::capture
