#pragma once
// Image<T> and its views (rayspace/api/types/image.hpp), with pixels of linear light.

#include "rayspace/api/types/image.hpp"

namespace rs {

/// Composites `front` over an opaque backdrop, both sRGB, without linearisation, as on screens; exact for alpha 0 and
/// 255.
constexpr Rgba8 over(const Rgba8& front, const Rgba8& backdrop) {
    const auto mix = [&](int f, int b) {
        return static_cast<std::uint8_t>((f * front.a + b * (255 - front.a) + 127) / 255);
    };
    return {mix(front.r, backdrop.r), mix(front.g, backdrop.g), mix(front.b, backdrop.b), 255};
}

/// One linear-light pixel with straight alpha.
struct RgbaF {
    float r = 0, g = 0, b = 0, a = 0;
    bool operator==(const RgbaF&) const = default;
};
static_assert(sizeof(RgbaF) == 16);

}  // namespace rs
