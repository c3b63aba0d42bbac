#pragma once
// The satin ribbon around the bear's neck, tied in a bow under its chin.

#include "capture/tracer/scene/scene.hpp"

namespace rs::synthetic {

// Appends the bow in the bear's coordinates (bear_body.hpp).
void append_bow(capture::Mesh& mesh);

}  // namespace rs::synthetic
