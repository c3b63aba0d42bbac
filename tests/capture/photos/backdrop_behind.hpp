#pragma once
// Background model of drawn photos, estimated as an import does, from frames reduced to at most `sample_side_px` on the
// longer side.

#include "capture/photos/background/background_model.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::test {

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
