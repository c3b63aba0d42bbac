#include "encode/tools/commands.hpp"

#include "encode/build.hpp"
#include "encode/encode_images.hpp"
#include "encode/posed/posed_rings.hpp"
#include "encode/report/build_report.hpp"
#include "encode/report/stage_clock.hpp"
#include "encode/set/capture_set.hpp"
#include "encode/tools/report_contents.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace rs::encode {
namespace {

// Options for the storage of images.
struct ProfileArguments {
    std::string profile = "dense";
    double quality = ImageGoal{}.quality;
    std::optional<double> psnr_db;
    std::string size;  // bytes of the images with suffix k, M or G; empty: not given
    int effort = ImageGoal{}.effort;
    std::optional<int> alpha_bits;  // nullopt: chosen by encode_images()
};

// "800k" -> 800000; nullopt if the text is not a size above 0.
std::optional<std::uint64_t> bytes_of(const std::string& text) {
    std::size_t read = 0;
    double number = 0;
    try {
        number = std::stod(text, &read);
    } catch (const std::exception&) {
        return std::nullopt;
    }
    const std::string unit = text.substr(read);
    double factor = 1;
    if (unit == "k") {
        factor = 1e3;
    } else if (unit == "M") {
        factor = 1e6;
    } else if (unit == "G") {
        factor = 1e9;
    } else if (!unit.empty()) {
        return std::nullopt;
    }
    const double bytes = number * factor;
    if (!(bytes >= 1 && bytes <= 1e12)) return std::nullopt;
    return static_cast<std::uint64_t>(bytes);
}

void add_profile_options(CLI::App& command, ProfileArguments& arguments) {
    command
        .add_option("--profile", arguments.profile,
                    "storage of images. dense: compressed, with random access to tiles; board: fixed-size records "
                    "that hardware decodes by table look-up, larger for the same quality; raw: uncompressed, with "
                    "colour at half width and height")
        ->capture_default_str();
    CLI::Option* quality =
        command
            .add_option("--quality", arguments.quality,
                        "quality of compressed images, 1..100; 14 more halves the error of a dense object")
            ->capture_default_str();
    CLI::Option* psnr =
        command.add_option("--psnr", arguments.psnr_db,
                           "alternative: smallest images with at least this PSNR in dB over the object's pixels");
    CLI::Option* size = command.add_option(
        "--size", arguments.size, "alternative: best images within this many bytes in total, such as 800k or 2M");
    quality->excludes(psnr)->excludes(size);
    psnr->excludes(size);
    command
        .add_option("--effort", arguments.effort,
                    "search effort of the dense encoder, 1..9: 9 takes many times as long as 1 and saves a few bits")
        ->capture_default_str();
    command.add_option(
        "--alpha-bits", arguments.alpha_bits,
        "alpha bits of compressed images, 1..6; default 2; for dense images 6 if an area is soft, such as "
        "a shadow, else 1 for a --psnr below 31 or a quality below 54");
}

// Converts the options; nullopt for raw images.
Result<std::optional<ImageGoal>> parse_goal(const ProfileArguments& arguments) {
    if (arguments.profile == "raw") return std::optional<ImageGoal>();
    if (arguments.profile != "dense" && arguments.profile != "board") {
        return Error{"--profile " + arguments.profile + ": is not a profile; use dense, board or raw"};
    }
    if (arguments.alpha_bits && (*arguments.alpha_bits < 1 || *arguments.alpha_bits > codec::kMaxAlphaBits)) {
        return Error{"--alpha-bits " + std::to_string(*arguments.alpha_bits) + ": must be 1.." +
                     std::to_string(codec::kMaxAlphaBits)};
    }
    if (arguments.effort < kMinEffort || arguments.effort > kMaxEffort) {
        return Error{"--effort " + std::to_string(arguments.effort) + ": must be 1..9"};
    }
    ImageGoal goal;
    goal.effort = arguments.effort;
    goal.profile = arguments.profile == "board" ? codec::Profile::kBoard : codec::Profile::kDense;
    goal.quality = arguments.quality;
    goal.psnr_db = arguments.psnr_db;
    if (!(goal.quality >= kMinQuality && goal.quality <= kMaxQuality)) {
        return Error{"--quality: must be 1..100"};
    }
    if (goal.psnr_db && !(*goal.psnr_db >= 10 && *goal.psnr_db <= 60)) return Error{"--psnr: must be 10..60 dB"};
    if (!arguments.size.empty()) {
        goal.images_bytes = bytes_of(arguments.size);
        if (!goal.images_bytes)
            return Error{"--size " + arguments.size + ": is not a size; use bytes, such as 750000, 800k or 2M"};
    }
    return std::optional<ImageGoal>(goal);
}

struct BuildArguments {
    std::string set;
    std::string output;
    std::string raymap = to_string(MapKind::kShape);
    std::string cells;  // empty: the default of the map's kind
    std::string report;
    ProfileArguments profile;
    int planes = PlaneMapOptions{}.planes;
    std::string name;
    bool quiet = false;
    bool json = false;
};

// Summary of a build, for stdout and the report.
struct BuildSummary {
    std::uint64_t bytes = 0;
    double seconds = 0;
    long long peak_memory_bytes = 0;
    std::optional<double> psnr_db;  // compressed images only
};

// Peak resident memory of this process.
long long peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * 1024LL;
}

