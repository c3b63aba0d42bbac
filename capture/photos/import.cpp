#include "capture/photos/import.hpp"

#include "capture/photos/intake/film/frame_selection.hpp"
#include "capture/photos/intake/intake.hpp"
#include "capture/photos/intake/photo_source.hpp"
#include "capture/photos/report/import_set.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <system_error>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

Status check(const ImportOptions& options) {
    if (options.fov_deg && !(*options.fov_deg >= 1 && *options.fov_deg <= 120)) {
        return Error{"--fov " + std::to_string(*options.fov_deg) +
                     ": give the horizontal field of view, 1 to 120 degrees"};
    }
    if (options.degrees_per_view && !(*options.degrees_per_view >= 0.01 && *options.degrees_per_view <= 180)) {
        return Error{"--degrees-per-view " + std::to_string(*options.degrees_per_view) + ": give 0.01 to 180 degrees"};
    }
    if (options.axis_x_px && !(std::abs(*options.axis_x_px) <= 10.0 * kMaxPictureSide_px)) {
        return Error{"--axis-x " + std::to_string(*options.axis_x_px) + ": give a column of the pictures in px"};
    }
    if (options.max_side_px < kMinSide_px || options.max_side_px > kMaxPictureSide_px) {
        return Error{"--max-side " + std::to_string(options.max_side_px) + ": give " + std::to_string(kMinSide_px) +
                     " to " + std::to_string(kMaxPictureSide_px) + " px"};
    }
    if (options.frames && (*options.frames < kMinSelectedFrames || *options.frames > kMaxSelectedFrames)) {
        return Error{"--frames " + std::to_string(*options.frames) + ": give " + std::to_string(kMinSelectedFrames) +
                     " to " + std::to_string(kMaxSelectedFrames)};
    }
    return {};
}

PhotoRequest photo_request(const ImportOptions& options) {
    const KnownInputs& known = options.known.known;
    const bool are_described = !options.masks.empty() || !options.known.pictures.empty() || known.angles_rad ||
                               known.step_rad || known.equal_steps || options.degrees_per_view;
    return {options.photos, options.output, options.max_side_px, options.frames, are_described};
}

// A set that stands at `output` already is replaced whole: photographs inside it would be lost.
Status check_places(const ImportOptions& options) {
    std::error_code failure;
    const fs::path photos = fs::weakly_canonical(options.photos, failure);
    if (failure) return Error{options.photos.string() + ": cannot be followed (" + failure.message() + ")"};
    const fs::path output = fs::weakly_canonical(options.output, failure);
    if (failure) return Error{options.output.string() + ": cannot be followed (" + failure.message() + ")"};
    const auto [rest, inner] = std::mismatch(output.begin(), output.end(), photos.begin(), photos.end());
    if (rest != output.end()) return {};
    return Error{options.output.string() + ": " + (photos == output ? "is" : "contains") +
                 (is_film(options.photos) ? " the film " : " the folder of photographs ") + options.photos.string() +
                 ", which would be replaced; give another place with -o"};
}

Status make_folder(const fs::path& folder, const fs::path& output) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) return Error{output.string() + ": cannot be written (" + failure.message() + "); check the disk"};
    return {};
}

// All that the stages found, before the set is written.
ImportReport report_of(const ImportOptions& options, const Intake& intake, const Backdrop& backdrop, CutTurn& turn,
                       FoundRig rig) {
    ImportReport report{std::move(rig)};
    report.notes.insert(report.notes.begin(), turn.notes.begin(), turn.notes.end());
    report.notes.insert(report.notes.begin(), intake.notes.begin(), intake.notes.end());
    report.folder = intake.folder;
    report.backdrop = backdrop.kind;
    report.backdrop_colour = backdrop.colour;
    report.backdrop_given = options.backdrop.kind.has_value();
    report.masks_given = !options.masks.empty();
    report.dropped_repeat = intake.dropped_repeat;
    report.min_coverage = turn.min_coverage;
    report.max_coverage = turn.max_coverage;
    report.small_cut_outs = std::move(turn.small);
    return report;
}

// So few show no turn that could be told from the pictures.
Status check_count(const PhotoFolder& folder, const ImportOptions& options) {
    constexpr std::size_t kFewest = 3;
    const std::size_t count = folder.photos.size();
    const bool is_told = options.calibration == CalibrationChoice::kNominal ||
                         (options.known.known.pose && options.known.known.angles_rad);
    if (count >= kFewest || is_told) return {};
    return Error{options.photos.string() + ": holds " + std::to_string(count) +
                 (count == 1 ? " picture" : " pictures") +
                 "; a turn has 5 and more, better 36. With --calibration nominal what is there is taken for one"};
}

Result<ImportReport> import_checked(const ImportOptions& options, Progress* progress) {
    if (Status status = check_places(options); !status) return status.error();
    Result<PhotoFolder> folder = open_photos(photo_request(options), progress);
    if (!folder) return folder.error();
    if (!options.masks.empty() && folder->turns_unnoticed()) {
        return turned_beside(*folder, "--masks " + options.masks.string());
    }
    if (Status status = check_count(*folder, options); !status) return status.error();
    Result<StagedFolder> staged = StagedFolder::create(options.output, "imported photographs");
    if (!staged) return staged.error();
    const fs::path set = staged->temporary_path();
    const fs::path cut = set / "cut";
    for (const fs::path& inner : {cut, set / "images"}) {
        if (Status status = make_folder(inner, options.output); !status) return status.error();
    }

    Result<Intake> intake = take_in(std::move(*folder), progress);
    if (!intake) return intake.error();

    Result<Backdrop> backdrop =
        !options.masks.empty() ? Backdrop{} : find_backdrop(intake->survey, options.backdrop, options.photos.string());
    if (!backdrop) return backdrop.error();
    intake->survey = Survey{};  // not needed any more, and large

    const CutPictures cuts(cut, intake->folder.width, intake->folder.height);
    Result<CutTurn> turn = cut_turn(intake->folder, {*backdrop, options.masks}, cuts, progress);
    if (!turn) return turn.error();

    Result<FoundRig> rig = find_rig(options, intake->folder, *turn, cuts, progress);
    if (!rig) return rig.error();

    Result<ImportReport> report = write_import_set(
        set, intake->folder, *turn, cuts, report_of(options, *intake, *backdrop, *turn, std::move(*rig)), progress);
    if (!report) return report.error();
    std::error_code failure;
    fs::remove_all(cut, failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    if (Status status = staged->commit(); !status) return status.error();
    return report;
}

}  // namespace

Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress) {
    if (Status status = check(options); !status) return status.error();
    // Many pictures are worked on at a time; OpenCV's own threads would only wait for each other on the same cores.
    cv::setNumThreads(1);
    try {
        return import_checked(options, progress);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& escaped) {  // OpenCV
        return Error{options.photos.string() + ": the pictures cannot be processed (" + escaped.what() + ")"};
    }
}

}  // namespace rs::capture
