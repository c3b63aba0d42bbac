#pragma once
// White parts of an object before a white of one colour, as shops retouch their pictures: ten codes darker, without a
// shadow of their own. To the mask that noise and shadows allow for they are backdrop; a second one, that takes a few
// codes for the object, shows them, but fills loops and takes patches of shadow along. So its large parts are taken.

#include "capture/photos/matte/object_mask.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// What stands behind an object before `white`: that colour, but the plate's own where nothing ever covers it
// (`untouched` is not 0) and it clearly differs, as a shop's mark.
PlateView flat_plate(const PlateView& plate, ConstImageView<std::uint8_t> untouched, const LinearRgb& white);

// Adds to `mask` (255 = object) the parts that only find_object() before `flat` shows and that are large beside the
// object.
void add_white_parts(Image<std::uint8_t>& mask, ConstImageView<Rgba8> photo, const PlateView& flat);

}  // namespace rs::capture
