#pragma once
// Object in the layout of every memory channel of a parallel board (parallel_layout.hpp).

#include "engine/model/layout/object_image.hpp"

#include <array>

namespace rs::engine::model {

// Words per region. Region::flat_tiles also holds raw images.
std::array<std::uint64_t, kObjectRegions> parallel_object_words(const RaySpaceObject& object);

// `object` must be drawable by a parallel board.
ObjectImage parallel_object_image(const RaySpaceObject& object, const Placement& placement);

}  // namespace rs::engine::model
