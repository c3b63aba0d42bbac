#pragma once
// How different two colours look, and whether a colour can be the backdrop with a shadow on it.

#include "rayspace/image/image.hpp"

#include <cstdlib>

namespace rs::capture {

// Whether no channel's sRGB codes differ by more than `codes`.
inline bool within_codes(const Rgba8& a, const Rgba8& b, int codes) {
    return std::abs(a.r - b.r) <= codes && std::abs(a.g - b.g) <= codes && std::abs(a.b - b.b) <= codes;
}

struct LinearRgb {
    float r = 0, g = 0, b = 0;  // linear light, sRGB primaries
};

LinearRgb linear_rgb(const Rgba8& srgb);  // alpha is left aside

struct Lab {
    float l = 0, a = 0, b = 0;  // CIE 1976 L*a*b*, white D65; l is 0..100
};
Lab lab_from_linear(const LinearRgb& colour);

// Of every pixel.
Image<Lab> lab_picture(ConstImageView<Rgba8> picture);
Image<Lab> lab_picture(ConstImageView<LinearRgb> picture);

// CIE 1976 colour difference; 2.3 is just noticeable.
float delta_e(const Lab& x, const Lab& y);

// Whether a backdrop has so much colour that the shaded grey parts of an object do not look like it in a shadow.
bool is_colourful(const LinearRgb& colour);
bool is_colourful(const Lab& colour);

// A colour both as light and as it looks.
struct KnownColour {
    LinearRgb light;
    Lab look;
    KnownColour(const LinearRgb& of_light, const Lab& of_look) : light(of_light), look(of_look) {}
    explicit KnownColour(const LinearRgb& of_light) : light(of_light), look(lab_from_linear(of_light)) {}
};

// How well `backdrop` explains `pixel`. A shadow multiplies the backdrop's linear light by one factor for all channels,
// so `shaded` is the difference to the multiple of the backdrop that fits best.
struct Explanation {
    float plain = 0;   // delta E to the backdrop as it is
    float shaded = 0;  // delta E to shade * backdrop
    float shade = 1;   // the factor, within the range given
};
Explanation explain_by_backdrop(const LinearRgb& pixel, const LinearRgb& backdrop, float min_shade, float max_shade);
// The same; `shaded` is not looked for and stays `plain` where plain is at most `enough_delta_e`.
Explanation explain_by_backdrop(const KnownColour& pixel, const KnownColour& backdrop, float min_shade, float max_shade,
                                float enough_delta_e);

// Whether both may be one surface, each in a light of its own: from a quarter to four times as bright.
bool alike_in_some_light(const LinearRgb& a, const LinearRgb& b);

}  // namespace rs::capture
