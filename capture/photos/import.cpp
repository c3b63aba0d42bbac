#include "capture/photos/import.hpp"

#include "capture/photos/cut_turn.hpp"
#include "capture/photos/photo_folder.hpp"
#include "capture/photos/repeat.hpp"
#include "capture/photos/survey.hpp"
#include "capture/photos/turning.hpp"
#include "rayspace/conventions.hpp"
#include "rayspace/file_output.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <system_error>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr double kDoubtfulSpread = 0.01;  // of the picture's width

Status check(const ImportOptions& options) {
    if (!(options.fov_deg >= 1 && options.fov_deg <= 120)) {
        return Error{"--fov " + std::to_string(options.fov_deg) +
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

void find_axis(const ImportOptions& options, const PhotoFolder& folder, const CutTurn& turn, bool closed,
               ImportReport& report) {
    report.axis_x_px = folder.width / 2.0;
    report.axis_from = "picture middle";
    if (options.axis_x_px) {
        report.axis_x_px = *options.axis_x_px;
        report.axis_from = "given";
        return;
    }
    const auto axis = turn.outline.axis();
    if (!closed || !axis) {
        report.notes.push_back(std::string("the axis cannot be found ") +
                               (closed ? "(the object reaches the picture's sides)" : "from less than a full turn") +
                               "; the picture's middle is taken, --axis-x PX sets it");
        return;
    }
    report.axis_x_px = axis->x_px;
    report.axis_spread_px = axis->spread_px;
    report.axis_from = "silhouettes";
    if (axis->spread_px > kDoubtfulSpread * folder.width) {
        report.notes.push_back("the axis column is doubtful: the rows differ by " +
                               std::to_string(std::lround(axis->spread_px)) +
                               " px (camera not level, or steps uneven); --axis-x PX sets it");
    }
}

void find_turning_sense(const ImportOptions& options, const PhotoFolder& folder, const CutTurn& turn, bool closed,
                        ImportReport& report) {
    report.turning_from = "assumed";
    if (options.turning) {
        report.turning = *options.turning;
        report.turning_from = "given";
        return;
    }
    const double scale = static_cast<double>(turn.small.front().width()) / folder.width;
    const TurnOutline::Box box = turn.outline.visible();
    const double extent_px = std::max(report.axis_x_px - box.left, box.right - report.axis_x_px);
    const TurningEvidence evidence =
        find_turning(turn.small, report.axis_x_px * scale, extent_px * scale, radians(report.step_deg), closed);
    if (evidence.turning) {
        report.turning = *evidence.turning;
        report.turning_from = "pictures";
    } else {
        report.notes.push_back(
            "which way the object turns is not clear from the pictures; clockwise as seen from above is "
            "assumed, --counter-clockwise says otherwise");
    }
}

// JSON takes UTF-8 only; file names may hold any bytes.
std::string utf8(const std::string& name) {
    return nlohmann::json::parse(nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

Rig make_rig(const ImportOptions& options, const PhotoFolder& folder, const ImportReport& report,
             const TurnOutline::Box& visible) {
    NominalRigOptions nominal;
    nominal.width = folder.width;
    nominal.height = folder.height;
    nominal.views = report.views;
    nominal.fov_deg = options.fov_deg;
    nominal.step_deg = report.step_deg;
    nominal.axis_x_px = report.axis_x_px;
    nominal.turning = report.turning;
    Rig rig = make_nominal_rig(nominal, visible);
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        rig.views[i].file_path = cut_picture_name(i);
        rig.views[i].extras["source_file"] = utf8(folder.photos[i].filename().string());
    }
    rig.extras["axis_note"] = "Y is the turntable's axis; it appears in the column cx (" + report.axis_from + ")";
    const Rgba8& colour = report.backdrop_colour;
    nlohmann::json& made = rig.extras["photo_import"];
    made["calibration"] = "nominal: equal steps, level camera, assumed field of view";
    made["backdrop"] = to_string(report.backdrop);
    made["backdrop_from"] = report.backdrop_given ? "given" : "pictures";
    if (report.backdrop != BackdropKind::kAlpha) made["backdrop_srgb"] = {colour.r, colour.g, colour.b};
    made["axis_column_px"] = report.axis_x_px;
    made["axis_from"] = report.axis_from;
    made["turning"] = to_string(report.turning);
    made["turning_from"] = report.turning_from;
    made["degrees_per_view"] = report.step_deg;
    made["field_of_view_deg"] = options.fov_deg;
    if (!report.dropped_repeat.empty()) made["dropped_repeat"] = utf8(report.dropped_repeat);
    return rig;
}

Result<ImportReport> import_checked(const ImportOptions& options, Progress* progress) {
    Result<PhotoFolder> folder = open_photo_folder(options.photos);
    if (!folder) return folder.error();
    if (Status status = check_places(options); !status) return status.error();
    Result<StagedFolder> staged = StagedFolder::create(options.output);
    if (!staged) return staged.error();
    std::error_code failure;
    fs::create_directory(staged->temporary_path() / "images", failure);
    if (failure)
        return Error{options.output.string() + ": cannot be written (" + failure.message() + "); check the disk"};

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
    const std::size_t views = folder->photos.size();
    report.views = static_cast<int>(views);
    report.step_deg = options.degrees_per_view.value_or(360.0 / static_cast<double>(views));
    const bool closed =
        std::abs(report.step_deg * static_cast<double>(views) - 360) < 1.5 * report.step_deg && views >= 4;

    const Result<Backdrop> backdrop = find_backdrop(*survey, options.backdrop, options.photos.string());
    if (!backdrop) return backdrop.error();
    report.backdrop = backdrop->kind;
    report.backdrop_colour = backdrop->colour;
    report.backdrop_given = options.backdrop.kind.has_value();
    survey = Survey{};  // the samples are not needed any more

    const Result<CutTurn> turn = cut_turn(*folder, *backdrop, staged->temporary_path(), progress);
    if (!turn) return turn.error();
    report.min_coverage = turn->min_coverage;
    report.max_coverage = turn->max_coverage;
    if (turn->at_border > 0) {
        report.notes.push_back("the object reaches the picture's border in " + std::to_string(turn->at_border) +
                               " of " + std::to_string(views) + " pictures; it will look cut off there");
    }
    find_axis(options, *folder, *turn, closed, report);
    const TurnOutline::Box visible = turn->outline.visible();
    find_turning_sense(options, *folder, *turn, closed, report);

    const Rig rig = make_rig(options, *folder, report, visible);
    report.fl_px = rig.views.front().camera.fl_x;
    report.distance = glm::length(rig.views.front().camera.centre());
    if (Status status = write_rig(staged->temporary_path() / kRigFileName, rig); !status) return status.error();
    if (Status status = staged->commit(); !status) return status.error();
    return report;
}

}  // namespace

std::string to_string(Turning turning) {
    return turning == Turning::kClockwise ? "clockwise" : "counter-clockwise";
}

Result<ImportReport> import_photos(const ImportOptions& options, Progress* progress) {
    if (Status status = check(options); !status) return status.error();
    try {
        return import_checked(options, progress);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& escaped) {  // OpenCV
        return Error{options.photos.string() + ": the pictures cannot be processed (" + escaped.what() + ")"};
    }
}

}  // namespace rs::capture
