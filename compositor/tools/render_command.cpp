#include "compositor/tools/camera_options.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/frame_output.hpp"
#include "compositor/tools/headless_renderer.hpp"
#include "compositor/tools/panorama_frames.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/output/view_output.hpp"

#include <memory>

namespace rs::compositor {
namespace {

struct RenderOptions {
    SceneOptions scene;
    ViewOptions view;
    MotionOptions motion;
    std::string size = "1280x720";
    bool panorama = false;
    RendererOptions renderer;
    PassOptions passes;
    DrawingOptions drawing;
    ExecutorOptions executor;
    bool upright = false;
    bool streaming = false;
    double frames_per_second = 30;
    std::string output;
    std::optional<std::string> stats;
    bool force = false;
    bool quiet = false;
};

Status write_panoramas(const RenderOptions& options, const FrameOutput& output, const LoadedScene& loaded,
                       const std::vector<Camera>& cameras, const PanoramaLayout& layout) {
    FrameProgress progress(options.quiet, kPanoramaFaces * cameras.size(), options.renderer.method().has_value());
    RS_ASSIGN_OR_RETURN(TracedImages traced, traced_images(loaded, options.renderer, passes_of_face(options.passes),
                                                           scene_name(options.scene), progress.of_passes()));
    const int side = panorama_cameras(cameras.front(), layout).front().width;
    const HeadlessOptions headless{.frame = frame_options(options.drawing, options.renderer, {side, side},
                                                          options.upright || !loaded.executor.tilted)};
    RS_ASSIGN_OR_RETURN(HeadlessRenderer renderer, HeadlessRenderer::create(loaded, headless, std::move(traced)));
    progress.start();
    const RenderView render = [&](const Camera& camera) {
        return render_panorama(renderer, camera, layout, progress.of_frames());
    };
    ProgressBar silent(true);
    RS_TRY(write_frames(output, cameras, render, silent));
    progress.finish();
    renderer.warn_of_missing_objects(options.executor.memory_mib);
    return {};
}

Status run_panorama(const RenderOptions& options) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(const PanoramaLayout layout, panorama_layout(size, options.renderer));
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, {.outputs = {options.output},
                                                                .inputs = {options.motion.path.value_or(""),
                                                                           options.renderer.toon_style.value_or("")}}));
    RS_ASSIGN_OR_RETURN(const OutputKind kind, output_kind(options.output));
    RS_ASSIGN_OR_RETURN(LoadedScene loaded,
                        load_objects(std::move(scene), options.drawing.object_depth, options.executor, true));
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> cameras,
                        requested_cameras(
                            options.view, options.motion, loaded.scene, [&] { return loaded.all_objects(); }, size));
    RS_TRY(check_frame_count(options.output, kind, cameras.size()));
    RS_TRY(replace_headlight(loaded.scene, cameras, options.renderer.method().has_value()));
    return write_panoramas(options,
                           {.path = options.output,
                            .kind = kind,
                            .force = options.force,
                            .writes_cameras = false,
                            .frames_per_second = options.frames_per_second},
                           loaded, cameras, layout);
}

Status run_render(const RenderOptions& options) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, {.outputs = {options.output, options.stats.value_or("")},
                                                                .inputs = {options.motion.path.value_or(""),
                                                                           options.renderer.toon_style.value_or("")}}));
    RS_ASSIGN_OR_RETURN(const OutputKind kind, output_kind(options.output));
    RS_ASSIGN_OR_RETURN(const LoadedScene loaded, load_objects(std::move(scene), options.drawing.object_depth,
                                                               options.executor, !options.streaming));
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> cameras,
                        requested_cameras(
                            options.view, options.motion, loaded.scene, [&] { return loaded.all_objects(); }, size));
    RS_TRY(check_frame_count(options.output, kind, cameras.size()));

    FrameProgress progress(options.quiet, cameras.size(), options.renderer.method().has_value());
    RS_ASSIGN_OR_RETURN(TracedImages traced, traced_images(loaded, options.renderer, options.passes,
                                                           scene_name(options.scene), progress.of_passes()));
    const bool upright = options.upright || options.streaming || !loaded.executor.tilted;
    HeadlessOptions headless{.frame = frame_options(options.drawing, options.renderer, size, upright),
                             .frames_per_second = options.frames_per_second,
                             .real_time = options.streaming};
    headless.frame.time_parts = options.stats.has_value();
    RS_ASSIGN_OR_RETURN(HeadlessRenderer renderer, HeadlessRenderer::create(loaded, headless, std::move(traced)));
    progress.start();
    const RenderView render = [&](const Camera& camera) { return renderer.render(camera); };
    const FrameOutput output{
        .path = options.output, .kind = kind, .force = options.force, .frames_per_second = options.frames_per_second};
    RS_TRY(write_frames(output, cameras, render, progress.of_frames()));
    progress.finish();
    if (!options.streaming) renderer.warn_of_missing_objects(options.executor.memory_mib);
    return options.stats ? write_file(*options.stats, renderer.times().to_json(*loaded.showroom)) : Status();
}

}  // namespace

void add_render_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Render an image, a video or a folder of frames, without a window");
    hide_help_option(*command);
    add_scene_options(*command, options->scene);
    command->add_option("-o,--output", options->output, "FILE.png, FILE.mp4 or a folder")->required()->type_name("");
    add_view_options(*command, options->view);
    add_motion_options(*command, options->motion);
    add_size_option(*command, options->size);
    command->add_flag("--panorama", options->panorama,
                      "render all directions, as a latitude-longitude image of 2:1 (--size: 2048x1024)");
    command->add_option("--fps", options->frames_per_second, "frames per second of an .mp4, 1..240")
        ->check(CLI::Range(1.0, 240.0).description(""))
        ->type_name("RATE")
        ->capture_default_str();
    add_renderer_options(*command, options->renderer);
    add_lens_options(*command, options->renderer);
    // In one line, because the help would not fit on a screen otherwise.
    command->get_option("--lens")->description(
        "traced: diameter of the lens in mm, or f-number on 36 mm film, sharp at --focus DISTANCE ahead");
    CLI::Option* focus = command->get_option("--focus")->group("");
    focus->remove_needs(command->get_option("--lens"));  // CLI11's message lacks the names of hidden options
    add_pass_options(*command, options->passes);
    add_drawing_options(*command, options->drawing);
    add_upright_option(*command, options->upright);
    add_executor_options(*command, options->executor);
    command->add_flag("--streaming", options->streaming,
                      "run in real time and show objects once they are read, instead of waiting for them");
    add_stats_option(*command, options->stats);
    command->add_flag("--force", options->force, kForceHelp);
    command->add_flag("-q,--quiet", options->quiet, "no progress bar");
    command->footer("Example: rs-view render hall.wrl --renderer path --lights evening.json --passes 256 -o hall.png");
    command->callback([command, options, &run] {
        check_scene_options(options->scene);
        check_renderer_options(*command, options->renderer);
        if (command->count("--focus") > 0 && command->count("--lens") == 0) {
            throw CLI::ValidationError("--focus needs --lens: the diameter of the lens or its f-number");
        }
        if (options->panorama) {
            check_panorama_options(*command, options->renderer);
            if (command->count("--size") == 0) options->size = kPanoramaSize;
        }
        run = [options] { return options->panorama ? run_panorama(*options) : run_render(*options); };
    });
}

}  // namespace rs::compositor
