#pragma once
/// \file
/// Segmenter by background subtraction: compares every photo with the background model of the turn.
///
/// Background model -> per photo: exposure gain, foreground score, graph cut, clean-up (foreground_mask.hpp).

#include "capture/photos/background/background_model.hpp"
#include "capture/photos/foreground/foreground_mask.hpp"
#include "capture/photos/foreground/foreground_parameters.hpp"
#include "capture/photos/segmentation/segmenter.hpp"

#include <optional>

namespace rs::capture {

class BackgroundModelSegmenter : public Segmenter {
public:
    /// `model` is scaled to the photos' size, width x height px, which may exceed the model's. Its kind is not alpha.
    /// `parameters`: the general ones; the variant for the model's kind is derived from them.
    BackgroundModelSegmenter(const BackgroundModel& model, int width, int height,
                             const ForegroundParameters& parameters = {});

    [[nodiscard]] std::string name() const override { return "background model"; }
    [[nodiscard]] Result<Segmentation> segment(const TurnPhoto& photo) const override;

    /// The same without errors: 255 = object.
    [[nodiscard]] Image<std::uint8_t> mask_of(ConstImageView<Rgba8> photo) const;

    /// The background behind the object, exposed like `photo`; linear light in the photo's size.
    [[nodiscard]] Image<LinearRgb> background_of(ConstImageView<Rgba8> photo) const;

private:
    /// The clean plate with the exposure of this photo; nullopt where that is the plate's own.
    [[nodiscard]] std::optional<CleanPlateView> exposed_like(ConstImageView<Rgba8> photo) const;

    ForegroundParameters general_;     // as given
    ForegroundParameters parameters_;  // the variant for the model
    CleanPlateView plate_;
    std::optional<Rgba8> flat_grey_;
    CleanPlateView flat_plate_;           // where flat_grey_ has a value
    bool has_gradient_;                   // the plate is a fitted background gradient
    Image<std::uint8_t> always_visible_;  // BackgroundModel::always_visible; empty if unknown
};

}  // namespace rs::capture
