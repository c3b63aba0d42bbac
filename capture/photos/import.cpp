#include "capture/photos/import.hpp"

#include "capture/photos/intake/photo_source.hpp"
#include "capture/photos/intake/video/frame_selection.hpp"
#include "capture/photos/segmentation/segmentation_checks.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

PhotoRequest photo_request(const ImportOptions& options) {
    const KnownInputs& known = options.known.known;
    const bool are_described = !options.segmentation.masks.empty() || !options.known.images.empty() ||
                               known.angles_rad || known.step_rad || known.equal_steps || options.degrees_per_view;
    return {options.photos, options.output, options.force, options.max_side_px, options.frames, are_described};
}

Status make_folder(const fs::path& folder, const fs::path& output) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) return Error{output.string() + ": cannot be written (" + failure.message() + "); check the disk"};
    return {};
}

// Collects the results of the stages before the set is written.
ImportReport report_of(const ImportOptions& options, const Intake& intake, const ChosenSegmenter& chosen,
                       SegmentedTurn& turn, FoundRig rig) {
    ImportReport report{std::move(rig)};
    report.notes.insert(report.notes.begin(), chosen.notes.begin(), chosen.notes.end());
    report.notes.insert(report.notes.begin(), intake.notes.begin(), intake.notes.end());
    report.folder = intake.folder;
    report.segmenter = chosen.kind;
    report.segmenter_reason = chosen.reason;
    report.background_share = chosen.background_share;
    report.backdrop = chosen.background;
    report.backdrop_colour = chosen.background_colour;
    report.backdrop_given = options.segmentation.background.kind.has_value();
    report.dropped_repeat = intake.dropped_repeat;
    const auto [least, most] = std::ranges::minmax(turn.coverage);
    report.min_coverage = least;
    report.max_coverage = most;
    report.small_foregrounds = std::move(turn.small);
    return report;
}

// Findings on a calibration whose deviations are too large for an orbit around the object.
std::vector<std::string> calibration_problems(const FoundRig& rig) {
    constexpr double kMaxResidual_px = 5;
    constexpr double kMaxFocalDeviation = 0.5;  // fraction of the focal length
    std::vector<std::string> problems;
    if (!rig.calibration.calibration) return problems;
    const Calibration& found = *rig.calibration.calibration;
    const std::string remedy =
        "; give --calibration nominal, --known, or photos with a printed board (rs-capture board)";
    if (found.rms_px > kMaxResidual_px) {
        problems.push_back("the calibration fits the photos to " + format_fixed(found.rms_px, 1) + " px only" + remedy);
    }
    if (found.deviations.f_px > kMaxFocalDeviation * found.model.lens.f_px) {
        problems.push_back("the focal length is uncertain by more than half of it" + remedy);
    }
    return problems;
}

// Reports problems as an error, or as notes with --force.
Status report_problems(const ImportOptions& options, const std::vector<std::string>& problems,
                       std::vector<std::string>& notes) {
    if (problems.empty()) return {};
    if (options.force) {
        notes.insert(notes.end(), problems.begin(), problems.end());
        return {};
    }
    std::string text;
    for (const std::string& problem : problems) text += options.photos.string() + ": " + problem + "\n";
    return Error{text + "nothing was written; --force writes the set all the same"};
}

// Rejects a turn with too few photos to estimate its rotation, unless the rig is nominal or known.
Status check_count(const PhotoFolder& folder, const ImportOptions& options) {
    constexpr std::size_t kFewest = 3;
    const std::size_t count = folder.photos.size();
    const bool is_told = options.calibration == CalibrationChoice::kNominal ||
                         (options.known.known.pose && options.known.known.angles_rad);
    if (count >= kFewest || is_told) return {};
    return Error{options.photos.string() + ": holds " + std::to_string(count) + (count == 1 ? " image" : " images") +
                 "; a turn needs at least 5, better 36. With --calibration nominal any number is accepted"};
}

