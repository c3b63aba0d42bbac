#pragma once
// What a photographed object stands on: a round plate that turns with it, and a picture laid on the plate.
//
// Lengths are the scene's, the frame is the object's: the plate's axis is Y, its top lies a hair below the object's
// lowest vertex, so that the object stands on it and no two surfaces coincide.

#include "capture/tracer/scene/scene.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace rs::capture {

enum class PlateSurface {
    none,      // no plate; a board lies in the air
    plain,     // even grey
    rings,     // circles about the axis: looks the same however it is turned
    speckled,  // dots, which turn
};

// A picture lying face up; its corners as they stand at angle 0.
struct Board {
    Image<RgbaF> picture;  // linear light, taken as opaque
    // Top left, top right, bottom right, bottom left of the picture.
    std::array<glm::dvec3, 4> corners{};
};

struct Plate {
    PlateSurface surface = PlateSurface::rings;
    double radius = 0;
    double top = 0;        // height
    double thickness = 0;  // downwards from the top
    std::uint64_t seed = 1;
    std::optional<Board> board;

    // Height of what the plate stands on.
    [[nodiscard]] double foot() const { return surface == PlateSurface::none ? top : top - thickness; }
    // The largest distance from the axis of plate and board.
    [[nodiscard]] double reach() const;
};

// A plate that fits under `object`, whose vertices reach `object_radius` from the axis.
Plate fit_plate(const Scene& object, double object_radius, PlateSurface surface, std::uint64_t seed);

// Lays `picture` on the plate, `width` wide, a little off the axis and turned by any angle, both drawn from the plate's
// seed. The height follows from the picture, whose pixels are square.
void lay_board(Plate& plate, Image<RgbaF> picture, double width);

// Adds the meshes, materials and textures of plate and board.
void add_plate(Scene& scene, const Plate& plate);

}  // namespace rs::capture
