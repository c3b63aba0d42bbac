#pragma once
// A sign that the room was cut out together with the object.

#include "rayspace/image/image.hpp"

#include <span>

namespace rs::capture {

// Whether most of what reaches the picture's border in most cut-outs of a turn, all of one size, never changes. False
// for fewer than six.
bool is_still_at_border(std::span<const Image<Rgba8>> cuts);

}  // namespace rs::capture
