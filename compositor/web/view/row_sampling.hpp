#pragma once
// Resamples an upright image for a tilted camera without roll. Each row of the tilted image is a horizontal line of the
// upright one, so that a row has three numbers. All arithmetic is in integers: resample() and the fragment shader of
// pages with WebGL give the same bytes.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rs::web {

/// Samples of a row: pixel i is at (x + i * step, y) of the upright image; texel centres are at whole numbers.
struct SampledRow {
    std::int32_t x_q16 = 0;
    std::int32_t step_q16 = 0;
    std::int32_t y_q8 = 0;
    std::int32_t unused = 0;  // texels of four numbers
};

/// Rows of an image of width x height pixels.
/// \param image_from_screen  homography of compositor::UprightImage
/// \return nullopt if a coordinate exceeds 32 bits, or the camera has roll
std::optional<std::vector<SampledRow>> sampled_rows(const glm::dmat3& image_from_screen, int width, int height);

/// Bilinear samples of an image with straight alpha, weighted by alpha; transparent outside.
/// \param rows  [to.height()]
void resample(ConstImageView<Rgba8> from, const std::vector<SampledRow>& rows, ImageView<Rgba8> to);

/// Fragment shader (GLSL ES 3.00) that draws a rendered view onto a canvas, with premultiplied alpha, upside down as
/// OpenGL stores images. It mixes the images of two rings (engine::mix_pixels()) and applies resample() where
/// `is_sampled` is 1. Uniforms: `image`, `second` (usampler2D), `weight` of the second image (q8; 0: it is not read),
/// `rows` (isampler2D, one column of SampledRow), `image_size` (ivec2), `height` of the canvas's view, `is_sampled`.
std::string present_shader();

}  // namespace rs::web
