#pragma once
// Check of a rig that is kept as text. Separate from rig.hpp, so that readers of objects need no JSON library: the
// WebAssembly core (compositor/web) takes its cameras from the views and does not read the rig.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <string>

namespace rs {

/// Checks that `json` is the transforms.json of a rig (rig.hpp) with `views` frames.
Status check_rig_text(const std::string& json, std::size_t views);

}  // namespace rs
