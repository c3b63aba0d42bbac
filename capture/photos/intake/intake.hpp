#pragma once
/// \file
/// First stage of an import: surveys the photos of a folder and drops a repeat of the first one. Next:
/// choose_segmenter().

#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/survey.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

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

}  // namespace rs::capture
