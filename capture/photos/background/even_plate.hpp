#pragma once
// The plate of a studio: paper, a wall or a table of one colour that goes over from light to dark, as lamps and lenses
// make it, and a horizon where one of them ends and another begins. Where nothing ever covers it, the pictures show how
// its light goes over; what the object hides follows. A plate that grows inwards (clean_plate_growth.hpp) takes a white
// object's sides for such a backdrop, for they are as light and as smooth, and the core of a shadow, which lies where
// it lies in most of the pictures.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// Whether a pixel lies in the band around a picture, of .15 of its shorter side, where the backdrop surely is seen.
bool in_border_band(int x, int y, int width, int height);

// A row's own light times a polynomial along it that goes over slowly from row to row, fitted to the plate where
// `untouched` (of its size) is not 0, first in the band around the picture. Empty where most of the band does not fit,
// where it is hardly seen on one of its sides, and where much is seen that is neither the course nor a shadow on it:
// with edges that run down, texture or a turntable it is another backdrop.
Image<LinearRgb> even_plate(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched);

}  // namespace rs::capture