Result<BuildOptions> options_of(const BuildArguments& arguments) {
    BuildOptions options;
    options.name = arguments.name;
    const std::optional<MapKind> kind = parse_map_kind(arguments.raymap);
    if (!kind) {
        return Error{"--raymap " + arguments.raymap +
                     ": is not a kind of RS map; use shape or plane (--cells sets its size)"};
    }
    options.raymap = *kind;
    options.map = default_plane_map(*kind);
    options.map.planes = arguments.planes;
    if (!arguments.cells.empty()) {
        const Result<PixelSize> cells = parse_size(arguments.cells);
        if (!cells) return Error{"--cells " + arguments.cells + ": is not XxU; use cells of x and u, such as 512x512"};
        options.map.x_cells = cells->width;
        options.map.u_cells = cells->height;
    }
    return options;
}

std::string text_of(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

void print_summary(const BuildArguments& arguments, const BuildOptions& options, const RaySpaceObject& object,
                   const BuildSummary& summary) {
    if (arguments.json) {
        nlohmann::json json{{"object", arguments.output},
                            {"views", object.views.size()},
                            {"width", object.width},
                            {"height", object.height},
                            {"rings", object.rings.size()},
                            {"raymap", to_string(options.raymap)},
                            {"bytes", summary.bytes},
                            {"seconds", summary.seconds},
                            {"peak_memory_bytes", summary.peak_memory_bytes}};
        json["profile"] = arguments.profile.profile;
        if (summary.psnr_db) json["pictures_psnr_db"] = *summary.psnr_db;
        if (!arguments.report.empty()) json["report"] = arguments.report;
        std::cout << json.dump(2) << '\n';
    } else {
        const std::string images =
            arguments.profile.profile + " images" + (summary.psnr_db ? text_of(" of %.2f dB", *summary.psnr_db) : "");
        std::printf("%s: %zu views of %dx%d, %s map, %d planes, %s, %.2f MB, %.1f s, peak memory %.0f MB\n",
                    arguments.output.c_str(), object.views.size(), object.width, object.height,
                    to_string(options.raymap).c_str(), options.map.planes, images.c_str(),
                    static_cast<double>(summary.bytes) / 1e6, summary.seconds,
                    static_cast<double>(summary.peak_memory_bytes) / 1e6);
    }
}

std::vector<ReportFact> facts_of(const BuildArguments& arguments, const BuildOptions& options, const CaptureSet& set,
                                 const RaySpaceObject& object, const BuildSummary& summary) {
    const std::string map = std::to_string(options.map.planes) + " reference planes of " +
                            std::to_string(options.map.x_cells) + "x" + std::to_string(options.map.u_cells) +
                            " cells (x, u)";
    return {
        {"capture set", arguments.set},
        {"object", arguments.output},
        {"images", std::to_string(object.views.size()) + " of " + std::to_string(object.width) + "x" +
                       std::to_string(object.height) + (set.resampled ? ", resampled upright" : "")},
        {"rings of views", std::to_string(object.rings.size())},
        {"RS map", to_string(options.raymap) + "; " + map},
        {"stored as", arguments.profile.profile +
                          (summary.psnr_db ? text_of(", %.2f dB over the object's pixels", *summary.psnr_db) : "")},
        {"object radius", text_of("%g units of the set", object.units_per_radius)},
        {"file", text_of("%.2f MB", static_cast<double>(summary.bytes) / 1e6)},
        {"time", text_of("%.1f s", summary.seconds)},
        {"peak memory", text_of("%.0f MB", static_cast<double>(summary.peak_memory_bytes) / 1e6)},
    };
}

Status run_build(const BuildArguments& arguments) {
    const auto begun = std::chrono::steady_clock::now();
    ProgressBar bar(arguments.quiet);
    StageClock progress(bar);
    RS_ASSIGN_OR_RETURN(BuildOptions options, options_of(arguments));

    if (Status kept = refuse_overwriting_inputs(arguments.output, {arguments.set}); !kept) return kept;
    RS_ASSIGN_OR_RETURN(CaptureSet opened, open_capture_set(arguments.set, &progress));
    // Check that the output files can be written before the long build.
    RS_TRY(StagedFile::create(arguments.output));
    std::optional<StagedFile> page;
    if (!arguments.report.empty()) {
        RS_ASSIGN_OR_RETURN(StagedFile created, StagedFile::create(arguments.report));
        page = std::move(created);
    }
    RS_ASSIGN_OR_RETURN(CaptureSet set, with_rings(std::move(opened), {}, &progress));
    if (options.name.empty()) options.name = name_of(set);
    RS_ASSIGN_OR_RETURN(const std::optional<ImageGoal> goal, parse_goal(arguments.profile));
    options.raw_images = !goal.has_value();
    for (const std::string& warning : set.warnings) std::cerr << "rs-encode: warning: " << warning << '\n';
    if (set.resampled) std::cerr << "rs-encode: the cameras are pitched; their images are resampled to upright ones\n";
    RS_ASSIGN_OR_RETURN(BuiltObject built, build_object(set, options, &progress));
    BuildSummary summary;
    if (goal) {
        set.completed = std::move(built.completed);
        RS_ASSIGN_OR_RETURN(EncodedImages encoded,
                            encode_images(set, built.object, *goal, arguments.profile.alpha_bits, &progress));
        set.completed.clear();  // scores compare with the photos as captured
        summary.psnr_db = encoded.psnr_db;
        built.object.coded = std::make_shared<codec::CodedImages>(std::move(encoded.coded));
    }
    RS_TRY(write_object(arguments.output, built.object, &progress));
    for (const std::string& warning : built.warnings) std::cerr << "rs-encode: warning: " << warning << '\n';

    summary.bytes = std::filesystem::file_size(arguments.output);
    summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    summary.peak_memory_bytes = peak_memory_bytes();
    if (page) {
        RS_ASSIGN_OR_RETURN(const ContainerReader container, ContainerReader::open(arguments.output));
        BuildReport report;
        report.name = options.name;
        report.facts = facts_of(arguments, options, set, built.object, summary);
        report.stages = progress.stages();
        report.chunks = summarise_chunks(container);
        report.warnings = set.warnings;
        report.warnings.insert(report.warnings.end(), built.warnings.begin(), built.warnings.end());
        report.rig = set.upright;
        built.object.images.clear();  // frees memory for the objects to be scored
        RS_TRY(add_captured_images(set, report));
        add_depth_images(set, built.depths, report);
        RS_TRY(add_evaluation(set, options.map.planes, report, &bar));
        RS_TRY(write_report(*page, report));
    }
    print_summary(arguments, options, built.object, summary);
    return {};
}

}  // namespace

