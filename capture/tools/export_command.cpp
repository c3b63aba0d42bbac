#include "capture/photos/background/background_model.hpp"
#include "capture/posed/set_export.hpp"
#include "capture/tools/commands.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"

#include <cstdio>
#include <memory>
#include <string>

namespace rs::capture {
namespace {

struct ExportCommandLine {
    ExportOptions options;
    bool colmap = false;
    bool nerfstudio = false;
    std::string background = "alpha";
    bool quiet = false;
};

// Parses "alpha", "white", "black" or "R,G,B".
Result<std::optional<Rgba8>> export_background(const std::string& text) {
    RS_ASSIGN_OR_RETURN(const BackgroundRequest request, parse_background(text));
    if (request.colour) return request.colour;
    if (request.kind == BackgroundKind::kAlpha) return std::optional<Rgba8>();
    if (request.kind == BackgroundKind::kWhite) return std::optional(Rgba8{255, 255, 255, 255});
    if (request.kind == BackgroundKind::kBlack) return std::optional(Rgba8{0, 0, 0, 255});
    return Error{"'" + text + "': give alpha, white, black or R,G,B"};
}

Status run_export(const ExportCommandLine& given) {
    if (given.colmap == given.nerfstudio) return Error{"no format; give --colmap or --nerfstudio"};
    ExportOptions options = given.options;
    options.format = given.colmap ? ExportFormat::kColmap : ExportFormat::kNerfstudio;
    RS_ASSIGN_OR_RETURN(options.background, export_background(given.background));
    ProgressBar bar(given.quiet);
    RS_ASSIGN_OR_RETURN(const std::size_t views, export_set(options, &bar));
    std::printf("%s: %zu views for %s\n", options.output.string().c_str(), views,
                given.colmap ? "COLMAP" : "nerfstudio");
    return {};
}

}  // namespace

void add_export_command(CLI::App& app, std::function<Status()>& run) {
    auto given = std::make_shared<ExportCommandLine>();
    CLI::App* command = app.add_subcommand("export", "Write a capture set for COLMAP or nerfstudio");
    command->add_option("set", given->options.set, "Capture set, or its transforms.json")
        ->required()
        ->check(CLI::ExistingPath);
    command->add_option("-o,--output", given->options.output, "Folder to write")->required();
    CLI::Option* const colmap = command->add_flag(
        "--colmap", given->colmap, "images/, masks/NAME.png.png and sparse/0 as text (cameras PINHOLE, no points)");
    command->add_flag("--nerfstudio", given->nerfstudio, "images/, masks/ and transforms.json with mask_path")
        ->excludes(colmap);
    command
        ->add_option("--background", given->background,
                     "Colour below the object: alpha (RGBA images), white, black or R,G,B")
        ->capture_default_str()
        ->check([](const std::string& text) {
            const auto parsed = export_background(text);
            return parsed ? std::string() : parsed.error().message;
        });
    command->add_flag("--force", given->options.force, kForceHelp);
    command->add_flag("-q,--quiet", given->quiet, "No progress bar");
    command->footer(R"(Examples:
  rs-capture export shoe.set --colmap -o shoe-colmap
  rs-capture export shoe.set --nerfstudio -o shoe-nerf)");
    command->callback([given, &run] { run = [given] { return run_export(*given); }; });
}

}  // namespace rs::capture
