#include "capture/tools/commands.hpp"

#include "capture/tools/as_photos_options.hpp"
#include "capture/tracer/integrator/tracer.hpp"
#include "capture/tracer/scene/scene_file.hpp"
#include "capture/tracer/session/capture_set.hpp"
#include "capture/tracer/session/photo_session.hpp"
#include "datasets-synthetic/objects.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/light/capture_irradiance.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <nlohmann/json.hpp>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

// Command-line options; empty if the recipe's value applies.
struct Options {
    std::filesystem::path scene;
    std::filesystem::path output;
    std::filesystem::path poses;
    std::optional<int> views;
    std::optional<PixelSize> size;
    std::optional<int> samples_per_pixel;
    std::optional<double> elevation_deg;
    double first_angle_deg = 0;
    std::optional<std::uint64_t> seed;
    std::optional<double> distance_radii;
    std::optional<double> focal_widths;
    std::string format = "png";
    bool unfiltered = false;
    bool depth = false;
    int threads = 0;
    bool list = false;
    bool json = false;
    bool force = false;
    bool quiet = false;
    AsPhotosOptions as_photos;
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

// Strict parser: CLI11's accepts "-1" as the largest number and "010" as 8.
Result<std::uint64_t> parse_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc{} || end != text.data() + text.size()) {
        return Error{"'" + text + "' is not a seed; write a whole number from 0 to 18446744073709551615"};
    }
    return seed;
}

// The value; an error becomes a usage error of `option`.
template <class T>
T parsed_or_throw(const std::string& option, const Result<T>& value) {
    if (!value) throw CLI::ValidationError(option, value.error().message);
    return *value;
}

Status check_usage(const Options& options) {
    if (options.scene.empty()) return Error{"no SCENE; give a mesh or a recipe, or --list"};
    if (options.output.empty()) return Error{"no output; give -o SET"};
    const bool ring = options.views || options.size || options.elevation_deg || options.first_angle_deg != 0 ||
                      options.distance_radii || options.focal_widths;
    if (!options.poses.empty() && ring) {
        return Error{
            "--poses: the file defines the cameras; leave out --views, --size, --elevation, --first-angle, "
            "--distance and --focal-widths"};
    }
    if (!options.as_photos.is_enabled) return {};
    if (!options.poses.empty() || options.first_angle_deg != 0 || options.depth || options.format != "png") {
        return Error{
            "--as-photos: the camera is generated; leave out --poses, --first-angle, --depth and "
            "--format"};
    }
    if (options.elevation_deg && !(*options.elevation_deg >= 0 && *options.elevation_deg <= 85)) {
        return Error{"--as-photos: the camera must see the disc from above; give an --elevation of 0 to 85"};
    }
    return {};
}

