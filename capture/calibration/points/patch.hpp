#pragma once
// A patch of texture around a point and its alignment to another picture: Lucas and Kanade 1981, with a warp that is
// affine but for a known quadratic part, a gain, and light that changes linearly over the patch.

#include "capture/calibration/points/tracks.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace rs::capture {

// Patches are kPatchSide_px wide in the picture they are cut from.
inline constexpr int kPatchSide_px = 15;
inline constexpr int kPatchHalf_px = kPatchSide_px / 2;
inline constexpr std::size_t kPatchSamples = static_cast<std::size_t>(kPatchSide_px) * kPatchSide_px;

// How curved a surface is that nothing is known about, 1/px: radii of 50 px.
inline constexpr double kTypicalCurvature = 0.02;

// Grey values, row by row.
struct Patch {
    std::array<float, kPatchSamples> value;
    std::array<bool, kPatchSamples> counts;  // on the object
};

// Patch pixel (i, j), counted from the patch's middle, is seen at centre + matrix * (i, j) + bent(i, j), in px with
// pixel centres at +0.5. What is bent is the surface, and straight surfaces too, a little, by perspective. Without it
// what is found would move as the object turns, always the same way, and the focal length with it.
struct Warp {
    glm::dvec2 centre{0.0};
    glm::dmat2 matrix{1.0};
    std::array<glm::dvec2, 3> bent{};  // by i^2 / 2, j^2 / 2, i j
    glm::dvec2 deeper{0.0};  // how far what is seen moves by a step of one px away from the camera of the patch
    [[nodiscard]] glm::dvec2 at(int i, int j) const {
        return centre + matrix * glm::dvec2(i, j) + bent[0] * (0.5 * i * i) + bent[1] * (0.5 * j * j) +
               bent[2] * static_cast<double>(i * j);
    }
};

// Grey as patches are cut from: smoothed a little, so that slopes mean something beside sensor noise and JPEG.
Image<float> smoothed(const Image<std::uint8_t>& grey);

// The patch around a place of a smoothed picture, levelled: less the plane that fits its values best. Nothing where too
// little of it lies on the object or there is no texture.
std::optional<Patch> textured_patch(const Image<float>& picture, const Image<std::uint8_t>& alpha, glm::dvec2 centre);

struct Alignment {
    Observation seen;  // its view is left at 0
    glm::dmat2 matrix{1.0};
    // Beside what the warp began with, 1/px, by i^2 / 2, j^2 / 2, i j; zero where curvature was known. In units of the
    // picture's noise, the information it rests on.
    glm::dvec3 curvature{0.0};
    glm::dvec3 curvature_information{0.0};
};

// Moves the warp until the picture shows the patch; nothing where it runs away or the texture is not there.
std::optional<Alignment> align(const Image<float>& picture, const Image<std::uint8_t>& alpha, const Patch& patch,
                               Warp warp, bool curvature_is_known);

}  // namespace rs::capture
