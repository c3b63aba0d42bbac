#pragma once
// Estimates individual angles from silhouettes. silhouette_fit.hpp estimates only a few numbers under assumed angles;
// the silhouettes of a body that is not one of revolution determine each angle (coherence_fit.hpp).

#include "capture/calibration/model/calibration.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace rs::capture {

/// Error of assumed angles, one standard deviation of each.
inline constexpr double kAssumedAngle_deg = 3;

struct SilhouetteAngles {
    TurntableModel model;
    ModelDeviations deviations;
};

/// Refines `model`, fitted under assumed angles, with `deviations`: estimates angles, lens and orientation together,
/// each with its deviation as prior. Both in px of the photos, of which `masks` are reduced copies. Numbers in `known`,
/// the principal point and k2 are held constant. Nothing if angles are known, if the silhouettes hardly determine them
/// or are not consistent, or if the object touches the image border. About 10 s for 36 views on 2 cores.
std::optional<SilhouetteAngles> estimate_angles(std::span<const Image<std::uint8_t>> masks, const TurntableModel& model,
                                                const ModelDeviations& deviations, const KnownInputs& known);

}  // namespace rs::capture
