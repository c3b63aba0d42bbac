#pragma once
// What an accepted scene must be, whatever file it came from: safe to draw.

#include "compositor/scene/scene.hpp"

namespace rs::fuzz {

// Stops the program where it is not.
void check_scene(const compositor::Scene& scene);

}  // namespace rs::fuzz
