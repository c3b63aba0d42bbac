#pragma once
/// \file
/// The object's shadow on the floor as a layer of its own: black with a smooth opacity.

#include "capture/photos/segmentation/background_model_segmenter.hpp"
#include "capture/photos/segmentation/segmenter.hpp"

#include <memory>

namespace rs::capture {

/// Opacity 0..255 of a black layer that makes `background` (linear light, exposed like the photo) look like the photo
/// around the object: the share of the light that is missing. Smooth; continued below the object's edge; 0 where the
/// darkening is not connected to the object or below 3 %. All images have one size; `mask` is 255 on the object.
Image<std::uint8_t> estimate_shadow(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> background,
                                    ConstImageView<std::uint8_t> mask);

/// Adds the shadow layer to what another segmenter finds.
class ShadowKeepingSegmenter : public Segmenter {
public:
    ShadowKeepingSegmenter(std::shared_ptr<const Segmenter> segmenter,
                           std::shared_ptr<const BackgroundModelSegmenter> background);
    [[nodiscard]] std::string name() const override { return segmenter_->name(); }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;

private:
    std::shared_ptr<const Segmenter> segmenter_;
    std::shared_ptr<const BackgroundModelSegmenter> background_;
};

}  // namespace rs::capture
