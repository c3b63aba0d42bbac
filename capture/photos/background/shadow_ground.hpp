#pragma once
// Where an object throws its shadow: on what it stands on. Far above there is hardly any, and what looks like a shadow
// there is rather a grey side of the object.

#include "capture/photos/background/evened_samples.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// 255 in the rows above the highest one in which a quarter of the samples show a shadow, with a little between: what is
// darker than the plate and fades into it without an edge. `plate` has the samples' size and is even (even_plate.hpp).
// Empty where no shadow has a soft edge; all 0 where there is one at the very top. A shadow that fewer samples show,
// and one with sharp edges alone, is not seen.
Image<std::uint8_t> above_shadows(const EvenedSamples& samples, ConstImageView<Rgba8> plate);

}  // namespace rs::capture
