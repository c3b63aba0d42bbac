#pragma once
// The teddy bear's body plan: which ellipsoids it is made of, and what grows where.
//
// The bear sits on y = 0, looks along +Z and is about 2 high.

#include "datasets-synthetic/shapes/ellipsoid.hpp"

#include <vector>

namespace rs::synthetic {

enum class BearRegion { coat, pale };

struct BearPart {
    Ellipsoid shape;
    BearRegion region = BearRegion::coat;
    float hair_length = 1.0F;  // relative to the whole bear's
    glm::vec3 comb{0, -1, 0};  // hairs lie towards there
};

std::vector<BearPart> bear_parts();

// The felt pads under the feet, which carry no hair.
std::vector<Ellipsoid> bear_foot_pads();

// Where no hair starts: the pads, and around the eyes, the nose and the mouth.
std::vector<Ellipsoid> bear_bare_places();

// Pale fur covers a part, or the middle of the belly and the inside of the ears.
BearRegion region_at(const BearPart& part, glm::vec3 normal, glm::vec3 position);

}  // namespace rs::synthetic
