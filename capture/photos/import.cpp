#include "capture/photos/import.hpp"

#include "capture/calibration/silhouettes/turn_diagnosis.hpp"
#include "capture/photos/background/repeat.hpp"
#include "capture/photos/import_rig.hpp"
#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/survey.hpp"
#include "capture/photos/matte/cut_turn.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/pictures/picture_io.hpp"

#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <system_error>

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
    return {};
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
                 " the folder of photographs " + options.photos.string() +
                 ", which would be replaced; give another place with -o"};
}

Status make_folder(const fs::path& folder, const fs::path& output) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) return Error{output.string() + ": cannot be written (" + failure.message() + "); check the disk"};
    return {};
}

// What stands where another photograph does adds nothing but a place where two pictures disagree.
void leave_out_repeats(ImportReport& report) {
    for (const int view : repeated_views(report.calibration.calibration->model.angles_rad)) {
        report.left_out.push_back(report.source_names[static_cast<std::size_t>(view)]);
    }
    if (report.left_out.empty()) return;
    report.notes.push_back(report.left_out.front() +
                           (report.left_out.size() > 1
                                ? " and " + std::to_string(report.left_out.size() - 1) + " more repeat other pictures"
                                : " repeats another picture") +
                           " and " + (report.left_out.size() > 1 ? "are" : "is") + " left out of the set");
}

// Writes the upright pictures of all views that are not left out; what they cover together.
Result<TurnOutline::Box> rectify(const PhotoFolder& folder, const CutPictures& cuts, const fs::path& output,
                                 const ImportReport& report, Progress* progress) {
    std::vector<std::size_t> number(folder.photos.size(), 0);  // in the set
    std::vector<bool> is_left_out(folder.photos.size(), false);
    for (std::size_t i = 0, next = 0; i < folder.photos.size(); ++i) {
        is_left_out[i] =
            std::find(report.left_out.begin(), report.left_out.end(), report.source_names[i]) != report.left_out.end();
        number[i] = is_left_out[i] ? 0 : next++;
    }
    const Calibration& calibration = *report.calibration.calibration;
    TurnOutline outline(report.frame.lens.width, report.frame.lens.height);
    std::mutex mutex;
    const auto work = [&](std::size_t i) -> Status {
        if (is_left_out[i]) return {};
        const Result<Image<Rgba8>> picture = cuts.get(i);
        if (!picture) return picture.error();
        const Image<Rgba8> upright = rectified(calibration.model, report.frame, *picture,
                                               calibration.places.empty() ? PicturePlace{} : calibration.places[i]);
        if (Status status = write_png(output / cut_picture_name(number[i]), upright); !status) return status;
        TurnOutline own(upright.width(), upright.height());
        own.add(upright);
        const std::lock_guard lock(mutex);
        outline.merge(own);
        return {};
    };
    constexpr int kRectifyBytesPerPixel = kReadBytesPerPixel + 40;
    if (Status status = for_each_photo(folder, kRectifyBytesPerPixel, "rectifying", progress, work); !status) {
        return status.error();
    }
    return outline.visible();
}

Result<CalibrationRequest> calibration_request(const ImportOptions& options, const ImportReport& report) {
    Result<KnownInputs> of_photographs = known_of_photographs(options.known, report.source_names);
    if (!of_photographs) return of_photographs.error();
    CalibrationRequest request{options.calibration, std::move(*of_photographs), options.board, {}};
    KnownInputs& known = request.known;
    const double width = report.width;
    if (options.fov_deg) known.f_px = 0.5 * width / std::tan(0.5 * radians(*options.fov_deg));
    if (options.turning) known.counter_clockwise = *options.turning == Turning::kCounterClockwise;
    const double sense = report.nominal.turning == Turning::kCounterClockwise ? 1 : -1;
    if (options.degrees_per_view) known.step_rad = sense * radians(*options.degrees_per_view);

    TurntableModel& nominal = request.nominal;
    const double assumed_f_px = 0.5 * width / std::tan(0.5 * radians(kNominalFieldOfView_deg));
    nominal.lens =
        with_known(Lens{report.width, report.height, assumed_f_px, 0.5 * width, 0.5 * report.height, 0, 0}, known);
    nominal.pose.pan_rad = std::atan((nominal.lens.cx - report.nominal.axis_x_px) / nominal.lens.f_px);
    for (std::size_t i = 0; i < report.source_names.size(); ++i) {
        nominal.angles_rad.push_back(sense * static_cast<double>(i) * radians(report.nominal.step_deg));
    }
    return request;
}

