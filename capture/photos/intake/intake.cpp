#include "capture/photos/intake/intake.hpp"

#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace rs::capture {
namespace {

void note_ignored(const std::vector<std::string>& names, const std::string& why, std::vector<std::string>& notes) {
    if (names.empty()) return;
    notes.push_back("ignored, " + why + ": " + listed(names, 1));
}

}  // namespace

Result<Intake> run_intake(PhotoFolder folder, Progress* progress) {
    RS_ASSIGN_OR_RETURN(Survey survey, survey_photos(folder, progress));
    Intake taken{std::move(folder), std::move(survey), {}, {}};
    const PhotoFolder& of = taken.folder;
    taken.notes = of.selection_notes;
    note_ignored(of.ignored, "not an image", taken.notes);
    note_ignored(of.in_other_formats, "present in another format, too", taken.notes);
    const bool is_mixed = !of.own_orientations.empty();
    if (is_mixed)
        taken.notes.emplace_back("some images are stored on their side and some upright; all are rotated to upright");
    if (of.other_orientation_count > 0) {
        taken.notes.push_back("EXIF states another orientation for " + std::to_string(of.other_orientation_count) +
                              " of " + std::to_string(of.photos.size()) +
                              " images; the orientation of the majority is used for all" +
                              (is_mixed ? "" : ", EXIF orientation " + std::to_string(of.orientation)));
    }
    if (of.reduction > 1) {
        taken.notes.push_back("the photos of " + size_text(of.shown_width, of.shown_height) + " are reduced to " +
                              size_text(of.width, of.height) +
                              "; a larger --max-side PX keeps more detail, and takes longer");
    }
    if (detect_repeat(taken.survey.thumbnails).last_repeats_first) {
        std::vector<std::filesystem::path>& photos = taken.folder.photos;
        taken.dropped_repeat = photos.back().filename().string();
        taken.notes.push_back(taken.dropped_repeat + " repeats " + photos.front().filename().string() +
                              " and is left out");
        photos.pop_back();
    }
    return taken;
}

namespace {

constexpr double kMaxRatio = 0.4;

int on_black(std::uint8_t code, std::uint8_t alpha) {
    return code * alpha / 255;
}

}  // namespace

double mean_difference(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b) {
    RS_CHECK(a.width() == b.width() && a.height() == b.height());
    if (a.empty()) return 0;
    std::int64_t sum = 0;
    for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
            const Rgba8& p = a(x, y);
            const Rgba8& q = b(x, y);
            sum += std::abs(on_black(p.r, p.a) - on_black(q.r, q.a)) +
                   std::abs(on_black(p.g, p.a) - on_black(q.g, q.a)) +
                   std::abs(on_black(p.b, p.a) - on_black(q.b, q.a)) + std::abs(p.a - q.a);
        }
    }
    return static_cast<double>(sum) / (4.0 * a.width() * a.height());
}

RepeatDetection detect_repeat(std::span<const Image<Rgba8>> turn) {
    RepeatDetection result;
    if (turn.size() < 4) return result;
    const std::size_t last = turn.size() - 1;
    result.first_to_last = mean_difference(turn[0], turn[last]);
    result.neighbours = std::min(mean_difference(turn[0], turn[1]), mean_difference(turn[last - 1], turn[last]));
    result.last_repeats_first = result.first_to_last < kMaxRatio * result.neighbours;
    return result;
}

}  // namespace rs::capture
