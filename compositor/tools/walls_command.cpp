#include "compositor/displays/stereo_image.hpp"
#include "compositor/tools/camera_options.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/frame_output.hpp"
#include "compositor/tools/headless_renderer.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/tools/sharing_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "compositor/tools/wall_views.hpp"
#include "compositor/window/wall_visit.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/output/view_output.hpp"

#include <memory>
#include <utility>

namespace rs::compositor {
namespace {

struct WallsOptions {
    SceneOptions scene;
    ViewOptions view;
    MotionOptions motion;
    WallOptions walls;
    RendererOptions renderer;
    PassOptions passes;
    DrawingOptions drawing;
    ExecutorOptions executor;
    SharingOptions sharing;
    bool upright = false;
    bool force = false;
    bool quiet = false;
};

Status show_walls(const WallsOptions& options, const WallViews& views, LoadedScene loaded) {
    const auto tracked = [&views, warned = false]() mutable {
        const std::optional<Head> head = newest_head(views);
        if (views.tracker->dropped() > 0 && !std::exchange(warned, true)) {
            print_warnings({views.tracker->place().text() + ": a datagram " + views.tracker->first_error() +
                            "; it is dropped, as others like it will be"});
        }
        return head;
    };
    RS_ASSIGN_OR_RETURN(FrameOptions frame, frame_options(options.drawing, options.renderer, {}, true));
    WallVisitOptions visit{.display = views.display,
                           .heads = views.heads,
                           .place = views.places.front(),
                           .stereo = views.stereo,
                           .frame = std::move(frame),
                           .traced = options.renderer.method().has_value(),
                           .warn = print_warnings};
    RS_ASSIGN_OR_RETURN(visit.tracing, traced_options(options.renderer));
    if (views.tracker) visit.tracked = tracked;
    RS_ASSIGN_OR_RETURN(visit.sharing,
                        sharing_peers(options.sharing, options.scene.scene.value_or(""), options.scene.objects));
    Status left = visit_walls(loaded.scene, std::move(loaded.showroom), visit);
    if (views.tracker && views.tracker->dropped() > 1) {
        print_warnings({views.tracker->place().text() + ": of " + std::to_string(views.tracker->received()) +
                        " datagrams " + std::to_string(views.tracker->dropped()) + " were dropped"});
    }
    return left;
}

Status render_walls(const WallsOptions& options, const WallViews& views, const LoadedScene& loaded) {
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> cameras, wall_cameras(views));
    FrameProgress progress(options.quiet, cameras.size(), options.renderer.method().has_value());
    RS_ASSIGN_OR_RETURN(TracedImages traced, traced_images(loaded, options.renderer, options.passes,
                                                           scene_name(options.scene), progress.of_passes()));
    const Camera& first = cameras.front();
    RS_ASSIGN_OR_RETURN(FrameOptions frame,
                        frame_options(options.drawing, options.renderer, {first.width, first.height},
                                      options.upright || !loaded.executor.tilted));
    const HeadlessOptions headless{.frame = std::move(frame)};
    RS_ASSIGN_OR_RETURN(HeadlessRenderer renderer, HeadlessRenderer::create(loaded, headless, std::move(traced)));
    progress.start();
    const RenderView render = [&](const Camera& camera) { return renderer.render(camera); };
    RS_TRY(write_walls(views, *options.walls.output, options.force, render, progress.of_frames()));
    progress.finish();
    renderer.warn_of_missing_objects(options.executor.memory_mib);
    return {};
}

CommandFiles files_of(const WallsOptions& options) {
    CommandFiles files;
    if (options.walls.output) files.outputs = {*options.walls.output};
    files.inputs = {options.motion.path.value_or(""), options.renderer.toon_style.value_or("")};
    for (const std::string& name : {options.walls.display, options.walls.heads.value_or("")}) {
        std::error_code ignored;  // or the name of a preset, or a port
        if (std::filesystem::is_regular_file(name, ignored)) files.inputs.emplace_back(name);
    }
    return files;
}

Status run_walls(const WallsOptions& options) {
    constexpr PixelSize kSizeOfVisitor{1280, 720};  // its aspect matters where the view is framed to show everything
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, files_of(options)));
    if (options.walls.output) {
        RS_ASSIGN_OR_RETURN(const OutputKind kind, output_kind(*options.walls.output));
        if (kind != OutputKind::folder) {
            return Error{*options.walls.output + ": walls go into a folder; give a folder to -o"};
        }
    }
    RS_ASSIGN_OR_RETURN(PixelSize size, options.walls.size ? parse_size(*options.walls.size) : kSizeOfVisitor);
    RS_ASSIGN_OR_RETURN(LoadedScene loaded, load_objects(std::move(scene), options.drawing.object_depth,
                                                         options.executor, options.walls.output.has_value()));
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> visitor,
                        requested_cameras(
                            options.view, options.motion, loaded.scene, [&] { return loaded.all_objects(); }, size));
    RS_ASSIGN_OR_RETURN(const WallViews views, requested_walls(options.walls, loaded.scene, visitor));
    if (options.walls.output) return render_walls(options, views, loaded);
    return show_walls(options, views, std::move(loaded));
}