void add_build_command(CLI::App& app, std::function<Status()>& run) {
    auto arguments = std::make_shared<BuildArguments>();
    CLI::App* command = app.add_subcommand("build", "Build a ray-space object from a capture set");
    command
        ->add_option("SET", arguments->set,
                     "capture set: a folder with transforms.json and its images; posed photos (cameras anywhere around "
                     "the object) become rings of synthesized views")
        ->required();
    command->add_option("-o,--output", arguments->output, "the object to write, OBJECT.rso")
        ->required()
        ->check(ends_in({".rso"}));
    command
        ->add_option("--raymap", arguments->raymap,
                     "shape: depth of every ray, estimated from the images; plane: depth of the reference planes")
        ->capture_default_str();
    command->add_option("--cells", arguments->cells,
                        "cells of each plane's RS map, XxU; default 512x512 for plane and 128x128 for shape");
    command->add_option("--planes", arguments->planes, "reference planes about the axis, 3..64")->capture_default_str();
    add_profile_options(*command, arguments->profile);
    command->add_option("--name", arguments->name, "object name; default: the set's folder");
    command
        ->add_option("--report", arguments->report,
                     "also write a report, PAGE.html; doubles the time, since it scores objects that are built "
                     "without every second view")
        ->check(ends_in({".html", ".htm"}));
    command->add_flag("-q,--quiet", arguments->quiet, "suppress the progress bar");
    command->add_flag("--json", arguments->json, "print the summary as JSON");
    command->footer(
        "Examples:\n  rs-encode build vase-set -o vase.rso --report vase.html\n"
        "  rs-encode build vase-set -o vase.rso --psnr 36\n"
        "  rs-encode build vase-set -o vase.rso --profile board --raymap plane --size 2M\n"
        "  rs-encode build vase-set -o vase.rso --profile raw --raymap plane --planes 12 --cells 512x512");
    command->callback([arguments, &run] { run = [arguments] { return run_build(*arguments); }; });
}

}  // namespace rs::encode
