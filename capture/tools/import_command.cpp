#include "capture/tools/import_command.hpp"

#include "capture/photos/import.hpp"
#include "rayspace/progress.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <string>

namespace rs::capture {
namespace {

struct CommandLine {
    ImportOptions import;
    std::string backdrop = "auto";
    bool clockwise = false;
    bool counter_clockwise = false;
    bool json = false;
    bool quiet = false;
};

std::string backdrop_text(const ImportReport& report) {
    if (report.backdrop != BackdropKind::kColour) return to_string(report.backdrop);
    const Rgba8& c = report.backdrop_colour;
    return std::to_string(c.r) + "," + std::to_string(c.g) + "," + std::to_string(c.b);
}

void print_json(const std::string& output, const ImportReport& report) {
    nlohmann::json json;
    json["output"] = output;
    json["views"] = report.views;
    json["width"] = report.width;
    json["height"] = report.height;
    json["backdrop"] = backdrop_text(report);
    json["backdrop_from"] = report.backdrop_given ? "given" : "pictures";
    json["dropped_repeat"] = report.dropped_repeat;
    json["degrees_per_view"] = report.step_deg;
    json["axis_column_px"] = report.axis_x_px;
    json["axis_spread_px"] = report.axis_spread_px;
    json["axis_from"] = report.axis_from;
    json["turning"] = to_string(report.turning);
    json["turning_from"] = report.turning_from;
    json["fl_px"] = report.fl_px;
    json["distance_radii"] = report.distance;
    json["coverage"] = {report.min_coverage, report.max_coverage};
    json["notes"] = report.notes;
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    std::printf("%s\n", text.c_str());
}

Status run_import(const CommandLine& given) {
    ImportOptions options = given.import;
    const Result<BackdropRequest> backdrop = parse_backdrop(given.backdrop);
    if (!backdrop) return backdrop.error();
    options.backdrop = *backdrop;
    if (given.clockwise) options.turning = Turning::kClockwise;
    if (given.counter_clockwise) options.turning = Turning::kCounterClockwise;
    ProgressBar bar(given.quiet);
    const Result<ImportReport> report = import_photos(options, &bar);
    if (!report) return report.error();
    for (const std::string& note : report->notes) {
        if (!given.quiet) std::fprintf(stderr, "rs-capture: %s\n", note.c_str());
    }
    const std::string output = options.output.string();
    if (given.json) {
        print_json(output, *report);
    } else {
        std::printf(
            "%s: %d views %dx%d, backdrop %s (%s), %.4g degrees per view %s (%s), axis at column %.1f (%s), coverage "
            "%.1f..%.1f %%\n",
            output.c_str(), report->views, report->width, report->height, backdrop_text(*report).c_str(),
            report->backdrop_given ? "given" : "from the pictures", report->step_deg,
            to_string(report->turning).c_str(), report->turning_from.c_str(), report->axis_x_px,
            report->axis_from.c_str(), 100 * report->min_coverage, 100 * report->max_coverage);
    }
    return {};
}

}  // namespace

void add_import_command(CLI::App& app, std::function<Status()>& run) {
    auto given = std::make_shared<CommandLine>();
    CLI::App* command =
        app.add_subcommand("import", "Cuts the object out of turntable photographs and makes a capture set");
    command
        ->add_option("photos", given->import.photos, "Folder of pictures of one turn, in natural order of their names")
        ->required();
    command->add_option("-o,--output", given->import.output, "Folder to write: transforms.json and images/")
        ->required();
    command
        ->add_option(
            "--backdrop", given->backdrop,
            "auto, white, black, alpha (the pictures' own) or R,G,B; auto looks for alpha, then at the pictures' "
            "borders")
        ->capture_default_str()
        ->check([](const std::string& text) {
            const Result<BackdropRequest> parsed = parse_backdrop(text);
            return parsed ? std::string() : parsed.error().message;
        });
    command
        ->add_option(
            "--fov", given->import.fov_deg,
            "Horizontal field of view in degrees. Nominal: it changes how strong the perspective of new views is, "
            "not what the pictures show")
        ->check(CLI::Range(1.0, 120.0))
        ->capture_default_str();
    command
        ->add_option("--degrees-per-view", given->import.degrees_per_view,
                     "Step from picture to picture (default: 360 / number of pictures)")
        ->check(CLI::Range(0.01, 180.0));
    command->add_option(
        "--axis-x", given->import.axis_x_px,
        "Picture column of the turntable's axis in px (default: from the silhouettes of the full turn)");
    CLI::Option* clockwise = command->add_flag("--clockwise", given->clockwise,
                                               "The object turns clockwise seen from above: its front goes to the left "
                                               "(default: read from the pictures, this where they do not tell)");
    command
        ->add_flag("--counter-clockwise", given->counter_clockwise,
                   "The object turns the other way: its front goes to the right")
        ->excludes(clockwise);
    command->add_flag("--json", given->json, "Print the summary as JSON");
    command->add_flag("-q,--quiet", given->quiet, "No progress bar, no notes");
    command->footer("Example: rs-capture import photos/ -o shoe.set");
    command->callback([given, &run] { run = [given] { return run_import(*given); }; });
}

}  // namespace rs::capture
