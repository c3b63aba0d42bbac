#pragma once
// Whether a bundle is to be believed, and what a photographer should know about the images.

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

// A view with fewer observations has no angle of its own.
inline constexpr int kFewestObservations = 6;

// An error where no rig should be made of these images: most observations disagree with any single turn, too many
// views stand apart, the angles make no turn, or the lens is left open. `candidates` are the observations of each view
// that were offered to the bundle, wrong matches among them.
Status accept(const Bundle& bundle, const ModelDeviations& deviations, std::span<const int> candidates,
              std::span<const std::string> names);

// Whether the observations before some view agree with the bundle about evenly, and those after it otherwise: the
// camera was moved there.
bool changes_at_one_moment(const Bundle& bundle, std::span<const int> candidates);

// One line each: steps that differ from the others, images that stand at the same angle, gaps.
std::vector<std::string> step_warnings(std::span<const double> angles_rad, const ModelDeviations& deviations,
                                       std::span<const std::string> names);

// One line each: blurred images, and images that do not fit.
std::vector<std::string> image_warnings(const Bundle& bundle, std::span<const int> candidates,
                                        std::span<const int> features, std::span<const std::string> names);

// That images were moved and scaled one by one, and by how much.
std::string place_warning(std::span<const ImagePlace> places);

// Where the texture turns about another axis than the outlines do, and further from it than both can be off: what may
// be the matter. Nothing where they agree to half a px of the images that were looked at.
std::optional<std::string> axis_warning(const AxisPlace& of_tracks, const AxisPlace& of_silhouettes, int reduction);

// Views that stand where an earlier one does, within a tenth of the median step: the turntable had not turned, or the
// turn goes on past its beginning.
std::vector<int> repeated_views(std::span<const double> angles_rad);

}  // namespace rs::capture
