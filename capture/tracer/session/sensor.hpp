#pragma once
// From light to what a camera stores: exposure, the sRGB curve, noise, eight bits.

#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::capture {

struct Sensor {
    double exposure = 1;     // factor on linear light
    double noise_codes = 0;  // standard deviation per channel, in 8-bit sRGB code values, the same for all brightnesses
    std::uint64_t seed = 1;  // of this image's noise
};

// `light` is linear and taken as opaque, whatever its alpha; what is above 1 is clipped, before the noise and after it.
// Alpha 255.
Image<Rgba8> expose(ConstImageView<RgbaF> light, const Sensor& sensor);

}  // namespace rs::capture
