#pragma once
// The teddy bear's body: its ellipsoids, fur regions and bow.
//
// The bear sits on y = 0, looks along +Z and is about 2 high.

#include "capture/tracer/scene/scene.hpp"
#include "datasets-synthetic/shapes/surfaces.hpp"

#include <vector>

namespace rs::synthetic {

enum class BearRegion { coat, pale };

struct BearPart {
    Ellipsoid shape;
    BearRegion region = BearRegion::coat;
    float hair_length = 1.0F;  // relative to the whole bear's
    glm::vec3 comb{0, -1, 0};  // direction of the hairs
};

std::vector<BearPart> bear_parts();

// Felt pads under the feet, without hair.
std::vector<Ellipsoid> bear_foot_pads();

// Regions without hair roots: the pads, and around the eyes, the nose and the mouth.
std::vector<Ellipsoid> bear_bare_regions();

// Region of a point on a part: pale fur covers pale parts, the middle of the belly and the inside of the ears.
BearRegion region_at(const BearPart& part, glm::vec3 normal, glm::vec3 position);

// Appends the satin ribbon around the bear's neck, tied in a bow under its chin.
void append_bow(capture::Mesh& mesh);

}  // namespace rs::synthetic
