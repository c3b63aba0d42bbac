#pragma once
// Plausibility checks of a bundle, and warnings about the photos.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "capture/calibration/silhouettes/silhouette_symmetry.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Views with fewer observations have no reliable angle.
inline constexpr int kFewestObservations = 6;

/// Refuses images that do not determine a rig: most observations disagree with any single turn, too many views
/// disagree, the angles are not a turn, or the focal length is undetermined. `candidates`: number of observations of
/// each view given to the bundle, wrong matches included.
Status check_plausibility(const Bundle& bundle, const ModelDeviations& deviations, std::span<const int> candidates,
                          std::span<const std::string> names);

/// True if the observations before some view agree with the bundle about equally well, and those after it at another
/// level: the camera was moved there.
bool has_single_change(const Bundle& bundle, std::span<const int> candidates);

/// One line each: irregular steps, images at the same angle, gaps.
std::vector<std::string> step_warnings(std::span<const double> angles_rad, const ModelDeviations& deviations,
                                       std::span<const std::string> names);

/// One line each: blurred images, and images that do not fit.
std::vector<std::string> image_warnings(const Bundle& bundle, std::span<const int> candidates,
                                        std::span<const int> features, std::span<const std::string> names);

/// Reports that images were shifted and scaled individually, and by how much.
std::string place_warning(std::span<const ImagePlacement> places);

/// Warning if the axis of the texture and that of the silhouettes differ by more than their errors. Nothing if they
/// agree to half a px of the reduced images.
std::optional<std::string> axis_warning(const AxisPosition& of_tracks, const AxisPosition& of_silhouettes,
                                        int reduction);

/// Views at the angle of an earlier one, within a tenth of the median step: the turntable had not turned, or the turn
/// continues past its beginning.
std::vector<int> repeated_views(std::span<const double> angles_rad);

}  // namespace rs::capture
