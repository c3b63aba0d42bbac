#pragma once
// The plate of a studio: a wall or a table of one colour that goes over from light to dark, as lamps and lenses make
// it. What nothing ever covers shows its whole course, so that the rest follows from it. A plate that grows inwards
// (clean_plate_growth.hpp) takes a white object's sides for such a backdrop, for they are as light and as smooth.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// A polynomial of second order, in sRGB codes, fitted to the plate where `untouched` (of its size) is not 0. Empty
// where it does not fit: with edges, texture or a horizon it is another backdrop.
Image<LinearRgb> even_plate(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> untouched);

}  // namespace rs::capture
