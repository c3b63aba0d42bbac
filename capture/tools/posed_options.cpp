#include "capture/tools/posed_options.hpp"

#include "capture/posed/colmap_reconstruction.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <map>

namespace rs::capture {
namespace {

const std::map<std::string, CameraAxes> kCameraAxes{
    {"auto", CameraAxes::kAuto}, {"opengl", CameraAxes::kOpenGl}, {"opencv", CameraAxes::kOpenCv}};

void print_posed_json(const std::string& output, const PosedImportReport& report) {
    const UpAxis& up = report.up;
    const nlohmann::json json = {{"set", output},
                                 {"method", "posed"},
                                 {"views", report.views},
                                 {"sizes", report.sizes},
                                 {"segmenter", to_string(report.segmenter)},
                                 {"undistorted", report.undistorted},
                                 {"up", {up.direction.x, up.direction.y, up.direction.z}},
                                 {"up_from", up.from},
                                 {"level_share", up.level_share},
                                 {"origin", {report.origin.x, report.origin.y, report.origin.z}},
                                 {"radius", report.radius},
                                 {"height", report.height},
                                 {"without_camera", report.without_camera},
                                 {"without_photo", report.without_photo},
                                 {"without_object", report.without_object},
                                 {"notes", report.notes}};
    std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

void print_posed_summary(const std::string& output, const PosedImportReport& report) {
    const glm::dvec3& up = report.up.direction;
    const glm::dvec3& origin = report.origin;
    std::printf("%s: %zu posed views of %s, segmented by %s, %zu undistorted\n", output.c_str(), report.views,
                listed(report.sizes, 4).c_str(), to_string(report.segmenter).c_str(), report.undistorted);
    std::printf("  up %.3f %.3f %.3f (%s); object: middle %.4g %.4g %.4g, radius %.4g, height %.4g\n", up.x, up.y, up.z,
                report.up.from.c_str(), origin.x, origin.y, origin.z, report.radius, report.height);
}

void print_notes(const std::vector<std::string>& notes, bool quiet) {
    for (const std::string& note : notes) {
        if (!quiet) std::fprintf(stderr, "rs-capture: %s\n", printable(note).c_str());
    }
}

}  // namespace

void add_posed_options(CLI::App& command, PosedCommandLine& given) {
    command.add_flag(
        "--posed", given.posed,
        "The cameras of --known are anywhere around the object, even if they fit one turn (docs/posed.md)");
    command
        .add_option("--up", given.up,
                    "Posed photos: up direction: auto (from the horizons), photo (mean up of the photos), or x,y,z")
        ->capture_default_str()
        ->check([](const std::string& text) {
            const Result<UpRequest> parsed = parse_up(text);
            return parsed ? std::string() : parsed.error().message;
        });
    command.add_option("--camera-axes", given.axes, "Posed photos: axes of the cameras in a transforms.json")
        ->capture_default_str()
        ->check(CLI::IsMember(kCameraAxes));
}

Status run_posed_import(PosedImportOptions options, const PosedCommandLine& given, bool json, bool quiet) {
    RS_ASSIGN_OR_RETURN(options.up, parse_up(given.up));
    options.axes = kCameraAxes.at(given.axes);
    ProgressBar bar(quiet);
    RS_ASSIGN_OR_RETURN(const PosedImportReport report, import_posed_photos(options, &bar));
    bar.finish();
    print_notes(report.notes, quiet);
    if (json) {
        print_posed_json(options.output.string(), report);
    } else {
        print_posed_summary(options.output.string(), report);
    }
    return {};
}

Status run_colmap_import(PosedImportOptions options, const PosedCommandLine& given, bool json, bool quiet) {
    if (given.axes != "auto") {
        return Error{"--camera-axes: the cameras of COLMAP have OpenCV's axes by definition; leave it out"};
    }
    RS_TRY(refuse_overwriting_inputs(options.output, {options.photos, options.segmentation.masks}));
    ProgressBar bar(quiet);
    RS_TRY(check_segmenters(options, &bar));
    RS_ASSIGN_OR_RETURN(const ColmapReconstruction found,
                        reconstruct_with_colmap({options.photos, options.segmentation.masks}, &bar));
    print_notes(found.notes, quiet);
    options.cameras = found.model;
    return run_posed_import(std::move(options), given, json, quiet);
}

}  // namespace rs::capture
