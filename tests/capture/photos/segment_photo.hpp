#pragma once
// Background model and foreground image of drawn photos, for tests.

#include "capture/photos/background/background_model.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "capture/photos/intake/survey.hpp"
#include "capture/photos/segmentation/foreground_image.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::test {

// Foreground image of one photo.
inline Image<Rgba8> segment_photo(const capture::Segmenter& segmenter, const Image<Rgba8>& photo) {
    return capture::make_foreground_image(photo, *segmenter.segment({0, photo.view()}));
}

// Background model of drawn photos, estimated as an import does, from frames reduced to at most `sample_side_px` on the
// longer side.
inline Result<capture::BackgroundModel> backdrop_behind(const std::vector<Image<Rgba8>>& photos,
                                                        int sample_side_px = capture::kSampleSide_px) {
    capture::Survey survey;
    for (const Image<Rgba8>& photo : photos) {
        survey.borders.push_back(capture::measure_border(photo));
        survey.samples.push_back(capture::reduced(photo, sample_side_px));
    }
    return capture::estimate_background(survey, {}, "drawn");
}

}  // namespace rs::test
