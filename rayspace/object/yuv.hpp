#pragma once
// Conversion between YUV 4:2:0 with alpha and RGBA. rgba_from_yuva() is normative: engine/RECONSTRUCTION.md, section
// "Colour".

#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <algorithm>
#include <cstdint>

namespace rs {

/// BT.601 full range in 16-bit fixed point, rounded to nearest, clamped to 0..255. `alpha` 0 gives {0, 0, 0, 0}.
constexpr Rgba8 rgba_from_yuva(int y, int u, int v, int alpha) {
    if (alpha == 0) return {};
    const int base = (y << 16) + 32768;
    const auto clamp = [](int value) { return static_cast<std::uint8_t>(std::clamp(value >> 16, 0, 255)); };
    return {clamp(base + 91881 * (v - 128)), clamp(base - 22554 * (u - 128) - 46802 * (v - 128)),
            clamp(base + 116130 * (u - 128)), static_cast<std::uint8_t>(alpha)};
}

/// Pixel (column, row) of a stored image.
inline Rgba8 rgba_at(const PlanarImage& image, int column, int row) {
    const int shift = image.chroma_shift;
    return rgba_from_yuva(image.y(column, row), image.u(column >> shift, row >> shift),
                          image.v(column >> shift, row >> shift), image.a(column, row));
}

/// Converts to planes. Chroma is the alpha-weighted mean of its 2x2 pixels (128 if all are transparent), so that
/// colours outside of a silhouette do not tint its edge. Transparent pixels are stored with Y 0.
PlanarImage planar_from_rgba(ConstImageView<Rgba8> image);
Image<Rgba8> rgba_from_planar(const PlanarImage& image);

}  // namespace rs
