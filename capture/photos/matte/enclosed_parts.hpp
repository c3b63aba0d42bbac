#pragma once
// White and grey objects before a grey that goes over from light to dark, as in studios. Their sides look as a shadow
// on that backdrop would, so colour tells nothing, and neither does contrast where it is faint for a few pixels. But a
// soft shadow fades into the plain backdrop, while an object has an edge all around: from the picture's border one
// reaches the shadow without crossing an edge, and nothing of the object.

#include "capture/photos/matte/object_mask.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// As find_object() does, and with it what edges enclose of the photograph against the plate, of its size, where three
// tenths of such a part differ from the plate; plain parts of a hundredth of the object count too, larger ones stay
// open. Empty where that is little beside the object, for a shadow in a loop is enclosed, too, and where noise makes
// edges everywhere. The plate must be right where the object hides it (even_plate.hpp); its `seen` is not read.
Image<std::uint8_t> find_object_by_edges(const SeenPhoto& photo, const CleanPlateView& plate,
                                         const MaskOptions& options);

}  // namespace rs::capture
