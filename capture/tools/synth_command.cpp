#include "capture/tools/synth_command.hpp"

#include "capture/tracer/capture_set.hpp"
#include "capture/tracer/scene_file.hpp"
#include "capture/tracer/tracer.hpp"
#include "datasets-synthetic/objects.hpp"
#include "rayspace/conventions.hpp"
#include "rayspace/progress.hpp"
#include "rayspace/rig.hpp"
#include "rayspace/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {

namespace {

// What the command line says; empty where the recipe decides.
struct Options {
    std::filesystem::path scene;
    std::filesystem::path output;
    std::filesystem::path poses;
    std::optional<int> views;
    std::optional<std::string> size;
    std::optional<int> samples_per_pixel;
    std::optional<double> elevation_deg;
    double first_angle_deg = 0;
    std::optional<std::uint64_t> seed;
    std::optional<double> distance_radii;
    std::optional<double> focal_widths;
    std::string format = "png";
    bool depth = false;
    int threads = 0;
    bool list = false;
    bool json = false;
    bool quiet = false;
};

constexpr const char* kExamples = R"(
SCENE is a mesh (.obj, .ply, .gltf, .glb) or a recipe (.json; see capture/README.md). The mesh is
scaled to a bounding sphere of radius 1; distances count that radius.

Examples:
  rs-capture synth spot.json -o spot                     90 views around the object
  rs-capture synth spot.json -o spot-heldout --first-angle 2   the views halfway between those
  rs-capture synth bunny.ply -o bunny --views 36 --size 256x256 --spp 16
  rs-capture synth spot.json -o check --poses spot/transforms.json --depth
  rs-capture synth --list                                names of the procedural objects)";

Status print_objects(bool as_json) {
    const std::vector<std::string> names = synthetic::object_names();
    if (as_json) {
        std::printf("%s\n", nlohmann::json(names).dump().c_str());
    } else {
        for (const std::string& name : names) std::printf("%s\n", name.c_str());
    }
    return {};
}

Status check_usage(const Options& options) {
    if (options.scene.empty()) return Error{"no SCENE; give a mesh or a recipe, or --list"};
    if (options.output.empty()) return Error{"no output; give -o SET"};
    const bool ring = options.views || options.size || options.elevation_deg || options.first_angle_deg != 0 ||
                      options.distance_radii || options.focal_widths;
    if (!options.poses.empty() && ring) {
        return Error{
            "--poses: the file says where the cameras are; leave out --views, --size, --elevation, --first-angle, "
            "--distance and --focal-widths"};
    }
    return {};
}

Result<Rig> choose_rig(const Options& options, const SceneFile& file) {
    if (!options.poses.empty()) {
        Result<Rig> posed = read_rig(options.poses);
        if (!posed) return posed.error();
        Rig rig;  // keys of the other set, such as its generator's, are not ours
        for (const RigView& view : posed->views) {
            if (view.camera.width == 0 || view.camera.height == 0) {
                return Error{options.poses.string() + ": has no picture sizes; add \"w\" and \"h\""};
            }
            RigView same;
            same.camera = view.camera;
            rig.views.push_back(std::move(same));
        }
        return rig;
    }
    PixelSize size{file.camera.width, file.camera.height};
    if (options.size) {
        const Result<PixelSize> parsed = parse_size(*options.size);
        if (!parsed) return Error{"--size: " + parsed.error().message};
        size = *parsed;
    }
    RingOptions ring;
    ring.count = options.views.value_or(file.camera.views);
    ring.distance = options.distance_radii.value_or(file.camera.distance_radii);
    ring.elevation_rad = radians(options.elevation_deg.value_or(file.camera.elevation_deg));
    ring.look_at_height = file.camera.look_at_height;
    ring.width = size.width;
    ring.height = size.height;
    ring.fl_px = options.focal_widths.value_or(file.camera.focal_widths) * size.width;
    ring.first_rad = radians(options.first_angle_deg);
    return make_ring(ring);
}

void print_summary(const Options& options, const SceneFile& file, const Rig& rig, const CaptureSetSummary& summary,
                   int samples_per_pixel, double total_s) {
    const Camera& camera = rig.views.front().camera;
    if (options.json) {
        const nlohmann::json report = {{"set", options.output.string()},
                                       {"scene", file.scene.name},
                                       {"views", summary.views},
                                       {"width", camera.width},
                                       {"height", camera.height},
                                       {"spp", samples_per_pixel},
                                       {"object_radius", file.object_radius},
                                       {"mean_coverage", summary.mean_coverage},
                                       {"clipped_views", summary.clipped_views},
                                       {"render_s", summary.render_s},
                                       {"total_s", total_s}};
        std::printf("%s\n", report.dump().c_str());
        return;
    }
    std::printf("%s: %d views of %s, %dx%d, %d samples per pixel, %.0f %% covered, %.1f s\n", options.output.c_str(),
                summary.views, file.scene.name.c_str(), camera.width, camera.height, samples_per_pixel,
                100.0 * summary.mean_coverage, total_s);
}