Result<Rig> choose_rig(const Options& options, const SceneFile& file) {
    if (!options.poses.empty()) {
        RS_ASSIGN_OR_RETURN(Rig posed, read_rig(options.poses));
        Rig rig;  // keys of the other set, such as its generator's, are not copied
        for (const RigView& view : posed.views) {
            if (view.camera.width == 0 || view.camera.height == 0) {
                return Error{options.poses.string() + ": has no image sizes; add \"w\" and \"h\""};
            }
            RigView same;
            same.camera = view.camera;
            rig.views.push_back(std::move(same));
        }
        return rig;
    }
    const PixelSize size = options.size.value_or(PixelSize{file.camera.width, file.camera.height});
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

// Results of a run, for the summary.
struct RunResult {
    CaptureSetSummary summary;
    PixelSize size;
    double object_radius = 0;
    int samples_per_pixel = 0;
};

void print_summary(const Options& options, const std::string& scene_name, const RunResult& made, double total_s) {
    if (options.json) {
        const nlohmann::json report = {{"set", options.output.string()},
                                       {"scene", scene_name},
                                       {"views", made.summary.views},
                                       {"width", made.size.width},
                                       {"height", made.size.height},
                                       {"spp", made.samples_per_pixel},
                                       {"object_radius", made.object_radius},
                                       {"mean_coverage", made.summary.mean_coverage},
                                       {"clipped_views", made.summary.clipped_views},
                                       {"render_s", made.summary.render_s},
                                       {"total_s", total_s}};
        // Paths need not be UTF-8, JSON must.
        std::printf("%s\n", report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
        return;
    }
    std::printf("%s: %d views of %s, %dx%d, %d samples per pixel, %.0f %% covered, %.1f s\n", options.output.c_str(),
                made.summary.views, scene_name.c_str(), made.size.width, made.size.height, made.samples_per_pixel,
                100.0 * made.summary.mean_coverage, total_s);
}

Result<RunResult> make_set(const Options& options, SceneFile file, Progress& progress) {
    RS_ASSIGN_OR_RETURN(Rig rig, choose_rig(options, file));
    rig.object_radius = file.object_radius;
    rig.foot_height = file.ground_height;

    CaptureSetOptions set;
    set.render.samples_per_pixel = options.samples_per_pixel.value_or(file.camera.samples_per_pixel);
    set.render.seed = options.seed.value_or(file.seed);
    set.render.filtered = !options.unfiltered;
    set.render.depth = options.depth;
    set.render.threads = options.threads;
    set.force = options.force;
    if (file.toon) {
        set.render.method = RenderMethod::kToon;
        set.render.toon = *file.toon;
    }
    const Camera& first = rig.views.front().camera;
    set.render.lens.aperture = file.camera.aperture_radii;
    set.render.lens.focus =
        file.camera.focus_radii > 0 ? file.camera.focus_radii : glm::dot(-first.centre(), first.forward());
    set.format = options.format == "exr" ? ImageFormat::exr : ImageFormat::png;

    if (!file.toon) {
        RS_ASSIGN_OR_RETURN(const IrradianceHarmonics irradiance, capture_irradiance(file.scene));
        rig.extras[kCaptureIrradianceKey] = irradiance_to_json(irradiance);
    }
    RS_ASSIGN_OR_RETURN(const Tracer tracer, Tracer::create(std::move(file.scene)));
    RS_ASSIGN_OR_RETURN(const CaptureSetSummary summary,
                        write_capture_set(tracer, rig, set, options.output, &progress));
    const Camera& camera = rig.views.front().camera;
    return RunResult{summary, {camera.width, camera.height}, file.object_radius, set.render.samples_per_pixel};
}

Result<RunResult> make_photos(const Options& options, const SceneFile& file, Progress& progress) {
    if (file.toon) {
        return Error{options.scene.string() +
                     ": \"look\": \"toon\" cannot be rendered as photos; leave out --as-photos"};
    }
    PhotoOptions photos = options.as_photos.photos;
    SessionOptions& session = photos.session;
    const PixelSize size = options.size.value_or(PixelSize{session.width, session.height});
    session.views = options.views.value_or(session.views);
    session.width = size.width;
    session.height = size.height;
    session.focal_widths = options.focal_widths.value_or(file.camera.focal_widths);
    session.distance = options.distance_radii;
    session.elevation_deg = options.elevation_deg.value_or(session.elevation_deg);
    session.look_at_height = file.camera.look_at_height;
    session.seed = options.seed.value_or(file.seed);
    photos.samples_per_pixel = options.samples_per_pixel.value_or(file.camera.samples_per_pixel);
    photos.filtered = !options.unfiltered;
    photos.threads = options.threads;
    photos.force = options.force;
    RS_ASSIGN_OR_RETURN(const CaptureSetSummary summary,
                        write_photo_session(file.scene, file.object_radius, photos, options.output, &progress));
    return RunResult{summary, size, file.object_radius, photos.samples_per_pixel};
}

Status synthesise(const Options& options) {
    if (options.list) return print_objects(options.json);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begun = Clock::now();

    std::vector<std::filesystem::path> inputs = input_files(options.as_photos);
    inputs.insert(inputs.end(), {options.scene, options.poses});
    RS_TRY(refuse_overwriting_inputs(options.output, inputs));
    RS_ASSIGN_OR_RETURN(SceneFile file, load_scene_file(options.scene, synthetic::generate));
    if (options.as_photos.is_enabled && file.scene.has_surroundings()) {
        return Error{options.scene.string() +
                     ": photos are rendered in a built-in studio; leave out the recipe's \"room\", or --as-photos"};
    }
    for (const std::string& warning : file.scene.warnings) {
        if (!options.quiet) std::fprintf(stderr, "rs-capture: warning: %s\n", warning.c_str());
    }
    const std::string scene_name = file.scene.name;
    ProgressBar progress(options.quiet);
    RS_ASSIGN_OR_RETURN(const RunResult made, options.as_photos.is_enabled
                                                  ? make_photos(options, file, progress)
                                                  : make_set(options, std::move(file), progress));
    progress.finish();
    if (made.summary.clipped_views > 0 && !options.quiet) {
        std::fprintf(
            stderr,
            "rs-capture: warning: the object touches the image's edge in %d of %d views; use a larger --distance or "
            "a smaller --focal-widths\n",
            made.summary.clipped_views, made.summary.views);
    }
    print_summary(options, scene_name, made, std::chrono::duration<double>(Clock::now() - begun).count());
    return {};
}

}  // namespace

void add_synth_command(CLI::App& app, std::function<Status()>& run) {
    const auto options = std::make_shared<Options>();
    CLI::App* synth = app.add_subcommand("synth", "Render images of a synthetic object on a turntable");
    synth->footer(std::string(kExamples) + kAsPhotosExamples);
    synth->add_option("SCENE", options->scene, "Mesh or recipe");
    synth->add_option("-o,--output", options->output, "Capture set to write: a folder")->type_name("SET");
    synth->add_option("--views", options->views, "Cameras on the ring (recipe, or 90; photos: 36)")
        ->check(CLI::Range(1, kMaxViews))
        ->type_name("N");
    synth
        ->add_option_function<std::string>(
            "--size",
            [options](const std::string& text) { options->size = parsed_or_throw("--size", parse_size(text)); },
            "Image size in pixels (recipe, or 512x512; photos: 640x512)")
        ->type_name("WxH");
    synth->add_option("--spp", options->samples_per_pixel, "Samples per pixel; best a power of two (recipe, or 64)")
        ->check(CLI::Range(1, 65536))
        ->type_name("N");
    synth->add_option("--poses", options->poses, "Cameras of this transforms.json instead of a ring")
        ->type_name("FILE");
    synth
        ->add_option("--elevation", options->elevation_deg,
                     "Cameras' height above the horizon (recipe, or 0; photos: 20)")
        ->check(range(-89.0, 89.0))
        ->type_name("DEG");
    synth->add_option("--first-angle", options->first_angle_deg, "Rotates the whole ring")
        ->check(range(-360.0, 360.0))
        ->type_name("DEG");
    synth
        ->add_option_function<std::string>(
            "--seed",
            [options](const std::string& text) { options->seed = parsed_or_throw("--seed", parse_seed(text)); },
            "Seed of the image noise; the object's seed is the recipe's")
        ->type_name("N");
    synth
        ->add_option("--distance", options->distance_radii,
                     "Distance to the axis in bounding radii (recipe, or 3.5; photos: to fit)")
        ->check(range(1.001, 1000.0))
        ->type_name("R");
    synth->add_option("--focal-widths", options->focal_widths, "Focal length in image widths (recipe, or 1.4)")
        ->check(range(0.1, 100.0))
        ->type_name("F");
    synth->add_option("--format", options->format, "png: 8-bit sRGB; exr: linear float")
        ->check(CLI::IsMember({"png", "exr"}))
        ->capture_default_str();
    synth->add_flag("--no-filter", options->unfiltered,
                    "Do not denoise; by default noise is smoothed within similar surfaces,\n"
                    "less so with more samples (toon images are never denoised)");
    synth->add_flag("--depth", options->depth, "Write true axial depth beside each image (EXR)");
    synth->add_option("--threads", options->threads, "Number of threads; does not affect the images (0 = all)")
        ->check(CLI::Range(0, 1024))
        ->type_name("N");
    synth->add_flag("--force", options->force, kForceHelp);
    synth->add_flag("--list", options->list, "List the procedural objects and stop");
    synth->add_flag("--json", options->json, "Summary as JSON");
    synth->add_flag("-q,--quiet", options->quiet, "No progress bar, no warnings");
    add_as_photos_options(*synth, options->as_photos);
    synth->callback([options, &run] {
        const Status usable = options->list ? Status{} : check_usage(*options);
        if (!usable) throw CLI::ValidationError(usable.error().message);  // a usage error, not a failure
        run = [options] { return synthesise(*options); };
    });
}

}  // namespace rs::capture
