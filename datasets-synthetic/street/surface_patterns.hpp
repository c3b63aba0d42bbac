#pragma once
// Colours of building materials by position in metres, which repeat without seams. Colours are linear light. Pure
// functions, thread-safe.

#include <glm/glm.hpp>

#include <cstdint>

namespace rs::synthetic {

// Hash of a lattice point in [0, 1).
float hash_share(int x, int y, std::uint32_t seed);

// layered_noise() with `features_per_m` features per metre that repeats after `tile_m`, a whole number of features, in
// both directions.
float tiling_noise(glm::vec2 place_m, float tile_m, int features_per_m, int octaves, std::uint32_t seed);

// Stretcher bond, 25 cm by 8.33 cm with mortar; repeats after 4 m.
glm::vec3 brick_colour(glm::vec2 place_m, glm::vec3 colour, std::uint32_t seed);

// Blocks or slabs in staggered courses with dark joints; `variation` of their brightness; repeats after 4 m if the size
// divides 4 m and the number of courses is even.
glm::vec3 block_colour(glm::vec2 place_m, glm::vec2 size_m, float joint_m, glm::vec3 colour, float variation,
                       std::uint32_t seed);

}  // namespace rs::synthetic
