#include "capture/photos/intake/intake.hpp"

#include "capture/photos/intake/repeat.hpp"

#include <utility>

namespace rs::capture {

Result<Intake> take_in(PhotoFolder folder, Progress* progress) {
    Result<Survey> survey = survey_photos(folder, progress);
    if (!survey) return survey.error();
    Intake taken{std::move(folder), std::move(*survey), {}, {}};
    const std::vector<std::string>& ignored = taken.folder.ignored;
    if (!ignored.empty()) {
        taken.notes.push_back("left aside, not a picture: " + ignored.front() +
                              (ignored.size() > 1 ? " and " + std::to_string(ignored.size() - 1) + " more" : ""));
    }
    const PhotoFolder& of = taken.folder;
    if (of.otherwise_turned > 0) {
        taken.notes.push_back("the camera states " + std::to_string(of.otherwise_turned) + " of " +
                              std::to_string(of.photos.size()) +
                              " pictures turned otherwise than the rest; all are taken as most of them are, EXIF "
                              "orientation " +
                              std::to_string(of.orientation));
    }
    if (of.reduction > 1) {
        taken.notes.push_back("the photographs of " + size_text(of.shown_width, of.shown_height) + " are taken as " +
                              size_text(of.width, of.height) + "; --max-side PX keeps more of them, and takes longer");
    }
    if (test_repeat(taken.survey.thumbnails).last_repeats_first) {
        std::vector<std::filesystem::path>& photos = taken.folder.photos;
        taken.dropped_repeat = photos.back().filename().string();
        taken.notes.push_back(taken.dropped_repeat + " repeats " + photos.front().filename().string() +
                              " and is left out");
        photos.pop_back();
    }
    return taken;
}

}  // namespace rs::capture
