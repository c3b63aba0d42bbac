#pragma once
// Estimates the axis of a turn from the silhouettes alone, without texture.
//
// The silhouettes of all views of a full turn together cover the image of the solid of revolution that the object
// sweeps, and the image of such a solid is symmetric about the image of its axis, whatever the object's shape. In the
// table frame (turntable_model.hpp) the symmetry is exact also in perspective: with u = x / -z and v = y / -z of a ray,
// the edges u_left(v) and u_right(v) of the covered region are opposite to each other. Half their sum is the offset of
// the true axis from the model's. (The symmetry is the harmonic homology of Wong, Mendonca and Cipolla, "Camera
// calibration from surfaces of revolution", 2003.)
//
// Rows are averaged robustly: a segmentation error in one view, or a shadow beside the base, affects few of them. Tilt,
// lens and angles are estimated from silhouettes by silhouettes.hpp; they hardly matter here.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace rs::capture {

/// Pixelwise maximum of the alpha of all views. The images have one size; at least one.
Image<std::uint8_t> union_of_alphas(std::span<const CalibrationImage> images);

/// Position of the axis in the image, by any method.
struct AxisPosition {
    double at_px = 0;         // row (column for a sideways axis)
    double position_px = 0;   // its axis_position() there
    double deviation_px = 0;  // one standard deviation
};

/// `covered`: alpha of photos reduced by `reduction`; `start`: in px of the photos, near the truth (a few px, a
/// degree), with the views' angles. Rows whose edge is cut off by the image border are ignored. The deviation includes
/// the scatter over parts of the object's height, and the part of an edge that views with gaps between them can miss.
/// Nothing if the views are not a full turn (a gap above a tenth of it), or fewer than 40 rows are left.
/// Single-threaded; less than a second for 2 million pixels. Thread-safe.
std::optional<AxisPosition> axis_from_silhouettes(ConstImageView<std::uint8_t> covered, int reduction,
                                                  const TurntableModel& start);

/// Combines the axis positions from tracks and from silhouettes, weighted by their deviations. Texture that moves
/// uniformly around the whole object biases tracks by more than their stated deviation; therefore theirs is increased
/// by the distance from the silhouettes' position beyond two of the silhouettes' deviations. Both arguments have the
/// same at_px.
AxisPosition combine_axes(const AxisPosition& of_tracks, const AxisPosition& of_silhouettes);

/// Moves the model's axis to `place` by the camera's pan alone: lens, tilt, roll and angles stay. Nothing if that is
/// not possible.
std::optional<TurntableModel> move_axis_to(TurntableModel model, const AxisPosition& place);

}  // namespace rs::capture
