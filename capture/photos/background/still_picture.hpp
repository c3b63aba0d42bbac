#pragma once
// The still picture behind a turning object; what it is for: backdrop.hpp.

#include "capture/photos/background/evened_samples.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

struct StillPicture {
    Image<Rgba8> colour;     // per pixel the mean of the largest group of samples that agree
    Image<float> agreement;  // the group's share of all samples, 0..1
};

// By how many codes samples of one still thing may differ.
inline constexpr int kAgreement_codes = 14;
inline bool samples_agree(const Rgba8& a, const Rgba8& b, int codes = kAgreement_codes) {
    return within_codes(a, b, codes);
}

StillPicture agree_over_time(const EvenedSamples& samples);

// Fills gaps between known pixels of a row, evenly from end to end, where both ends look like one surface, and makes
// them known: behind an object on a table most edges run across the picture (the table's, the wall's foot), so a row
// shows to the left and to the right what the object hides between.
void bridge_rows(Image<Rgba8>& picture, Image<std::uint8_t>& known);

// Fills the pixels where `known` is 0 smoothly from the others (push-pull: averages of ever larger neighbourhoods). The
// picture is left as it is where nothing is known at all.
void fill_unknown(Image<Rgba8>& picture, const Image<std::uint8_t>& known);

}  // namespace rs::capture