// Windows move by keys and refine without a limit.
void check_window_options(const CLI::App& command) {
    for (const char* const name :
         {"--path", "--orbit", "--passes", "--seconds", "--upright", "--quiet", "--toon-objects", "--force"}) {
        if (command.count(name) == 0) continue;
        throw CLI::ValidationError(std::string(name) + " needs -o: the folder to write images of the walls to");
    }
}

void add_display_options(CLI::App& command, WallOptions& options) {
    command
        .add_option("--display", options.display,
                    "cave, power-wall, tabletop, or a file of walls (compositor/displays/README.md)")
        ->required()
        ->type_name("NAME|FILE.json");
    command.add_option("--wall", options.walls, "only these walls, as front,left; by default all")
        ->type_name("NAME,...");
    std::vector<std::string> forms;
    for (const NamedStereoForm& named : kStereoForms) forms.emplace_back(named.name);
    command.add_option("--stereo", options.stereo, "both eyes: " + CLI::detail::join(forms, ", ") + " (red and cyan)")
        ->type_name("[FORM]")
        ->expected(0, 1)
        ->default_str("folders")
        ->check(CLI::IsMember(forms).description(""));
    command.add_option("--eye-distance", options.eye_distance_m, "distance of the eyes (default: display's, or 0.065)")
        ->check(CLI::Range(0.0, 1.0).description(""))
        ->type_name("M");
    command
        .add_option("--heads", options.heads,
                    "head per frame, or a tracker that sends opentrack datagrams; udp:PORT is on 127.0.0.1")
        ->type_name("FILE.json|udp:[ADDR:]PORT");
    command.add_option("--size", options.size, "size of all walls in pixels (default: each wall's)")->type_name("WxH");
}

}  // namespace

void add_walls_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<WallsOptions>();
    CLI::App* command = app.add_subcommand(
        "walls", "Project a scene off-axis onto the walls of a CAVE or a power wall, in windows or images");
    hide_help_option(*command);
    add_scene_options(*command, options->scene);
    command->add_option("-o,--output", options->walls.output, "folder for an image per wall; without, windows")
        ->type_name("FOLDER");
    add_display_options(*command, options->walls);
    add_sharing_options(*command, options->sharing);
    add_view_options(*command, options->view);
    command->get_option("--fov")->group("");  // only to be refused
    add_motion_options(*command, options->motion);
    add_renderer_options(*command, options->renderer);
    add_pass_options(*command, options->passes);
    add_drawing_options(*command, options->drawing);
    add_upright_option(*command, options->upright);
    add_executor_options(*command, options->executor);
    command->add_flag("--force", options->force, kForceHelp);
    command->add_flag("-q,--quiet", options->quiet, "no progress bar");
    command->footer("Example: rs-view walls hall.wrl --display cave --stereo side-by-side -o walls");
    command->callback([command, options, &run] {
        check_scene_options(options->scene);
        check_sharing_options(options->sharing, !options->walls.output);
        if (options->view.fov_deg) {
            throw CLI::ValidationError("--fov has no effect on walls, which are the field of view; leave it out");
        }
        if (!options->walls.output) check_window_options(*command);
        check_renderer_options(*command, options->renderer);
        run = [options] { return run_walls(*options); };
    });
}

}  // namespace rs::compositor
