#pragma once
/// \file
/// First pass over the photos of a turn: downscaled copies and border statistics.
///
/// Repeat detection (intake.hpp) and background estimation work on them before any photo is segmented. The photos are
/// read again later, so that memory grows only by the copies.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

inline constexpr int kSampleSide_px = 1024;    ///< longer side of a sample, at most
inline constexpr int kThumbnailSide_px = 160;  ///< longer side of a thumbnail, at most
inline constexpr int kMaxSamples = 48;

/// Statistics of the outermost pixels of a photo, which the object seldom reaches.
struct Border {
    Rgba8 median;       ///< per channel
    bool flat = false;  ///< uniform colour without noise, see measure_border()
};

struct Survey {
    std::vector<Image<Rgba8>> thumbnails;    ///< [photo]
    std::vector<Image<Rgba8>> samples;       ///< of at most kMaxSamples photos, evenly spread over the turn
    std::vector<std::size_t> sample_photos;  ///< [sample] -> photo
    std::vector<Border> borders;             ///< [sample], of the full-size photo: downscaling removes noise
};

/// Upper median per channel, opaque. `colours` must not be empty.
Rgba8 median_colour(std::span<const Rgba8> colours);

/// Largest deviation from the median on a flat border, sRGB codes: JPEG compression of a uniform colour.
inline constexpr int kFlat_codes = 1;

/// A border is flat on renderings and on retouched or overexposed photos: at least 85 % of its pixels are within 10
/// codes of the median (the rest may be the object), and 97 % of these within kFlat_codes. For a dark median, up to
/// code 3: more than half of the pixels are dark, and all of these have code 0.
Border measure_border(ConstImageView<Rgba8> photo);

/// Reads every photo, several in parallel (bounded_work.hpp). Errors: the first photo that cannot be read; no further
/// ones are begun.
Result<Survey> survey_photos(const PhotoFolder& folder, Progress* progress);

}  // namespace rs::capture
