#pragma once
// Single angles from outlines alone. The few numbers of silhouette_fit.hpp suppose the angles that were assumed; of a
// body that is none of revolution outlines show each of them (coherence_fit.hpp).

#include "capture/calibration/model/calibration.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace rs::capture {

// How far assumed angles are off, one standard deviation of each.
inline constexpr double kAssumedAngle_deg = 3;

struct SilhouetteAngles {
    TurntableModel model;
    ModelDeviations deviations;
};

// `model`, found by the outlines under assumed angles, with `deviations`: angles, lens and directions together, each
// near where it was by what its deviation allows. Both in px of the photographs, of which `masks` are reduced copies.
// Numbers that `known` holds stay, the principal point and k2 do, too. Nothing where angles are known, where the
// outlines show little of them or come to no agreement, and where the object reaches the images' border. About 10 s
// for 36 views on 2 cores.
std::optional<SilhouetteAngles> angles_of_silhouettes(std::span<const Image<std::uint8_t>> masks,
                                                      const TurntableModel& model, const ModelDeviations& deviations,
                                                      const KnownInputs& known);

}  // namespace rs::capture
