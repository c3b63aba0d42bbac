#pragma once
/// \file
/// First stage of an import: surveys the photos of a folder and drops a repeat of the first one. Next:
/// choose_segmenter().

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <span>
#include <string>
#include <vector>

namespace rs::capture {

struct Intake {
    PhotoFolder folder;              ///< without the repeat
    Survey survey;                   ///< with it
    std::string dropped_repeat;      ///< name of the last photo if it repeats the first; else empty
    std::vector<std::string> notes;  ///< messages for the user
};

/// `folder`: as open_photo_folder() returns it. Errors: those of survey_photos().
Result<Intake> run_intake(PhotoFolder folder, Progress* progress);

/// Mean absolute difference of two images of one size, sRGB codes 0..255: RGB composited on black, alpha as a fourth
/// channel.
double mean_difference(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

/// Result of detect_repeat(). Many turntables stop at their first angle and capture it twice.
struct RepeatDetection {
    double first_to_last = 0;  ///< mean_difference() of the first and the last image
    double neighbours = 0;     ///< smaller mean_difference() of the first two and of the last two images
    bool last_repeats_first = false;
};

/// The last image repeats the first if their difference is less than 0.4 times the smaller difference of the neighbours
/// at the seam: a further step differs as much as the neighbours, a second shot of one pose only by noise. An object
/// that hardly changes, such as a plain vase, has ratios near 1 and is not reported. \param turn images in order, of
/// one size, downscaled to suppress noise; fewer than 4 are never a repeat
RepeatDetection detect_repeat(std::span<const Image<Rgba8>> turn);

}  // namespace rs::capture
