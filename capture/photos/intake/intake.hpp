#pragma once
// The first stage of an import: the photographs that belong to the turn. Survey and repeat are behind it, the backdrop
// is found next.

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <string>
#include <vector>

namespace rs::capture {

struct Intake {
    PhotoFolder folder;          // without the repeat
    Survey survey;               // with it
    std::string dropped_repeat;  // name of the last photograph where it repeated the first; empty otherwise
    std::vector<std::string> notes;
};

// `folder` as open_photo_folder() gave it. Errors: those of survey_photos().
Result<Intake> take_in(PhotoFolder folder, Progress* progress);

}  // namespace rs::capture
