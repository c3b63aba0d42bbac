#pragma once
// Where an object throws its shadow: on what it stands on. Far above there is hardly any, and what looks like a shadow
// there is rather a grey side of the object.

#include "capture/photos/background/evened_samples.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// 255 in the rows above the highest one in which a quarter of the samples show a shadow, with a little between: what is
// darker than the plate and fades into it without an edge. `plate` has the samples' size and holds no shadow
// (even_plate.hpp). Empty where there is no shadow, or one without a soft edge.
Image<std::uint8_t> above_shadows(const EvenedSamples& samples, ConstImageView<Rgba8> plate);

}  // namespace rs::capture