Result<ImportReport> import_checked(const ImportOptions& options, Progress* progress) {
    RS_TRY(refuse_overwriting_inputs(options.output, {options.photos}));
    RS_ASSIGN_OR_RETURN(PhotoFolder folder, open_photos(photo_request(options), progress));
    if (!options.segmentation.masks.empty() && folder.has_ambiguous_orientation()) {
        return ambiguous_orientation_error(folder, "--masks " + options.segmentation.masks.string());
    }
    RS_TRY(check_count(folder, options));
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(options.output, "imported photos", options.force));
    const fs::path set = staged.temporary_path();
    const fs::path cut = set / "cut";
    for (const fs::path& inner : {cut, set / "images"}) {
        RS_TRY(make_folder(inner, options.output));
    }

    RS_ASSIGN_OR_RETURN(PreparedTurn prepared, prepare_turn(options, std::move(folder), cut, progress));
    auto& [intake, chosen, turn] = prepared;
    const ForegroundCache foregrounds(cut, intake.folder.width, intake.folder.height);
    RS_ASSIGN_OR_RETURN(FoundRig rig, find_rig(options, intake.folder, turn, foregrounds, progress));
    RS_TRY(report_problems(options, calibration_problems(rig), rig.notes));

    RS_ASSIGN_OR_RETURN(ImportReport report,
                        write_import_set(set, intake.folder, turn, foregrounds,
                                         report_of(options, intake, chosen, turn, std::move(rig)), progress));
    std::error_code failure;
    fs::remove_all(cut, failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    RS_TRY(staged.commit());
    return report;
}

}  // namespace

Status check_import_options(const ImportOptions& options) {
    if (options.fov_deg && !(*options.fov_deg >= 1 && *options.fov_deg <= 120)) {
        return Error{"--fov " + std::to_string(*options.fov_deg) +
                     ": give the horizontal field of view, 1 to 120 degrees"};
    }
    if (options.degrees_per_view && !(*options.degrees_per_view >= 0.01 && *options.degrees_per_view <= 180)) {
        return Error{"--degrees-per-view " + std::to_string(*options.degrees_per_view) + ": give 0.01 to 180 degrees"};
    }
    if (options.axis_x_px && !(std::abs(*options.axis_x_px) <= 10.0 * kMaxImageSide_px)) {
        return Error{"--axis-x " + std::to_string(*options.axis_x_px) + ": give a column of the images in px"};
    }
    if (options.max_side_px < kMinSide_px || options.max_side_px > kMaxImageSide_px) {
        return Error{"--max-side " + std::to_string(options.max_side_px) + ": give " + std::to_string(kMinSide_px) +
                     " to " + std::to_string(kMaxImageSide_px) + " px"};
    }
    if (options.frames && (*options.frames < kMinSelectedFrames || *options.frames > kMaxSelectedFrames)) {
        return Error{"--frames " + std::to_string(*options.frames) + ": give " + std::to_string(kMinSelectedFrames) +
                     " to " + std::to_string(kMaxSelectedFrames)};
    }
    return {};
}

Result<PreparedTurn> prepare_turn(const ImportOptions& options, PhotoFolder folder, const fs::path& cut,
                                  Progress* progress) {
    RS_ASSIGN_OR_RETURN(Intake intake, run_intake(std::move(folder), progress));

    RS_ASSIGN_OR_RETURN(ChosenSegmenter chosen,
                        choose_segmenter(options.segmentation, intake, options.photos.string(), progress));
    intake.survey = Survey{};  // frees memory; the survey is not needed any more

    const ForegroundCache foregrounds(cut, intake.folder.width, intake.folder.height);
    RS_ASSIGN_OR_RETURN(SegmentedTurn turn, segment_turn(intake.folder, *chosen.segmenter, foregrounds, progress,
                                                         options.segmentation.parameters.foreground));
    chosen.segmenter.reset();
    SegmentationFindings findings =
        check_segmentation(intake.folder, turn, chosen.kind, options.segmentation.parameters.checks);
    chosen.notes.insert(chosen.notes.end(), findings.notes.begin(), findings.notes.end());
    RS_TRY(report_problems(options, findings.problems, chosen.notes));
    return PreparedTurn{std::move(intake), std::move(chosen), std::move(turn)};
}

Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress) {
    RS_TRY(check_import_options(options));
    // Many photos are processed in parallel; OpenCV's own threads would only compete for the same cores.
    cv::setNumThreads(1);
    try {
        return import_checked(options, progress);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& escaped) {  // thrown by OpenCV
        return Error{options.photos.string() + ": the images cannot be processed (" + escaped.what() + ")"};
    }
}

}  // namespace rs::capture
