#pragma once
// White objects before a white of one colour, as shops retouch their pictures, and grey ones before a grey: a few codes
// off, and as a shadow could look. A mask that allows for noise and shadows lacks their bodies; a second one, which
// takes a few codes for the object, shows them, but fills loops and takes patches of shadow along where an object has
// colour.

#include "capture/photos/matte/object_mask.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// What stands behind an object before `grey`: that colour, but the plate's own where nothing ever covers it
// (`untouched`, of its size, is not 0) and it clearly differs, as a shop's mark.
CleanPlateView flat_plate(const CleanPlateView& plate, ConstImageView<std::uint8_t> untouched, const LinearRgb& grey);

// Adds what find_object() before `flat`, as flat_plate() gives it, shows to `mask` (255 = object) where that lacks a
// large part of it. Where that leaves hardly any of what differs from `flat`, as nothing of the object is clearly no
// shadow, its shadow comes along: better than no object.
void add_grey_parts(Image<std::uint8_t>& mask, const SeenPhoto& photo, const CleanPlateView& flat);

}  // namespace rs::capture