Status finish_nominal(const ImportOptions& options, const PhotoFolder& folder, const CutTurn& turn,
                      const CutPictures& cuts, const fs::path& staged, ImportReport& report, Progress* progress) {
    report.notes.insert(report.notes.end(), report.nominal.notes.begin(), report.nominal.notes.end());
    const KnownInputs& known = options.known.known;
    if (known.f_px || known.pose || known.angles_rad) {
        report.notes.emplace_back(
            "a nominal rig takes nothing of what was given as known; --fov, --degrees-per-view and --axis-x set its "
            "numbers");
    }
    report.method = CalibrationMethod::kNominal;
    report.views = static_cast<int>(report.source_names.size());
    report.step_deg = report.nominal.step_deg;
    report.turning = report.nominal.turning;
    if (Status status = make_folder(staged / "images", options.output); !status) return status;
    const auto write = [&](std::size_t i) -> Status {
        const Result<Image<Rgba8>> picture = cuts.get(i);
        return picture ? write_png(staged / cut_picture_name(i), *picture) : Status(picture.error());
    };
    if (Status status = for_each_photo(folder, kReadBytesPerPixel, "writing the pictures", progress, write); !status) {
        return status;
    }
    const Rig rig = nominal_import_rig(options, report, turn.outline.visible());
    report.fl_px = rig.views.front().camera.fl_x;
    report.distance = glm::length(rig.views.front().camera.centre());
    return write_rig(staged / kRigFileName, rig);
}

// `boxes` of the photographs, as the still camera would have seen them.
std::vector<TurnOutline::Box> boxes_put_back(std::vector<TurnOutline::Box> boxes, const Calibration& calibration) {
    const Lens& lens = calibration.model.lens;
    const glm::dvec2 middle(lens.width / 2.0, lens.height / 2.0);
    for (std::size_t i = 0; i < calibration.places.size(); ++i) {
        TurnOutline::Box& box = boxes[i];
        if (box.empty()) continue;
        const glm::dvec2 low = glm::floor(calibration.places[i].undone({box.left, box.top}, middle));
        const glm::dvec2 high = glm::ceil(calibration.places[i].undone({box.right, box.bottom}, middle));
        box = {static_cast<int>(low.x), static_cast<int>(high.x), static_cast<int>(low.y), static_cast<int>(high.y)};
    }
    return boxes;
}

Status finish_calibrated(const ImportOptions& options, const PhotoFolder& folder, const CutTurn& turn,
                         const CutPictures& cuts, const fs::path& staged, ImportReport& report, Progress* progress) {
    const Calibration& calibration = *report.calibration.calibration;
    report.method = calibration.method;
    report.step_deg = std::abs(degrees(calibration.step_rad));
    report.turning = calibration.step_rad > 0 ? Turning::kCounterClockwise : Turning::kClockwise;
    report.notes.insert(report.notes.end(), calibration.warnings.begin(), calibration.warnings.end());
    leave_out_repeats(report);
    report.views = static_cast<int>(report.source_names.size() - report.left_out.size());
    const Result<UprightFrame> frame = plan_upright_frame(calibration.model, boxes_put_back(turn.boxes, calibration));
    if (!frame) return frame.error();
    report.frame = *frame;
    if (Status status = make_folder(staged / "images", options.output); !status) return status;
    const Result<TurnOutline::Box> visible = rectify(folder, cuts, staged, report, progress);
    if (!visible) return visible.error();
    const Rig rig = calibrated_import_rig(report, *visible);
    report.fl_px = rig.views.front().camera.fl_x;
    report.distance = glm::length(rig.views.front().camera.centre());
    return write_rig(staged / kRigFileName, rig);
}

