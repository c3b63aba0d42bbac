#pragma once
// The backdrop of drawn photographs, found as an import does.

#include "capture/photos/background/backdrop.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/image/image.hpp"

#include <utility>
#include <vector>

namespace rs::test {

inline Result<capture::Backdrop> backdrop_behind(std::vector<Image<Rgba8>> photos) {
    capture::Survey survey;
    for (const Image<Rgba8>& photo : photos) survey.borders.push_back(capture::border_of(photo));
    survey.samples = std::move(photos);
    return capture::find_backdrop(survey, {}, "drawn");
}

}  // namespace rs::test
