#pragma once
// The part of validate_object() that looks at a ring's shape map; encode/FORMAT.md, section "Ranges".

#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

namespace rs {

// ring.shape is empty in all its members, or has the sizes that the ring and its own numbers ask for and all numbers
// within their ranges. The ring's own numbers must have been checked. The error says what is wrong, without a place.
// Cost: one look at every cell.
Status check_shape(const Ring& ring);

}  // namespace rs