Status synthesise(const Options& options) {
    if (options.list) return print_objects(options.json);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begun = Clock::now();

    Result<SceneFile> file = load_scene_file(options.scene, synthetic::generate);
    if (!file) return file.error();
    Result<Rig> rig = choose_rig(options, *file);
    if (!rig) return rig.error();
    rig->object_radius = file->object_radius;

    CaptureSetOptions set;
    set.render.samples_per_pixel = options.samples_per_pixel.value_or(file->camera.samples_per_pixel);
    set.render.seed = options.seed.value_or(file->seed);
    set.render.depth = options.depth;
    set.render.threads = options.threads;
    set.format = options.format == "exr" ? PictureFormat::exr : PictureFormat::png;

    const Result<Tracer> tracer = Tracer::create(file->scene);
    if (!tracer) return tracer.error();
    ProgressBar progress(options.quiet);
    const Result<CaptureSetSummary> summary = write_capture_set(*tracer, *rig, set, options.output, &progress);
    if (!summary) return summary.error();
    progress.finish();
    if (summary->clipped_views > 0 && !options.quiet) {
        std::fprintf(
            stderr,
            "rs-capture: warning: the object touches the picture's edge in %d of %d views; use a larger --distance or "
            "a smaller --focal-widths\n",
            summary->clipped_views, summary->views);
    }
    print_summary(options, *file, *rig, *summary, set.render.samples_per_pixel,
                  std::chrono::duration<double>(Clock::now() - begun).count());
    return {};
}

}  // namespace

void add_synth_command(CLI::App& app, std::function<Status()>& run) {
    const auto options = std::make_shared<Options>();
    CLI::App* synth = app.add_subcommand("synth", "Trace pictures of a synthetic object on a turntable");
    synth->footer(kExamples);
    synth->add_option("SCENE", options->scene, "Mesh or recipe");
    synth->add_option("-o,--output", options->output, "Capture set to write: a folder")->type_name("SET");
    synth->add_option("--views", options->views, "Cameras on the ring (recipe, or 90)")
        ->check(CLI::Range(1, kMaxViews))
        ->type_name("N");
    synth->add_option("--size", options->size, "Picture size in pixels (recipe, or 512x512)")->type_name("WxH");
    synth->add_option("--spp", options->samples_per_pixel, "Samples per pixel; best a power of two (recipe, or 64)")
        ->check(CLI::Range(1, 65536))
        ->type_name("N");
    synth->add_option("--poses", options->poses, "Cameras of this transforms.json instead of a ring")
        ->type_name("FILE");
    synth->add_option("--elevation", options->elevation_deg, "Cameras' height above the horizon (recipe, or 0)")
        ->check(CLI::Range(-89.0, 89.0))
        ->type_name("DEG");
    synth->add_option("--first-angle", options->first_angle_deg, "Turns the whole ring")
        ->check(CLI::Range(-360.0, 360.0))
        ->type_name("DEG");
    synth->add_option("--seed", options->seed, "Seed of the pictures' noise; the object keeps the recipe's")
        ->type_name("N");
    synth->add_option("--distance", options->distance_radii, "Distance to the axis in bounding radii (recipe, or 3.5)")
        ->check(CLI::Range(1.001, 1000.0))
        ->type_name("R");
    synth->add_option("--focal-widths", options->focal_widths, "Focal length in picture widths (recipe, or 1.4)")
        ->check(CLI::Range(0.1, 100.0))
        ->type_name("F");
    synth->add_option("--format", options->format, "png: 8-bit sRGB; exr: linear float")
        ->check(CLI::IsMember({"png", "exr"}))
        ->capture_default_str();
    synth->add_flag("--depth", options->depth, "Write true axial depth beside each picture (EXR)");
    synth->add_option("--threads", options->threads, "Threads; the pictures do not depend on it (0 = all)")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
    synth->add_flag("--list", options->list, "List the procedural objects and stop");
    synth->add_flag("--json", options->json, "Summary as JSON");
    synth->add_flag("-q,--quiet", options->quiet, "No progress bar, no warnings");
    synth->callback([options, &run] {
        const Status usable = options->list ? Status{} : check_usage(*options);
        if (!usable) throw CLI::ValidationError(usable.error().message);  // wrong usage, which is not a failure
        run = [options] { return synthesise(*options); };
    });
}

}  // namespace rs::capture
