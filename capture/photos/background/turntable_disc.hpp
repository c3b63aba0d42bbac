#pragma once
// The top of the turntable, as the plate shows it around the object: a disc that is symmetric about the axis, so what
// the object hides of it looks like what is seen elsewhere on the same circle.

#include "rayspace/image/image.hpp"

#include <optional>

namespace rs::capture {

// Circles about the axis in the plane of the disc, as a camera of the nominal focal length sees them. Lengths on the
// plane are in units of the camera's height above it.
struct TurntableDisc {
    double f_px = 0;      // assumed; the tilt makes up for what it is off
    double tilt_rad = 0;  // the camera looks down by this
    double roll_rad = 0;  // the camera is turned by this about its line of sight
    double centre_x = 0;  // where the axis meets the disc, px from the picture's left and top border
    double centre_y = 0;
    double radius = 0;  // of the disc
};

// The disc whose rim stands out best against what surrounds it, of those whose centre lies within the columns and rows
// of `object` (not 0 where the object is ever seen) or little below it. `known` is 255 where the plate is known.
// Nothing where no rim stands out along most of what is known of its circle.
std::optional<TurntableDisc> find_turntable_disc(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known,
                                                 ConstImageView<std::uint8_t> object);

}  // namespace rs::capture
