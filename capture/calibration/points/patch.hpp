#pragma once
// A patch of texture around a point and its alignment to another image: Lucas and Kanade 1981, with a warp that is
// affine but for a known quadratic part, a gain, and light that changes linearly over the patch.

#include "capture/calibration/points/patch_image.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace rs::capture {

// How curved a surface is that nothing is known about, 1/px: radii of 50 px.
inline constexpr double kTypicalCurvature = 0.02;

// Grey values and where they count, row by row.
struct Patch {
    std::array<PatchRow, kPatchSide_px> value{};
    std::array<PatchRow, kPatchSide_px> counts{};  // 1 on the object, else 0
};

// The patch around a place of an image, levelled: less the plane that fits its values best. Nothing where too little
// of it lies on the object or there is no texture.
std::optional<Patch> textured_patch(const PatchImage& image, glm::dvec2 centre);

struct Alignment {
    Observation seen;  // its view is left at 0
    glm::dmat2 matrix{1.0};
    // Beside what the warp began with, 1/px, by i^2 / 2, j^2 / 2, i j; zero where curvature was known. In units of the
    // image's noise, the information it rests on.
    glm::dvec3 curvature{0.0};
    glm::dvec3 curvature_information{0.0};
};

// Moves the warp until the image shows the patch; nothing where it runs away or the texture is not there.
std::optional<Alignment> align(const PatchImage& image, const Patch& patch, const Warp& warp, bool curvature_is_known);

}  // namespace rs::capture
