#pragma once
// Many views on one picture, to look at an object at a glance.

#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::engine {

// The pictures, all of one size and at least one, in rows of `columns` from the top left, composited over `backdrop`.
Image<Rgba8> contact_sheet(const std::vector<Image<Rgba8>>& pictures, int columns, Rgba8 backdrop);

}  // namespace rs::engine
