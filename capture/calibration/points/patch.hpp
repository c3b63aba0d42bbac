#pragma once
// A textured patch around a point and its alignment to another image: Lucas and Kanade 1981, with an affine warp with a
// known quadratic part, a gain, and illumination that changes linearly over the patch.

#include "capture/calibration/points/patch_image.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace rs::capture {

/// Prior of an unknown surface curvature, 1/px: radii of 50 px.
inline constexpr double kTypicalCurvature = 0.02;

/// Grey values and validity mask, row by row.
struct Patch {
    std::array<PatchRow, kPatchSide_px> value{};
    std::array<PatchRow, kPatchSide_px> counts{};  // 1 on the object, else 0
};

/// The patch around a pixel position, minus the plane that fits its values best. Nothing if too little of it is on the
/// object or it has no texture.
std::optional<Patch> extract_patch(const PatchImage& image, glm::dvec2 centre);

struct Alignment {
    Observation seen;  // its view is left at 0
    glm::dmat2 matrix{1.0};
    /// Curvature relative to the initial warp, 1/px, for i^2 / 2, j^2 / 2, i j; zero if curvature was known. Its
    /// information is in units of the image noise.
    glm::dvec3 curvature{0.0};
    glm::dvec3 curvature_information{0.0};
};

/// Refines the warp until the image matches the patch; nothing if it diverges or the texture does not match.
std::optional<Alignment> align(const PatchImage& image, const Patch& patch, const Warp& warp, bool curvature_is_known);

}  // namespace rs::capture
