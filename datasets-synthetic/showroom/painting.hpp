#pragma once
// Procedural textures: floors, boards and walls by position in metres, baked contact shadows of furniture, because the
// scene's lights cast none, paintings, and lettering for signs and cards. Colours are linear light. Pure functions,
// thread-safe.

#include <glm/glm.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace rs::synthetic {

// Sawn wood, the grain along x.
struct WoodTone {
    glm::vec3 light{0.5F};
    glm::vec3 dark{0.2F};
};
glm::vec3 wood(glm::vec2 place_m, const WoodTone& tone, std::uint32_t seed);

// Boards of this width and length along y, with staggered joints.
glm::vec3 planks(glm::vec2 place_m, float width_m, float length_m, const WoodTone& tone, std::uint32_t seed);

// Hungarian point parquet: columns of slanting boards that form arrows along y.
glm::vec3 chevron(glm::vec2 place_m, float column_m, float board_m, const WoodTone& tone, std::uint32_t seed);

glm::vec3 plaster(glm::vec2 place_m, glm::vec3 colour, std::uint32_t seed);

// Woven cane in squares of this side.
glm::vec3 wicker(glm::vec2 place_m, float strand_m, const WoodTone& tone, std::uint32_t seed);

// A rug of `size_m` with borders and a field of lozenges.
glm::vec3 rug(glm::vec2 place_m, glm::vec2 size_m, std::uint32_t seed);

// Footprint of an object on a surface, for its contact shadow.
struct Footprint {
    glm::vec2 low{0.0F};
    glm::vec2 high{0.0F};
    float reach_m = 0.25F;  // width of the shadow
    float strength = 0.6F;  // share of light lost at the footprint's edge
    bool round = false;     // the ellipse in the rectangle
};

// Contact shadow of footprints: the remaining share of light.
float contact_shadow(glm::vec2 place_m, std::span<const Footprint> footprints);

// Shadow at `distance_m` from an inner edge between two surfaces: the remaining share of light.
float corner_shadow(float distance_m, float reach_m, float strength);

// Paintings for the museum's walls.
enum class Painting { hills, sea, fields, circles, birches };

// `share`: position in the image, 0..1 to the right and up; `aspect`: width / height of the image.
glm::vec3 painting_colour(Painting painting, glm::vec2 share, float aspect, std::uint32_t seed);

// One line of capital letters and spaces, fitted into `size_m` with a margin. Returns the ink's coverage, 0..1, as a
// function of the position in metres from the lower left corner.
std::function<float(glm::vec2 place_m)> lettering(const std::string& text, glm::vec2 size_m, float letter_height_m,
                                                  float pen_m);

}  // namespace rs::synthetic
