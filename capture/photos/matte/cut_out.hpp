#pragma once
// From a photograph to a picture of the object alone: object_mask -> soft_edge -> foreground_colour.

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "capture/photos/matte/object_mask.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// Made once for a turn; cut() may be called from several threads.
class ObjectCutter {
public:
    // Photographs will be width x height; the plate is scaled to that. The size may exceed the plate's.
    ObjectCutter(const Backdrop& backdrop, int width, int height);

    // sRGB with straight alpha. With a backdrop of kind alpha, pixels with alpha above 0 come out exactly as they went
    // in.
    [[nodiscard]] Image<Rgba8> cut(ConstImageView<Rgba8> photo) const;

private:
    // The plate as bright as it is in this photograph.
    [[nodiscard]] PlateView exposed_as(ConstImageView<Rgba8> photo) const;

    BackdropKind kind_;
    MaskOptions options_;
    PlateView plate_;
    Image<std::uint8_t> untouched_;  // of the plate; empty where nobody can tell
    int band_px_;
};

}  // namespace rs::capture
