#include "capture/tools/commands.hpp"

#include "capture/photos/import.hpp"
#include "capture/photos/intake/photo_folder.hpp"
#include "capture/photos/intake/photo_source.hpp"
#include "capture/photos/intake/video/frame_selection.hpp"
#include "capture/photos/report/import_report.hpp"
#include "capture/posed/cameras/camera_file.hpp"
#include "capture/posed/cameras/colmap_model.hpp"
#include "capture/tools/posed_options.hpp"
#include "capture/tools/turns_options.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr const char* kColmap = "colmap";  // value of --calibration

struct ImportCommandLine {
    ImportOptions import;
    std::vector<std::filesystem::path> photos;
    std::string backdrop = "auto";
    std::string segmenter = "auto";
    std::string shadow = "remove";
    std::string parameters;
    std::string board;
    std::string calibration = "auto";
    bool clockwise = false;
    bool counter_clockwise = false;
    std::string report;
    std::string known;
    bool equal_steps = false;
    bool principal_point = false;
    PosedCommandLine posed;
    bool json = false;
    bool quiet = false;

    [[nodiscard]] bool uses_colmap() const { return calibration == kColmap; }
};

const std::map<std::string, CalibrationChoice> kCalibrations{{"auto", CalibrationChoice::kAuto},
                                                             {"board", CalibrationChoice::kBoard},
                                                             {"tracks", CalibrationChoice::kTracks},
                                                             {"silhouettes", CalibrationChoice::kSilhouettes},
                                                             {"nominal", CalibrationChoice::kNominal}};

const std::map<std::string, SegmenterKind> kSegmenters{{"auto", SegmenterKind::kAuto},
                                                       {"alpha", SegmenterKind::kAlpha},
                                                       {"masks", SegmenterKind::kMasks},
                                                       {"chroma", SegmenterKind::kChromaKey},
                                                       {"background", SegmenterKind::kBackground},
                                                       {"model", SegmenterKind::kModel}};

std::string backdrop_text(const ImportReport& report) {
    if (report.segmenter == SegmenterKind::kMasks) return "masks";
    if (report.backdrop != BackgroundKind::kColour) return to_string(report.backdrop);
    const Rgba8& c = report.backdrop_colour;
    return std::to_string(c.r) + "," + std::to_string(c.g) + "," + std::to_string(c.b);
}

// Text of the background, such as " before white"; empty if none was estimated.
std::string background_text(const ImportReport& report) {
    return report.backdrop == BackgroundKind::kAlpha ? std::string() : " before " + backdrop_text(report);
}