Result<ImportReport> import_checked(const ImportOptions& options, Progress* progress) {
    Result<PhotoFolder> folder = open_photo_folder(options.photos);
    if (!folder) return folder.error();
    if (Status status = check_places(options); !status) return status.error();
    Result<StagedFolder> staged = StagedFolder::create(options.output);
    if (!staged) return staged.error();
    const fs::path cut = staged->temporary_path() / "cut";
    if (Status status = make_folder(cut, options.output); !status) return status.error();

    ImportReport report;
    report.width = folder->width;
    report.height = folder->height;
    if (!folder->ignored.empty()) {
        report.notes.push_back(
            "left aside, not a picture: " + folder->ignored.front() +
            (folder->ignored.size() > 1 ? " and " + std::to_string(folder->ignored.size() - 1) + " more" : ""));
    }
    Result<Survey> survey = survey_photos(*folder, progress);
    if (!survey) return survey.error();
    if (const RepeatTest repeat = test_repeat(survey->thumbnails); repeat.last_repeats_first) {
        report.dropped_repeat = folder->photos.back().filename().string();
        report.notes.push_back(report.dropped_repeat + " repeats " + folder->photos.front().filename().string() +
                               " and is left out");
        folder->photos.pop_back();
    }
    for (const fs::path& photo : folder->photos) report.source_names.push_back(photo.filename().string());

    Backdrop backdrop;
    report.masks_given = !options.masks.empty();
    if (!report.masks_given) {
        Result<Backdrop> found = find_backdrop(*survey, options.backdrop, options.photos.string());
        if (!found) return found.error();
        backdrop = std::move(*found);
    }
    report.backdrop = backdrop.kind;
    report.backdrop_colour = backdrop.colour;
    report.backdrop_given = options.backdrop.kind.has_value();
    survey = Survey{};  // the samples are not needed any more

    const CutPictures cuts(cut, folder->width, folder->height);
    Result<CutTurn> turn = cut_turn(*folder, {backdrop, options.masks}, cuts, progress);
    if (!turn) return turn.error();
    report.min_coverage = turn->min_coverage;
    report.max_coverage = turn->max_coverage;
    if (turn->at_border > 0) {
        report.notes.push_back("the object reaches the picture's border in " + std::to_string(turn->at_border) +
                               " of " + std::to_string(folder->photos.size()) +
                               " pictures; it will look cut off there");
    }
    report.nominal = find_nominal_turn({options.degrees_per_view, options.axis_x_px, options.turning}, *folder, *turn);
    const Result<CalibrationRequest> request = calibration_request(options, report);
    if (!request) return request.error();
    Result<PhotoCalibration> calibration = calibrate_photos(*folder, cuts, *request, progress);
    if (!calibration) return calibration.error();
    report.calibration = std::move(*calibration);
    report.notes.insert(report.notes.end(), report.calibration.notes.begin(), report.calibration.notes.end());

    Status finished = report.calibration.calibration
                          ? finish_calibrated(options, *folder, *turn, cuts, staged->temporary_path(), report, progress)
                          : finish_nominal(options, *folder, *turn, cuts, staged->temporary_path(), report, progress);
    if (!finished) return finished.error();
    report.small_cut_outs = std::move(turn->small);
    std::error_code failure;
    fs::remove_all(cut, failure);
    if (failure) return Error{options.output.string() + ": cannot be written (" + failure.message() + ")"};
    if (Status status = staged->commit(); !status) return status.error();
    return report;
}

}  // namespace

std::string to_string(Turning turning) {
    return turning == Turning::kClockwise ? "clockwise" : "counter-clockwise";
}

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
