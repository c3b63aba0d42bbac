#pragma once
// Gradient noise (K. Perlin, "Improving Noise", 2002) for surfaces, textures and jitter. Pure functions, thread-safe.

#include <glm/glm.hpp>

#include <cstdint>

namespace rs::synthetic {

// About [-1, 1], mean 0, one feature per unit. With `period_x` > 0 the noise repeats every `period_x` units along x,
// for textures that wrap around an object.
float gradient_noise(glm::vec3 p, std::uint32_t seed, int period_x = 0);

// `octaves` (1..8) layers, each of half the size and half the strength. About [-1, 1].
float layered_noise(glm::vec3 p, int octaves, std::uint32_t seed, int period_x = 0);

// Three independent noises as a vector.
glm::vec3 vector_noise(glm::vec3 p, std::uint32_t seed);

}  // namespace rs::synthetic
