#pragma once
// Image prepared for extracting and aligning patches, filtered once: smoothed grey values with their gradients.

#include "capture/calibration/points/tracks.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::capture {

/// Patches are kPatchSide_px wide in the image that they are extracted from.
inline constexpr int kPatchSide_px = 15;
inline constexpr int kPatchHalf_px = kPatchSide_px / 2;

/// Rows of patches have one more column, which is always invalid: column c is patch pixel c - kPatchHalf_px.
inline constexpr std::size_t kPatchColumns = 16;
using PatchRow = std::array<float, kPatchColumns>;

/// Patch pixel (i, j), relative to the patch centre, maps to centre + matrix * (i, j) + bent(i, j), in px with pixel
/// centres at +0.5. The quadratic part `bent` models curved surfaces, and the slight effect of perspective on planes.
/// Without it, aligned positions would be biased systematically as the object turns, and the focal length with them.
struct Warp {
    glm::dvec2 centre{0.0};
    glm::dmat2 matrix{1.0};
    std::array<glm::dvec2, 3> bent{};  // coefficients of i^2 / 2, j^2 / 2, i j
    glm::dvec2 deeper{0.0};            // image motion per step of one px away from the patch's camera
};

/// Image samples along one row of a patch.
struct SeenRow {
    alignas(64) PatchRow value{};
    alignas(64) PatchRow slope_x{};  // grey values per px, central differences
    alignas(64) PatchRow slope_y{};
    alignas(64) PatchRow counts{};  // 1 on the object; 0 elsewhere, where the other values are 0, too
};

class PatchImage {
public:
    /// Smooths the image a little, so that gradients are significant above sensor noise and JPEG artefacts.
    explicit PatchImage(const CalibrationImage& image);

    /// True if the pixel is on the object (alpha above 250) and not within two px of the image border.
    [[nodiscard]] bool is_solid(const glm::dvec2& p) const;

    /// Row j of a patch, sampled bilinearly.
    [[nodiscard]] SeenRow row(const Warp& warp, int j) const;

private:
    struct alignas(16) Texel {
        float value = 0, slope_x = 0, slope_y = 0;
        float solid = 0;  // 1 or 0
    };
    int left_ = 0, top_ = 0;  // of texels_ within the image
    Image<Texel> texels_;     // bounding box of the solid pixels with a margin
};

}  // namespace rs::capture
