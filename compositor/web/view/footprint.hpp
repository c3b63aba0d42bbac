#pragma once
// Object seen from below, for a contact shadow: which points of the ground have surfaces above them, and how high. It
// is computed from the shape maps alone; no image is decoded.

#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <vector>

namespace rs::web {

/// Grid over X and Z in [-1, 1] object radii. Cell (i, j) of `clearance` is [j * kSide + i], i along +X, j along +Z.
struct Footprint {
    static constexpr int kSide = 64;
    static constexpr std::uint8_t kNone = 255;       // no surface above this point
    static constexpr std::uint8_t kPerRadius = 128;  // steps of clearance per object radius
    static constexpr std::uint8_t kHighest = 254;    // higher surfaces are clamped
    double ground = 0;                               // Y of the ground, object radii
    std::vector<std::uint8_t> clearance;             // height of the lowest surface above the ground
};

/// Footprint of an object. The ground is RaySpaceObject::foot_q20, or the lowest surface. Surfaces hidden from all
/// photos are taken to be as high as the rim that encloses them. An object without shape maps gets a disc. Cost: one
/// pass over the cells of the shape maps.
Footprint footprint(const RaySpaceObject& object);

}  // namespace rs::web
