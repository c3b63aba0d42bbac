#pragma once
// Procedural paintings for the museum's walls and lettering for signs and cards. Positions are relative to the image,
// 0..1 to the right and up; colours are linear light. Pure functions, thread-safe.

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace rs::synthetic {

enum class Painting { hills, sea, fields, circles, birches };

// `aspect`: width / height of the image.
glm::vec3 painting_colour(Painting painting, glm::vec2 share, float aspect, std::uint32_t seed);

// One line of capital letters and spaces, fitted into `size_m` with a margin. Returns the ink's coverage, 0..1, as a
// function of the position in metres from the lower left corner.
std::function<float(glm::vec2 place_m)> lettering(const std::string& text, glm::vec2 size_m, float letter_height_m,
                                                  float pen_m);

}  // namespace rs::synthetic
