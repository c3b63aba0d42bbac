#pragma once
/// \file
/// Foreground before a flat white or grey without noise, as of retouched product photos.
///
/// White objects before white, and grey ones before grey, differ from the background by a few codes, like a shadow. A
/// mask that allows for noise and shadows lacks their bodies. A second mask with thresholds of a few codes
/// (for_flat_grey()) contains them, but fills loops and takes shadows along where an object has colour. So the second
/// mask is added only where the first one lacks a large part of it.

#include "capture/photos/foreground/foreground_mask.hpp"
#include "capture/photos/foreground/foreground_parameters.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// The clean plate with the uniform colour `grey`, except where the plate is known to be static and clearly differs,
/// such as a shop's logo. \param always_visible 255 where nothing ever covers the background; of the plate's size
/// \param min_delta_e difference from which the plate's own colour is kept
CleanPlateView make_flat_plate(const CleanPlateView& plate, ConstImageView<std::uint8_t> always_visible,
                               const LinearRgb& grey, float min_delta_e);

/// Adds the second mask, of `flat`, to `mask` (255 = object) where `mask` lacks a large part of it. If the result still
/// explains hardly any of the pixels that differ from `flat`, adds a third mask that includes the object's shadow: no
/// pixel of such an object is distinguishable from a shadow.
/// \param flat as make_flat_plate() returns it
/// \param parameters the general ones, not a variant; for_flat_grey() is applied here
void add_flat_grey_foreground(Image<std::uint8_t>& mask, const LabPhoto& photo, const CleanPlateView& flat,
                              const ForegroundParameters& parameters);

}  // namespace rs::capture
