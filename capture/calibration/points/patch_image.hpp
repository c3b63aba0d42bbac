#pragma once
// An image made ready for patches to be cut from it and aligned to it, filtered once: smoothed grey with its slopes.

#include "capture/calibration/points/tracks.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::capture {

// Patches are kPatchSide_px wide in the image they are cut from.
inline constexpr int kPatchSide_px = 15;
inline constexpr int kPatchHalf_px = kPatchSide_px / 2;

// Rows of patches have one more column, which never counts: column c shows patch pixel c - kPatchHalf_px.
inline constexpr std::size_t kPatchColumns = 16;
using PatchRow = std::array<float, kPatchColumns>;

// Patch pixel (i, j), counted from the patch's middle, is seen at centre + matrix * (i, j) + bent(i, j), in px with
// pixel centres at +0.5. What is bent is the surface, and straight surfaces too, a little, by perspective. Without it
// what is found would move as the object turns, always the same way, and the focal length with it.
struct Warp {
    glm::dvec2 centre{0.0};
    glm::dmat2 matrix{1.0};
    std::array<glm::dvec2, 3> bent{};  // by i^2 / 2, j^2 / 2, i j
    glm::dvec2 deeper{0.0};  // how far what is seen moves by a step of one px away from the camera of the patch
};

// What an image shows along one row of a patch.
struct SeenRow {
    alignas(64) PatchRow value{};
    alignas(64) PatchRow slope_x{};  // grey values per px, by differences over two
    alignas(64) PatchRow slope_y{};
    alignas(64) PatchRow counts{};  // 1: on the object, else 0 and all else, too
};

class PatchImage {
public:
    // Smoothed a little, so that slopes mean something beside sensor noise and JPEG.
    explicit PatchImage(const CalibrationImage& image);

    // On the object (alpha above 250) and not within two px of the image's border.
    [[nodiscard]] bool is_solid(const glm::dvec2& p) const;

    // Row j of a patch, bilinear.
    [[nodiscard]] SeenRow row(const Warp& warp, int j) const;

private:
    struct alignas(16) Texel {
        float value = 0, slope_x = 0, slope_y = 0;
        float solid = 0;  // 1 or 0
    };
    int left_ = 0, top_ = 0;  // of texels_ in the image
    Image<Texel> texels_;     // around what is solid
};

}  // namespace rs::capture
