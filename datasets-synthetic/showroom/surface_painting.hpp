#pragma once
// What floors, boards and walls look like, as colours at places in metres, and the soft shadows that furniture leaves
// on them: lights of the scene cast none, so they are painted in. Colours are linear light. Pure functions,
// thread-safe.

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace rs::synthetic {

// Sawn wood, the grain along x.
struct WoodTone {
    glm::vec3 light{0.5F};
    glm::vec3 dark{0.2F};
};
glm::vec3 wood(glm::vec2 place_m, const WoodTone& tone, std::uint32_t seed);

// Boards of this width and length along y, in courses that do not meet.
glm::vec3 planks(glm::vec2 place_m, float width_m, float length_m, const WoodTone& tone, std::uint32_t seed);

// Hungarian point: columns of slanting boards that meet in arrows along y.
glm::vec3 chevron(glm::vec2 place_m, float column_m, float board_m, const WoodTone& tone, std::uint32_t seed);

glm::vec3 plaster(glm::vec2 place_m, glm::vec3 colour, std::uint32_t seed);

// Woven cane, as of a basket, in squares of this side.
glm::vec3 wicker(glm::vec2 place_m, float strand_m, const WoodTone& tone, std::uint32_t seed);

// A rug of `size_m` with borders and a field of lozenges.
glm::vec3 rug(glm::vec2 place_m, glm::vec2 size_m, std::uint32_t seed);

// The footprint of something that stands on a surface: light is lost on it and near it.
struct Footprint {
    glm::vec2 low{0.0F};
    glm::vec2 high{0.0F};
    float reach_m = 0.25F;  // how far the shadow goes
    float strength = 0.6F;  // how much is lost at its edge
    bool round = false;     // the ellipse in the rectangle
};

// The share of light that is left.
float light_beside(glm::vec2 place_m, std::span<const Footprint> footprints);

// The share that is left near an inner edge at `distance_m`, where two surfaces meet.
float light_in_corner(float distance_m, float reach_m, float strength);

}  // namespace rs::synthetic
