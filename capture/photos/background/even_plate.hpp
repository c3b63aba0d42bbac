#pragma once
// The plate of a studio: a wall or a table of one colour that goes over from light to dark, as lamps and lenses make
// it. Where nothing ever covers it, the pictures show how its light goes over; what the object hides follows by a
// polynomial. A plate that grows inwards (clean_plate_growth.hpp) takes a white object's sides for such a backdrop, for
// they are as light and as smooth.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// Whether a pixel lies in the band around a picture, of .15 of its shorter side, where the backdrop surely is seen.
bool in_border_band(int x, int y, int width, int height);

// A polynomial of second order, in sRGB codes, fitted to the plate where `untouched` (of its size) is not 0, first in
// the band around the picture. Empty where it does not fit there, or the band is hardly seen on one of its sides: with
// edges, texture or a horizon it is another backdrop.
Image<LinearRgb> even_plate(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched);

}  // namespace rs::capture
