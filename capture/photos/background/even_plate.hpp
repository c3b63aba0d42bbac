#pragma once
// The plate of a studio: paper, a wall or a table of one colour that goes over from light to dark, as lamps and lenses
// make it, and a horizon where one of them ends and another begins. Where nothing ever covers it, the pictures show how
// its light goes over; what the object hides follows. A plate that grows inwards (clean_plate_growth.hpp) takes a white
// object's sides for such a backdrop, for they are as light and as smooth, and the core of a shadow, which lies where
// it lies in most of the pictures.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// A row's own light times a polynomial along it that goes over slowly from row to row, fitted to the band around the
// plate, of .15 of its shorter side, where `untouched` (of its size) is not 0. What is seen farther inside is compared
// with it: things that stand alone, as a mark on the wall or a cable, are in the result as they are. Empty where most
// of the band does not fit or is hardly seen on one of its sides, where there are many such things, and where one hangs
// together with the region that the object sweeps, for it may go on behind the object: a table, a turntable, a seam.
Image<LinearRgb> even_plate(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched);

}  // namespace rs::capture
