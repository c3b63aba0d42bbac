#pragma once
// One quick look at all pictures of a turn: small copies, from which the repeat of the first picture and the backdrop
// are judged before any picture is cut out. The pictures themselves are not kept but read again later, so the memory
// needed does not grow with their number, but for the small copies.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

// Samples are at most this large, thumbnails at most kThumbnailSide_px.
inline constexpr int kSampleSide_px = 1024;
inline constexpr int kThumbnailSide_px = 160;
inline constexpr int kMaxSamples = 48;

// The outermost pixels of a photograph, which the object seldom reaches.
struct Border {
    Rgba8 median;       // per channel
    bool flat = false;  // shows a backdrop of one colour, as border_of() finds
};

struct Survey {
    std::vector<Image<Rgba8>> thumbnails;    // [photo]
    std::vector<Image<Rgba8>> samples;       // of at most kMaxSamples photos, evenly spread over the turn
    std::vector<std::size_t> sample_photos;  // [sample] -> photo
    std::vector<Border> borders;  // [sample]: of the photograph itself, as noise averages out in small copies
};

// The upper median of every channel by itself, opaque; of at least one.
Rgba8 median_colour(std::span<const Rgba8> colours);

// A border is flat where renderings, retouched and overexposed pictures show a backdrop without noise: but for a few of
// the object its pixels are within 10 codes of the median, and nearly all of these within kFlat_codes, as JPEG files
// leave of a single colour; but of a dark median (up to code 3) most pixels are dark, and all of these are black to the
// code.
inline constexpr int kFlat_codes = 1;
Border border_of(ConstImageView<Rgba8> picture);

// Reads every picture; after one that cannot be read no further one is begun. Works side by side (bounded_work.hpp).
Result<Survey> survey_photos(const PhotoFolder& folder, Progress* progress);

}  // namespace rs::capture
