#pragma once
// Camera sensor model: exposure, sRGB curve, noise, quantisation to eight bits.

#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::capture {

struct Sensor {
    double exposure = 1;     // factor on linear light
    double noise_codes = 0;  // standard deviation per channel in 8-bit sRGB codes, independent of brightness
    std::uint64_t seed = 1;  // of this image's noise
};

/// Converts linear light to an opaque image; ignores its alpha. Values above 1 are clipped before and after the noise.
Image<Rgba8> expose(ConstImageView<RgbaF> light, const Sensor& sensor);

}  // namespace rs::capture
