#pragma once
// From a photograph to a picture of the object alone: object_mask, with grey_parts or
// enclosed_parts -> soft_edge -> unmix().

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/matte/object_mask.hpp"
#include "capture/photos/matte/soft_edge.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// The object's own colour where the photograph shows a mixture with the backdrop, and colours beyond the edge that a
// codec with coarse chroma may mix in without harm.

// How far beyond the edge colours are continued under alpha 0: one and a half blocks of a codec with 16x16 macroblocks.
inline constexpr int kBleed_px = 24;

// The cut-out: sRGB with straight alpha. Where alpha is fractional, F = (pixel - (1 - alpha) B) / alpha, which goes
// over into the object's colour near by as alpha nears 0 and the division loses its meaning.
Image<Rgba8> unmix(ConstImageView<Rgba8> photo, const SoftEdge& edge);

// Gives every pixel with alpha 0 the colour of the nearest pixel that is at least half covered, up to kBleed_px away,
// and black farther away. Other pixels keep their values exactly.
void bleed_colours(Image<Rgba8>& picture);

// Made once for a turn; cut() may be called from several threads.
class ObjectCutter {
public:
    // Photographs will be width x height; the plate is scaled to that. The size may exceed the plate's.
    ObjectCutter(const Backdrop& backdrop, int width, int height);

    // sRGB with straight alpha. With a backdrop of kind alpha, pixels with alpha above 0 come out exactly as they went
    // in.
    [[nodiscard]] Image<Rgba8> cut(ConstImageView<Rgba8> photo) const;

private:
    // 255 where the object is.
    [[nodiscard]] Image<std::uint8_t> mask_of(ConstImageView<Rgba8> photo) const;
    // The plate as bright as it is in this photograph; nothing where that is as it is.
    [[nodiscard]] std::optional<CleanPlateView> exposed_as(ConstImageView<Rgba8> photo) const;

    BackdropKind kind_;
    MaskOptions options_;
    CleanPlateView plate_;
    std::optional<Rgba8> flat_grey_;
    CleanPlateView flat_plate_;      // where that is known
    bool is_even_;                   // the plate is that of a studio
    Image<std::uint8_t> untouched_;  // of the plate; empty where nobody can tell
    int band_px_;
};

}  // namespace rs::capture
