#pragma once
/// \file
/// Colour differences in CIELAB, and the shadow model of background subtraction.
///
/// Colours are sRGB codes (Rgba8), linear light with sRGB primaries (LinearRgb), or CIE 1976 L*a*b* with white D65
/// (Lab). Shadow model: a shadow multiplies the background's linear light by one factor common to all channels.

#include "rayspace/image/image.hpp"

#include <cstdlib>

namespace rs::capture {

/// True if no channel's sRGB codes differ by more than `codes`. Alpha is ignored.
inline bool within_codes(const Rgba8& a, const Rgba8& b, int codes) {
    return std::abs(a.r - b.r) <= codes && std::abs(a.g - b.g) <= codes && std::abs(a.b - b.b) <= codes;
}

/// Linear light, sRGB primaries, 1 = white.
struct LinearRgb {
    float r = 0, g = 0, b = 0;
};

/// Alpha is ignored.
LinearRgb linear_rgb(const Rgba8& srgb);

/// CIE 1976 L*a*b*, white D65; l is 0..100.
struct Lab {
    float l = 0, a = 0, b = 0;
};
Lab lab_from_linear(const LinearRgb& colour);

/// Converts every pixel.
Image<Lab> lab_image(ConstImageView<Rgba8> image);
Image<Lab> lab_image(ConstImageView<LinearRgb> image);

/// CIE 1976 colour difference; 2.3 is just noticeable.
float delta_e(const Lab& x, const Lab& y);

/// True if the chroma exceeds 15: shaded grey parts of an object are then distinguishable from shadows on a background
/// of this colour.
bool is_colourful(const LinearRgb& colour);
bool is_colourful(const Lab& colour);

/// A colour in linear light with its CIELAB value, converted once.
struct ColourSample {
    LinearRgb light;
    Lab lab;
    ColourSample(const LinearRgb& linear, const Lab& its_lab) : light(linear), lab(its_lab) {}
    explicit ColourSample(const LinearRgb& linear) : light(linear), lab(lab_from_linear(linear)) {}
};

/// Residuals of a pixel against the background, lit and in shadow.
struct ShadowFit {
    float plain = 0;   ///< delta E to the background as it is
    float shaded = 0;  ///< delta E to shade * background; at most `plain`
    float shade = 1;   ///< least-squares factor in linear light, clamped to the given range
};

/// Fits the shadow model to one pixel.
/// \param min_shade, max_shade range of the factor
ShadowFit fit_shadow(const LinearRgb& pixel, const LinearRgb& background, float min_shade, float max_shade);
/// The same with known CIELAB values. Where `plain` is at most `skip_delta_e`, `shaded` is not computed and equals
/// `plain`.
ShadowFit fit_shadow(const ColourSample& pixel, const ColourSample& background, float min_shade, float max_shade,
                     float skip_delta_e);

}  // namespace rs::capture
