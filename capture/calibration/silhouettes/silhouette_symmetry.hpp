#pragma once
// Where the axis of a turn is, from the outlines of its views alone; nothing of the object's texture takes part.
//
// All views of a full turn together cover what the solid of revolution covers that the turning object sweeps through,
// and the image of such a solid is symmetrical about the image of its axis, whatever the object's shape. In the
// table frame (turntable_model.hpp) the symmetry is exact also in perspective: with u = x / -z and v = y / -z of a ray,
// the rims u_left(v) and u_right(v) of what is covered are opposite to each other. Half their sum is by how much the
// model's axis stands beside the true one. (The symmetry is the harmonic homology of Wong, Mendonca and Cipolla,
// "Camera calibration from surfaces of revolution", 2003.)
//
// Rows are averaged robustly: a wisp on one view's cut-out, or a shadow beside the foot, touches few of them. What
// outlines show of tilt, lens and angles is left to silhouettes.hpp; here it hardly matters.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace rs::capture {

// The most that any view covers, [pixel]. The images have one size; at least one.
Image<std::uint8_t> covered_together(std::span<const CalibrationImage> images);

// Where the axis is, by whatever means it was found.
struct AxisPlace {
    double at_px = 0;
    double position_px = 0;   // its axis_position there
    double deviation_px = 0;  // one standard deviation
};

// `covered`: of photographs reduced by `reduction`; `start`: in px of the photographs, near the truth (a few px, a
// degree), with the views' angles. Rows whose rim is cut off by the image's border do not count. The deviation holds
// the scatter over parts of the object's height, and what views with gaps between them can miss of a rim. Nothing where
// the views make no full turn (a gap above a tenth of it), or fewer than 40 rows are left. One thread; less than a
// second for 2 million pixels. Thread-safe.
std::optional<AxisPlace> axis_of_silhouettes(ConstImageView<std::uint8_t> covered, int reduction,
                                             const TurntableModel& start);

// Where the axis is when it is seen at one place by tracks and at another by outlines. Their deviations weigh them, but
// texture that glides alike around the whole object misleads tracks by more than they can know: by what they stand
// apart from the outlines beyond two of the outlines' deviations. `of_tracks` and `of_silhouettes` have one at_px.
AxisPlace agreed_axis(const AxisPlace& of_tracks, const AxisPlace& of_silhouettes);

// `model` with its axis there, by the camera's pan alone: lens, tilt, roll and angles stay. Nothing where the image
// of the axis cannot be brought there.
std::optional<TurntableModel> with_axis_at(TurntableModel model, const AxisPlace& place);

}  // namespace rs::capture
