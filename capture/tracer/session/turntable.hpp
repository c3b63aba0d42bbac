#pragma once
// What a photographed object stands on: a turntable's disc that turns with it, and an image laid on the disc.
//
// Lengths are the scene's, the frame is the object's: the disc's axis is Y, its top lies a hair below the object's
// lowest vertex, so that the object stands on it and no two surfaces coincide.

#include "capture/tracer/scene/scene.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace rs::capture {

enum class DiscSurface {
    none,      // no disc; a board lies in the air
    plain,     // even grey
    rings,     // circles about the axis: looks the same however it is turned
    speckled,  // dots, which turn
};

// An image lying face up; its corners as they stand at angle 0.
struct Board {
    Image<RgbaF> image;  // linear light, taken as opaque
    // Top left, top right, bottom right, bottom left of the image.
    std::array<glm::dvec3, 4> corners{};
};

struct Turntable {
    DiscSurface surface = DiscSurface::rings;
    double radius = 0;
    double top = 0;        // height
    double thickness = 0;  // downwards from the top
    std::uint64_t seed = 1;
    std::optional<Board> board;

    // Height of what the disc stands on.
    [[nodiscard]] double bottom() const { return surface == DiscSurface::none ? top : top - thickness; }
    // The largest distance from the axis of disc and board.
    [[nodiscard]] double reach() const;
};

// A disc that fits under `object`, whose vertices reach `object_radius` from the axis.
Turntable fit_turntable(const Scene& object, double object_radius, DiscSurface surface, std::uint64_t seed);

// Lays `image` on the disc, `width` wide, a little off the axis and turned by any angle, both drawn from the
// turntable's seed. The height follows from the image, whose pixels are square.
void lay_board(Turntable& turntable, Image<RgbaF> image, double width);

// Adds the meshes, materials and textures of disc and board.
void add_turntable(Scene& scene, const Turntable& turntable);

}  // namespace rs::capture
