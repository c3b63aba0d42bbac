#pragma once
// Checks that an accepted scene of any format is safe to draw.

#include "compositor/scene/scene.hpp"

namespace rs::fuzz {

/// Aborts the program if it is not.
void check_scene(const compositor::Scene& scene);

}  // namespace rs::fuzz
