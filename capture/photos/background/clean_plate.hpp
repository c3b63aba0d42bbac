#pragma once
// The clean plate of a turn, put together: the region that the object sweeps is told from the rest (swept_region.hpp),
// then the plate grows from the rest inwards, and from what the rows show at both ends of the region
// (clean_plate_growth.hpp); in a room it grows across the edges of what stands there, too.

#include "capture/photos/background/evened_samples.hpp"
#include "capture/photos/background/still_picture.hpp"
#include "capture/photos/background/turntable_disc.hpp"
#include "rayspace/image/image.hpp"

#include <optional>

namespace rs::capture {

// All pictures have the samples' size; masks hold 255 or 0.
struct CleanPlate {
    Image<Rgba8> colour;            // means something where it is known
    Image<std::uint8_t> known;      // where pictures show it
    Image<std::uint8_t> untouched;  // where nothing ever covers it
    // Where the object always does, although nothing moves there; not what the plate around explains, fully lit or in
    // a shadow that hardly moves.
    Image<std::uint8_t> hidden;
    std::optional<TurntableDisc> disc;  // where one stands out
};

// What may stand behind the object: a studio's even backdrop, or a room.
enum class Behind { kStudio, kAnything };

// `still` is the samples' own; `motionless` is not 0 where they all agree, backdrop or not. At most 64 samples.
CleanPlate clean_plate_of_turn(const EvenedSamples& samples, const StillPicture& still,
                               ConstImageView<std::uint8_t> motionless, Behind behind = Behind::kAnything);

// Mean delta E between the samples and the plate, over those samples that show it, averaged over a neighbourhood; only
// where `known` is not 0 the plate is compared, elsewhere what is known near by holds, or 0.
Image<float> plate_noise(const EvenedSamples& samples, const Image<Rgba8>& plate, const Image<std::uint8_t>& known);

}  // namespace rs::capture