nlohmann::json finite(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json calibration_json(const Calibration& calibration) {
    const Lens& lens = calibration.model.lens;
    const CameraPose& pose = calibration.model.pose;
    const ModelDeviations& off = calibration.deviations;
    const auto estimate = [](double value, double deviation) {
        return nlohmann::json{{"value", value}, {"deviation", finite(deviation)}};
    };
    nlohmann::json json;
    json["points"] = calibration.points;
    json["observations"] = calibration.observations;
    json["rms_px"] = calibration.rms_px;
    const std::optional<double>& held_out_px = calibration.held_out_rms_px;
    json["held_out_rms_px"] = held_out_px ? nlohmann::json(*held_out_px) : nlohmann::json();
    json["f_px"] = estimate(lens.f_px, off.f_px);
    json["cx"] = estimate(lens.cx, off.cx);
    json["cy"] = estimate(lens.cy, off.cy);
    json["k1"] = estimate(lens.k1, off.k1);
    json["k2"] = estimate(lens.k2, off.k2);
    json["pan_deg"] = degrees(pose.pan_rad);
    json["tilt_deg"] = estimate(degrees(pose.tilt_rad), degrees(off.tilt_rad));
    json["roll_deg"] = estimate(degrees(pose.roll_rad), degrees(off.roll_rad));
    json["axis_direction_deviation_deg"] = finite(degrees(off.axis_direction_rad));
    json["axis_position_deviation_px"] = finite(off.axis_position_px);
    const auto column = axis_column(lens, pose, 0.5 * lens.height);
    json["axis_column_px"] = column ? nlohmann::json(*column) : nlohmann::json();
    for (std::size_t i = 0; i < calibration.model.angles_rad.size(); ++i) {
        json["angles"].push_back(estimate(degrees(calibration.model.angles_rad[i]),
                                          i < off.angles_rad.size() ? degrees(off.angles_rad[i]) : 0));
    }
    return json;
}

void print_json(const std::string& output, const ImportReport& report) {
    nlohmann::json json;
    json["output"] = output;
    json["views"] = report.views;
    json["width"] = report.folder.width;
    json["height"] = report.folder.height;
    json["reduction"] = report.folder.reduction;
    const bool is_one = report.folder.own_orientations.empty();
    json["orientation"] = is_one ? nlohmann::json(report.folder.orientation) : nlohmann::json();
    json["photograph_width"] = report.folder.shown_width;
    json["photograph_height"] = report.folder.shown_height;
    json["backdrop"] = backdrop_text(report);
    const bool is_given = report.backdrop_given || report.segmenter == SegmenterKind::kMasks;
    json["backdrop_from"] = is_given ? "given" : "pictures";
    json["segmenter"] = {{"name", to_string(report.segmenter)},
                         {"reason", report.segmenter_reason},
                         {"background_share", report.background_share}};
    json["dropped_repeat"] = report.dropped_repeat;
    json["left_out"] = report.left_out;
    json["method"] = to_string(report.method);
    if (report.calibration.calibration) {
        json["calibration"] = calibration_json(*report.calibration.calibration);
    } else {
        json["axis_column_px"] = report.nominal.axis_x_px;
        json["axis_spread_px"] = report.nominal.axis_spread_px;
        json["axis_from"] = report.nominal.axis_from;
        json["field_of_view_deg"] = report.nominal.fov_deg;
        json["field_of_view_from"] = report.nominal.fov_from;
        json["turning_from"] = report.nominal.turning_from;
    }
    json["degrees_per_view"] = report.step_deg;
    json["turning"] = to_string(report.turning);
    json["fl_px"] = report.fl_px;
    json["distance_radii"] = report.distance;
    json["coverage"] = {report.min_coverage, report.max_coverage};
    json["notes"] = report.notes;
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    std::printf("%s\n", text.c_str());
}

std::string observations_text(const Calibration& found) {
    if (found.observations == 0) return {};
    std::string text = ", ";
    if (found.points > 0) text += std::to_string(found.points) + " points in ";
    text += std::to_string(found.observations) + " observations, " + format_fixed(found.rms_px, 2) + " px RMS";
    if (found.held_out_rms_px) text += " (" + format_fixed(*found.held_out_rms_px, 2) + " px held out)";
    return text;
}

void print_summary(const std::string& output, const ImportReport& report) {
    std::printf("%s: %d views of %s, segmented by %s%s, %.4g degrees per view %s, coverage %.1f..%.1f %%\n",
                output.c_str(), report.views, sizes_text(report.folder).c_str(), to_string(report.segmenter).c_str(),
                background_text(report).c_str(), report.step_deg, to_string(report.turning).c_str(),
                100 * report.min_coverage, 100 * report.max_coverage);
    if (!report.calibration.calibration) {
        std::printf(
            "calibration: nominal (equal steps, a level camera, %.3g degrees of field of view, %s); "
            "axis at column %.1f (%s), turning %s\n",
            report.nominal.fov_deg,
            report.nominal.fov_from == "camera" ? "as the camera states" : report.nominal.fov_from.c_str(),
            report.nominal.axis_x_px, report.nominal.axis_from.c_str(), report.nominal.turning_from.c_str());
        return;
    }
    const Calibration& found = *report.calibration.calibration;
    std::printf("calibration: %s%s\n", to_string(found.method).c_str(), observations_text(found).c_str());
    std::printf(
        "  focal length %.1f +- %.1f px, camera %.2f +- %.2f degrees above, axis direction +- %.3f degrees, "
        "position +- %.2f px\n",
        found.model.lens.f_px, found.deviations.f_px, degrees(found.model.pose.tilt_rad),
        degrees(found.deviations.tilt_rad), degrees(found.deviations.axis_direction_rad),
        found.deviations.axis_position_px);
}

// Rejects options for single photos if frames are selected during the import.
Status check_frames_usage(const ImportCommandLine& given) {
    const bool has_video = is_video(given.import.photos);
    if (!has_video && !given.import.frames) return {};
    const std::string remedy =
        has_video ? "cannot be used with a video; extract its frames first (ffmpeg -i FILM photos/%03d.png)"
                  : "needs all photos of the folder; leave out --frames";
    if (!given.known.empty()) return Error{"--known " + given.known + ": " + remedy};
    if (!given.import.segmentation.masks.empty())
        return Error{"--masks " + given.import.segmentation.masks.string() + ": " + remedy};
    if (given.equal_steps) return Error{"--equal-steps: " + remedy};
    if (given.import.degrees_per_view) return Error{"--degrees-per-view: " + remedy};
    return {};
}

// Names of the given options that posed photos do not have.
std::vector<std::string> turn_options(const ImportCommandLine& given) {
    const ImportOptions& import = given.import;
    const std::pair<const char*, bool> options[] = {
        {"--calibration", given.calibration != "auto" && !given.uses_colmap()},
        {"--board", !given.board.empty()},
        {"--equal-steps", given.equal_steps},
        {"--principal-point", given.principal_point},
        {"--fov", import.fov_deg.has_value()},
        {"--degrees-per-view", import.degrees_per_view.has_value()},
        {"--axis-x", import.axis_x_px.has_value()},
        {"--clockwise", given.clockwise},
        {"--counter-clockwise", given.counter_clockwise},
        {"--frames", import.frames.has_value()},
        {"--report", !given.report.empty()},
        {"--shadow", given.shadow != "remove"}};
    std::vector<std::string> names;
    for (const auto& [name, is_given] : options) {
        if (is_given) names.emplace_back(name);
    }
    return names;
}

// Names of the given options that several turns do not have.
std::vector<std::string> options_of_one_turn(const ImportCommandLine& given) {
    const ImportOptions& import = given.import;
    const std::pair<const char*, bool> options[] = {{"--calibration", given.calibration != "auto"},
                                                    {"--board", !given.board.empty()},
                                                    {"--known", !given.known.empty()},
                                                    {"--posed, --up, --camera-axes", given.posed.is_requested()},
                                                    {"--masks", !import.segmentation.masks.empty()},
                                                    {"--axis-x", import.axis_x_px.has_value()},
                                                    {"--frames", import.frames.has_value()},
                                                    {"--report", !given.report.empty()},
                                                    {"--shadow", given.shadow != "remove"}};
    std::vector<std::string> names;
    for (const auto& [name, is_given] : options) {
        if (is_given) names.emplace_back(name);
    }
    return names;
}

// Reads --known as values of one turn.
Result<KnownFile> read_known_turn(const ImportCommandLine& given) {
    RS_ASSIGN_OR_RETURN(const PhotoFolder folder, open_photo_folder(given.import.photos));
    return read_known_file(given.known, {folder.shown_width, folder.shown_height});
}

Status check_known_orientation(const ImportCommandLine& given) {
    const Result<PhotoFolder> folder = open_photo_folder(given.import.photos);
    if (!folder || (folder->orientation == 1 && !folder->has_several_orientations())) return {};
    return ambiguous_orientation_error(*folder, "--known " + given.known);
}

// True if --known has cameras anywhere: by request, as a COLMAP model, or because they fit no turn. Otherwise sets the
// known values of `options`.
Result<bool> has_posed_cameras(const ImportCommandLine& given, ImportOptions& options) {
    if (given.known.empty()) {
        if (!given.posed.is_requested()) return false;
        return Error{"--posed, --up and --camera-axes: need the photos' cameras; give --known"};
    }
    std::error_code ignored;
    const bool has_transforms =
        std::filesystem::exists(rig_file(given.known), ignored) && std::filesystem::is_directory(given.known, ignored);
    if (given.posed.is_requested() || (!has_transforms && find_colmap_model(given.known))) return true;
    Result<KnownFile> turn = read_known_turn(given);
    if (turn) {
        RS_TRY(check_known_orientation(given));
        options.known = std::move(turn).value();
        return false;
    }
    const Result<PosedModel> posed = read_camera_file(given.known);
    const std::vector<std::string> unused = turn_options(given);
    if (posed && unused.empty()) return true;  // EXIF orientation by the size of each camera
    RS_TRY(check_known_orientation(given));
    if (!posed) return is_opencv_intrinsics(given.known) ? turn.error() : posed.error();
    return Error{
        printable(listed(unused, unused.size()) +
                  ": only for photos of one turn; leave it out, or correct the cameras: " + turn.error().message)};
}

Status import_posed(const ImportCommandLine& given, const ImportOptions& options) {
    if (const auto unused = turn_options(given); !unused.empty()) {
        return Error{listed(unused, unused.size()) + ": only for photos of one turn, not for the posed photos of " +
                     (given.uses_colmap() ? std::string("--calibration colmap") : given.known) + "; leave it out"};
    }
    PosedImportOptions posed;
    posed.photos = options.photos;
    posed.cameras = given.known;
    posed.output = options.output;
    posed.segmentation = options.segmentation;
    posed.max_side_px = options.max_side_px;
    posed.force = options.force;
    if (given.uses_colmap()) return run_colmap_import(std::move(posed), given.posed, given.json, given.quiet);
    return run_posed_import(std::move(posed), given.posed, given.json, given.quiet);
}

// Rejects what --calibration colmap cannot be combined with.
Status check_colmap_usage(const ImportCommandLine& given) {
    if (!given.uses_colmap()) return {};
    const std::string option = "--calibration colmap: ";
    if (!given.known.empty()) return Error{option + "computes the cameras; leave out --known or this"};
    if (given.photos.size() > 1) return Error{option + "give one folder; it may have folders of photos"};
    if (is_video(given.import.photos)) {
        return Error{option + "needs photos; extract some frames of the film (ffmpeg -i FILM -r 2 photos/%03d.png)"};
    }
    return {};
}

Status run_import(const ImportCommandLine& given) {
    ImportOptions options = given.import;
    RS_TRY(check_colmap_usage(given));
    RS_TRY(check_frames_usage(given));
    RS_ASSIGN_OR_RETURN(const BackgroundRequest backdrop, parse_background(given.backdrop));
    options.segmentation.background = backdrop;
    options.segmentation.kind = kSegmenters.at(given.segmenter);
    options.segmentation.shadow = given.shadow == "keep" ? ShadowHandling::kKeep : ShadowHandling::kRemove;
    if (!given.parameters.empty()) {
        RS_ASSIGN_OR_RETURN(const SegmentationParameters parameters, read_segmentation_parameters(given.parameters));
        options.segmentation.parameters = parameters;
    }
    const bool takes_network =
        options.segmentation.kind == SegmenterKind::kAuto || options.segmentation.kind == SegmenterKind::kModel;
    if (!options.segmentation.network.empty() && (!takes_network || !options.segmentation.masks.empty())) {
        return Error{"--segmentation-model: has no effect with " +
                     (takes_network ? "--masks" : "--segmenter " + given.segmenter) + "; leave one of them out"};
    }
    if (const char* const file = std::getenv("RAYSPACE_SEGMENTATION_MODEL");
        options.segmentation.network.empty() && file != nullptr) {
        options.segmentation.network = file;
    }
    if (!given.uses_colmap()) options.calibration = kCalibrations.at(given.calibration);
    if (given.clockwise) options.turning = Turning::kClockwise;
    if (given.counter_clockwise) options.turning = Turning::kCounterClockwise;
    const std::vector<std::filesystem::path> inputs{options.photos, options.segmentation.masks,
                                                    options.segmentation.network, given.known, given.parameters};
    for (const std::filesystem::path& output : {options.output, std::filesystem::path(given.report)}) {
        if (Status kept = refuse_overwriting_inputs(output, inputs); !kept) return kept;
    }
    options.known.known.equal_steps = given.equal_steps;
    options.known.known.estimate_principal_point = given.principal_point;
    if (given.uses_colmap()) return import_posed(given, options);
    // Photos with known cameras may be in several folders, which are no turns.
    if (given.known.empty() || given.photos.size() > 1) {
        RS_ASSIGN_OR_RETURN(const std::vector<TurnSource> turns, several_turns(given.photos));
        if (!turns.empty()) {
            return run_turns_import(turns, options, options_of_one_turn(given), given.json, given.quiet);
        }
    }
    RS_ASSIGN_OR_RETURN(const bool is_posed, has_posed_cameras(given, options));
    if (is_posed) return import_posed(given, options);
    std::optional<StagedFile> page;  // created before the import, so that an unusable path is reported at once
    if (!given.report.empty()) {
        RS_ASSIGN_OR_RETURN(StagedFile created, StagedFile::create(given.report));
        page = std::move(created);
    }
    if (!given.board.empty()) {
        RS_ASSIGN_OR_RETURN(const BoardDesign board, parse_board_design(given.board));
        options.board = board;
    }
    ProgressBar bar(given.quiet);
    RS_ASSIGN_OR_RETURN(const ImportReport report, import_photos(options, &bar));
    if (page) {
        RS_ASSIGN_OR_RETURN(const std::string text, import_page(options.photos, report));
        RS_TRY(page->write(std::as_bytes(std::span(text))));
        RS_TRY(page->commit());
    }
    for (const std::string& note : report.notes) {
        if (!given.quiet) std::fprintf(stderr, "rs-capture: %s\n", printable(note).c_str());
    }
    const std::string output = options.output.string();
    if (given.json) {
        print_json(output, report);
    } else {
        print_summary(output, report);
    }
    return {};
}

// Photos, the set to write, and properties of the photos.
void add_photo_options(CLI::App& command, ImportCommandLine& given) {
    command
        .add_option("photos", given.photos,
                    "Folder of photos of one turn, in natural order of their names, or a video of the turning object. "
                    "Several turns at different heights: a folder each, or one folder with a folder each, or with "
                    "names of row and column")
        ->required();
    command.add_option("-o,--output", given.import.output, "Folder to write: transforms.json and images/")->required();
    command
        .add_option(
            "--backdrop", given.backdrop,
            "Background: auto, white, black, alpha (of the images) or R,G,B; auto tests for alpha, then the image "
            "borders")
        ->capture_default_str()
        ->check([](const std::string& text) {
            const Result<BackgroundRequest> parsed = parse_background(text);
            return parsed ? std::string() : parsed.error().message;
        });
    command
        .add_option(
            "--max-side", given.import.max_side_px,
            "Photos with a side longer than 1.25 times this, in px, are reduced to it first; other options refer "
            "to the original pixels")
        ->capture_default_str()
        ->check(CLI::Range(kMinSide_px, kMaxImageSide_px));
    command
        .add_option(
            "--frames", given.import.frames,
            "Number of frames of a video, or of photos of a larger folder, to select: sharp ones, evenly spaced by "
            "angle (default: 72 for a video, 120 for a folder of more than 150 photos, otherwise all)")
        ->check(CLI::Range(kMinSelectedFrames, kMaxSelectedFrames));
}

// Segmentation and its checks.
void add_segmentation_options(CLI::App& command, ImportCommandLine& given) {
    command
        .add_option("--segmenter", given.segmenter,
                    "Segmentation method: auto, alpha (of the photos), masks, model (a "
                    "network, fused with the background model), background (the background model), chroma (a screen "
                    "of one colour); auto uses the first of these that is available, never chroma")
        ->check(CLI::IsMember(kSegmenters))
        ->capture_default_str();
    command
        .add_option("--segmentation-model", given.import.segmentation.network,
                    "FILE.onnx of the network (fp32; U2-Net, IS-Net, BiRefNet); default: RAYSPACE_SEGMENTATION_MODEL")
        ->check(CLI::ExistingFile);
    command
        .add_option("--masks", given.import.segmentation.masks,
                    "Folder with one mask per photo, white where the object is: NAME.png, NAME.jpg.png, NAME_mask.png")
        ->check(CLI::ExistingDirectory);
    command.add_flag("--masks-alpha", given.import.segmentation.masks_are_alpha,
                     "The masks' grey is the final opacity (default: masks are binary, their soft edge is estimated)");
    command
        .add_option("--shadow", given.shadow, "The object's shadow on the floor: remove, or keep as a soft black layer")
        ->check(CLI::IsMember({"remove", "keep"}))
        ->capture_default_str();
    command
        .add_option("--segmentation-parameters", given.parameters,
                    "JSON file with thresholds of segmentation that differ from the defaults, for experiments "
                    "(docs/segmentation.md)")
        ->check(CLI::ExistingFile);
    command.add_flag("--force", given.import.force,
                     "Write the set even if checks fail, and replace an output folder that contains other files");
}

// Calibration and values that are known.
void add_calibration_options(CLI::App& command, ImportCommandLine& given) {
    command
        .add_option("--calibration", given.calibration,
                    "auto (the most accurate that succeeds), board, tracks, silhouettes or nominal (equal steps, a "
                    "level camera); colmap: for a camera that moved around the object, by the installed COLMAP")
        ->check([](const std::string& text) {
            if (kCalibrations.contains(text) || text == kColmap) return std::string();
            std::vector<std::string> names{kColmap};
            for (const auto& [name, choice] : kCalibrations) names.push_back(name);
            return "'" + text + "' is not one of " + listed(names, names.size()) +
                   (text == "given" ? "; give known values by --known" : "");
        })
        ->capture_default_str();
    command.add_option(
        "--board", given.board,
        "Calibration board on the turntable: default, or differences from the default of rs-capture board, "
        "e.g. squares=9x9,square-mm=18");
    command
        .add_option("--known", given.known,
                    "Known values, held constant: a transforms.json, a COLMAP model, a Middlebury *_par.txt, or OpenCV "
                    "intrinsics (.yml, .yaml, .xml). Cameras that form no turn are taken as posed photos")
        ->check(CLI::ExistingPath);
    add_posed_options(command, given.posed);
    command.add_flag("--equal-steps", given.equal_steps, "All steps are equal; only their common size is estimated");
    command.add_flag("--principal-point", given.principal_point,
                     "Estimate the principal point, too (default: the image centre)");
}

// Geometry of the turn, mostly for a nominal rig.
void add_turn_options(CLI::App& command, ImportCommandLine& given) {
    command
        .add_option(
            "--fov", given.import.fov_deg,
            "Horizontal field of view in degrees, held constant (default: calibrated; in a nominal rig from EXIF, "
            "else 25)")
        ->check(CLI::Range(1.0, 120.0));
    command
        .add_option(
            "--degrees-per-view", given.import.degrees_per_view,
            "Step from image to image in degrees, held constant (default: all angles are estimated; in a nominal "
            "rig 360 / number of images)")
        ->check(CLI::Range(0.01, 180.0));
    command.add_option("--axis-x", given.import.axis_x_px,
                       "Image column of the turntable's axis in px, for a nominal rig (default: from the "
                       "silhouettes of the full turn)");
    CLI::Option* clockwise = command.add_flag("--clockwise", given.clockwise,
                                              "The object turns clockwise seen from above: its front goes to the left "
                                              "(default: estimated from the images; clockwise if that fails)");
    command
        .add_flag("--counter-clockwise", given.counter_clockwise,
                  "The object turns the other way: its front goes to the right")
        ->excludes(clockwise);
}

// Reports on the import.
void add_report_options(CLI::App& command, ImportCommandLine& given) {
    command
        .add_option("--report", given.report,
                    "Also write PAGE.html: estimates, residuals, the axis on the photos, alpha mattes")
        ->check(ends_in({".html", ".htm"}));
    command.add_flag("--json", given.json, "Print the summary as JSON");
    command.add_flag("-q,--quiet", given.quiet, "No progress bar, no notes");
}

}  // namespace

void add_import_command(CLI::App& app, std::function<Status()>& run) {
    auto given = std::make_shared<ImportCommandLine>();
    CLI::App* command =
        app.add_subcommand("import", "Segment and calibrate turntable photos, or a video, and write a capture set");
    add_photo_options(*command, *given);
    add_segmentation_options(*command, *given);
    add_calibration_options(*command, *given);
    add_turn_options(*command, *given);
    add_report_options(*command, *given);
    command->footer(R"(Examples:
  rs-capture import photos/ -o shoe.set --report shoe.html
  rs-capture import photos/ -o shoe.set --segmentation-model isnet.onnx
  rs-capture import photos/ -o shoe.set --masks masks/
  rs-capture import images/ -o toy.set --calibration colmap --masks masks/   by hand (docs/posed.md)
  rs-capture import images/ -o toy.set --known sparse/0       photos with known cameras
  rs-capture import low/ middle/ high/ -o toy.set             turns at several heights (docs/turns.md)
  rs-capture import turn.mp4 -o shoe.set        a video of one turn or more (docs/film.md))");
    command->callback([given, &run] {
        run = [given] {
            given->import.photos = given->photos.front();
            return run_import(*given);
        };
    });
}

}  // namespace rs::capture
