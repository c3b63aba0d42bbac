#pragma once
// The still picture behind a turning object; what it is for: backdrop.hpp.

#include "rayspace/image.hpp"

#include <span>
#include <vector>

namespace rs::capture {

struct StillPicture {
    Image<Rgba8> colour;     // per pixel the mean of the largest group of samples that agree
    Image<float> agreement;  // the group's share of all samples, 0..1
};

// Samples agree where no channel of their sRGB codes differs by more than 14. All samples have one size; at least one.
StillPicture agree_over_time(std::span<const Image<Rgba8>> samples);

// Fills the pixels where `known` is 0 smoothly from the others (push-pull: averages of ever larger neighbourhoods). The
// picture is left as it is where nothing is known at all.
void fill_unknown(Image<Rgba8>& picture, const Image<std::uint8_t>& known);

}  // namespace rs::capture
