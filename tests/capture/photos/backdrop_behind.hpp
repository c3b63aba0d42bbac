#pragma once
// The backdrop of drawn photographs, found as an import does: of small copies where they are larger than
// `sample_side_px`.

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/intake/reduction.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/image/image.hpp"

#include <vector>

namespace rs::test {

inline Result<capture::Backdrop> backdrop_behind(const std::vector<Image<Rgba8>>& photos,
                                                 int sample_side_px = capture::kSampleSide_px) {
    capture::Survey survey;
    for (const Image<Rgba8>& photo : photos) {
        survey.borders.push_back(capture::border_of(photo));
        survey.samples.push_back(capture::reduced(photo, sample_side_px));
    }
    return capture::find_backdrop(survey, {}, "drawn");
}

}  // namespace rs::test
