#pragma once
// Paintings for the museum's walls and lettering for signs and cards, made by code. Places are shares of the image,
// 0..1 to the right and up; colours linear light. Pure functions, thread-safe.

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace rs::synthetic {

enum class Painting { hills, sea, fields, circles, birches };

// `aspect`: width / height of the image.
glm::vec3 painted(Painting painting, glm::vec2 share, float aspect, std::uint32_t seed);

// Capital letters and spaces in a single line, fitted into `size_m` with a margin: the ink's cover, 0..1, at a place in
// metres from the lower left corner.
std::function<float(glm::vec2 place_m)> lettering(const std::string& text, glm::vec2 size_m, float letter_height_m,
                                                  float pen_m);

}  // namespace rs::synthetic
