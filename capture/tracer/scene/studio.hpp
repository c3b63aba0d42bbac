#pragma once
// Photo studio as an environment map: a soft gradient from floor to ceiling, and softboxes.

#include "capture/tracer/scene/scene.hpp"

#include <vector>

namespace rs::capture {

// Bright rounded rectangle. Its radiance falls off smoothly over `edge_deg` inside the edge.
struct Softbox {
    float azimuth_deg = 0.0F;  // of the centre, from +Z towards +X
    float elevation_deg = 45.0F;
    float width_deg = 50.0F;  // along the horizon, as seen from the object
    float height_deg = 40.0F;
    float edge_deg = 6.0F;
    glm::vec3 radiance{4.0F};
};

struct Studio {
    glm::vec3 zenith{0.42F, 0.43F, 0.45F};
    glm::vec3 horizon{0.30F, 0.30F, 0.30F};
    glm::vec3 floor{0.18F, 0.175F, 0.17F};
    std::vector<Softbox> softboxes;
};

// Key light at the front left, fill light at the right, strip light behind; neutral colour, no black regions.
Studio default_studio();

Environment make_studio_environment(const Studio& studio);

}  // namespace rs::capture
