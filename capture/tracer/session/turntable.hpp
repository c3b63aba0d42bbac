#pragma once
// Turntable under a photographed object: a rotating disc, and a board (an image) on the disc.
//
// Lengths are in scene units, the frame is the object's: the disc's axis is Y, its top lies slightly below the object's
// lowest vertex, so that no two surfaces coincide.

#include "capture/tracer/scene/scene.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace rs::capture {

enum class DiscSurface {
    none,      // no disc; a board floats
    plain,     // uniform grey
    rings,     // circles about the axis: invariant under rotation
    speckled,  // dots: rotation is visible
};

// An image lying face up; corners at angle 0.
struct Board {
    Image<RgbaF> image;  // linear light, opaque
    // Order: top left, top right, bottom right, bottom left of the image.
    std::array<glm::dvec3, 4> corners{};
};

struct Turntable {
    DiscSurface surface = DiscSurface::rings;
    double radius = 0;
    double top = 0;        // height
    double thickness = 0;  // downwards from the top
    std::uint64_t seed = 1;
    std::optional<Board> board;

    // Height of the disc's lower side.
    [[nodiscard]] double bottom() const { return surface == DiscSurface::none ? top : top - thickness; }
    // Largest distance of disc and board from the axis.
    [[nodiscard]] double reach() const;
};

/// Makes a disc under `object`.
/// \param object_radius largest distance of the object from the axis
Turntable fit_turntable(const Scene& object, double object_radius, DiscSurface surface, std::uint64_t seed);

/// Places a board on the disc, with a small offset from the axis and a rotation drawn from the turntable's seed. The
/// aspect ratio is the image's.
void lay_board(Turntable& turntable, Image<RgbaF> image, double width);

/// Adds the meshes, materials and textures of disc and board to a scene.
void add_turntable(Scene& scene, const Turntable& turntable);

}  // namespace rs::capture
