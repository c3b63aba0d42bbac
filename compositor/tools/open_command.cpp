#include "compositor/tools/camera_options.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/headless_renderer.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/tools/sharing_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "compositor/tools/window_content.hpp"
#include "compositor/viewer/views/framing.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace rs::compositor {
namespace {

// Flag of rs-view before 0.41 that is an option of a subcommand now.
struct ReplacedFlag {
    std::string_view flag;
    std::string_view subcommand;
};

// The flags that selected a mode come first: of several that are given, the first one in this list is named.
constexpr std::array kReplacedFlags{
    ReplacedFlag{"--sequence", "sequence FOLDER"},
    ReplacedFlag{"--walls", "walls SCENE --display PRESET|FILE.json"},
    ReplacedFlag{"--quilt", "quilt SCENE --layout COLSxROWS"},
    ReplacedFlag{"--probe", "probe SCENE --position X,Y,Z"},
    ReplacedFlag{"--save-lights", "lights SCENE -o FILE.json"},
    ReplacedFlag{"--plan", "tile plan SCENE -o FILE.json"},
    ReplacedFlag{"--tile", "tile trace SCENE --tile F:X,Y,WxH"},
    ReplacedFlag{"--tiles", "tile assemble SCENE --tiles FOLDER"},
    ReplacedFlag{"-o", "render SCENE -o FILE"},
    ReplacedFlag{"--output", "render SCENE -o FILE"},
    ReplacedFlag{"--headless", "render SCENE -o FILE"},
    ReplacedFlag{"--path", "render SCENE --path FILE.json -o FILE"},
    ReplacedFlag{"--orbit", "render SCENE --orbit N -o FILE"},
    ReplacedFlag{"--passes", "render SCENE --passes N -o FILE"},
    ReplacedFlag{"--seconds", "render SCENE --seconds S -o FILE"},
    ReplacedFlag{"--streaming", "render SCENE --streaming -o FILE"},
    ReplacedFlag{"--upright", "render SCENE --upright -o FILE"},
    ReplacedFlag{"--stats", "render SCENE --stats FILE.json -o FILE"},
};

// Throws a CLI::ParseError if `arguments`, which `rs-view open` does not know, is not empty. The message names the
// subcommand that has the option.
void refuse_unknown_arguments(const std::vector<std::string>& arguments) {
    if (arguments.empty()) return;
    for (const ReplacedFlag& replaced : kReplacedFlags) {
        const bool is_given = std::ranges::any_of(arguments, [&](const std::string& argument) {
            return std::string_view(argument).substr(0, argument.find('=')) == replaced.flag;
        });
        if (!is_given) continue;
        throw CLI::ValidationError(std::string(replaced.flag) + " is not an option of 'rs-view open'; use 'rs-view " +
                                   std::string(replaced.subcommand) + "'");
    }
    throw CLI::ExtrasError("open", arguments);
}

struct OpenOptions {
    SceneOptions scene;
    ViewOptions view;
    std::string size = "1280x720";
    RendererOptions renderer;
    DrawingOptions drawing;
    ExecutorOptions executor;
    std::optional<int> first_grid_cells;
    SharingOptions sharing;
};

Result<Camera> first_camera(const OpenOptions& options, const LoadedScene& loaded, PixelSize size) {
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> cameras,
                        requested_cameras(
                            options.view, MotionOptions{}, loaded.scene, [&] { return loaded.all_objects(); }, size));
    return cameras.front();
}

// The scene's file, else the first object's.
std::string displayed_name(const SceneOptions& options) {
    if (!options.scene && !options.objects.empty()) {
        const std::string& object = options.objects.front();
        return std::filesystem::path(object.substr(0, object.find('@'))).filename().string();
    }
    return std::filesystem::path(scene_name(options)).filename().string();
}

Result<WindowContent> content_of(const OpenOptions& options, LoadedScene loaded, const Camera& first) {
    WindowContent content;
    content.title = displayed_name(options.scene);
    VisitOptions& visit = content.visit;
    visit.scene_name = content.title;
    RS_ASSIGN_OR_RETURN(visit.frame,
                        frame_options(options.drawing, options.renderer, {first.width, first.height}, true));
    RS_ASSIGN_OR_RETURN(visit.sharing,
                        sharing_peers(options.sharing, options.scene.scene.value_or(""), options.scene.objects));
    RS_ASSIGN_OR_RETURN(visit.tracing, traced_options(options.renderer));
    visit.first_grid_cells = options.first_grid_cells;
    visit.traced = options.renderer.method().has_value();
    if (options.scene.lights) visit.lights = *options.scene.lights;
    visit.executor = loaded.executor.name;
    visit.load_objects = [depth = options.drawing.object_depth,
                          executor = options.executor](const Scene& scene) -> Result<std::unique_ptr<Showroom>> {
        RS_ASSIGN_OR_RETURN(LoadedScene again, load_objects(scene, depth, executor, false));
        return std::move(again.showroom);
    };
    visit.viewpoints = {viewpoint_of(first)};
    visit.viewpoints.insert(visit.viewpoints.end(), loaded.scene.viewpoints.begin(), loaded.scene.viewpoints.end());
    content.scene = std::move(loaded.scene);
    content.showroom = std::move(loaded.showroom);
    return content;
}

// Renders the first view to ./screenshot-N.png, where no window can be opened.
Status write_first_view(const std::string& file, const OpenOptions& options, const LoadedScene& loaded,
                        const Camera& first) {
    ProgressBar progress;
    RS_ASSIGN_OR_RETURN(TracedImages traced,
                        traced_images(loaded, options.renderer, PassOptions{}, scene_name(options.scene), progress));
    RS_ASSIGN_OR_RETURN(FrameOptions frame, frame_options(options.drawing, options.renderer,
                                                          {first.width, first.height}, !loaded.executor.tilted));
    const HeadlessOptions headless{.frame = std::move(frame)};
    RS_ASSIGN_OR_RETURN(HeadlessRenderer renderer, HeadlessRenderer::create(loaded, headless, std::move(traced)));
    RS_ASSIGN_OR_RETURN(const Image<Rgba8> image, renderer.render(first));
    RS_TRY(write_png(file, image));
    renderer.warn_of_missing_objects(options.executor.memory_mib);
    return {};
}

Status run_open(const OpenOptions& options) {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, {}));
    Result<Window> window = Window::create(
        {.title = displayed_name(options.scene) + " - rs-view", .width = size.width, .height = size.height});
    std::string file;
    if (!window) {
        if (options.sharing.is_given()) {
            return Error{window.error().message + "; --share and --follow need a window"};
        }
        int number = 0;
        file = free_name(".", "screenshot", ".png", number).string();
        print_warnings({window.error().message + "; the first view goes to " + file});
    }
    RS_ASSIGN_OR_RETURN(LoadedScene loaded,
                        load_objects(std::move(scene), options.drawing.object_depth, options.executor, !window.ok()));
    RS_ASSIGN_OR_RETURN(const Camera first, first_camera(options, loaded, size));
    if (!window) return write_first_view(file, options, loaded, first);
    RS_ASSIGN_OR_RETURN(WindowContent content, content_of(options, std::move(loaded), first));
    const WindowSettings settings{options.size, options.renderer, options.drawing, options.executor,
                                  options.first_grid_cells};
    return show_contents(std::move(*window), std::move(content), [&](const std::string& other) {
        return is_sequence(other) ? sequence_content(settings, other) : scene_content(settings, other);
    });
}

}  // namespace

Result<WindowContent> scene_content(const WindowSettings& settings, const std::string& file) {
    OpenOptions options;
    options.scene.scene = file;
    options.size = settings.size;
    options.renderer = settings.renderer;
    options.drawing = settings.drawing;
    options.executor = settings.executor;
    options.first_grid_cells = settings.first_grid_cells;
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, {}));
    RS_ASSIGN_OR_RETURN(LoadedScene loaded,
                        load_objects(std::move(scene), options.drawing.object_depth, options.executor, false));
    RS_ASSIGN_OR_RETURN(const Camera first, first_camera(options, loaded, size));
    return content_of(options, std::move(loaded), first);
}

void add_open_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<OpenOptions>();
    CLI::App* command = app.add_subcommand(
        "open",
        "Walk through a scene in a window (H shows the keys). `rs-view SCENE` is short for `rs-view open SCENE`");
    add_scene_options(*command, options->scene);
    add_view_options(*command, options->view);
    add_size_option(*command, options->size);
    add_renderer_options(*command, options->renderer);
    add_lens_options(*command, options->renderer);
    command
        ->add_option("--first-grid", options->first_grid_cells,
                     "traced: cells along the longer side of a view's first image, 1..8192 (default: by time)")
        ->check(CLI::Range(1, 8192).description(""))
        ->type_name("CELLS");
    add_sharing_options(*command, options->sharing);
    add_drawing_options(*command, options->drawing);
    add_executor_options(*command, options->executor);
    command->footer(
        "`rs-view SCENE` is short for `rs-view open SCENE`.\nExample: rs-view open museum.wrl --viewpoint entrance");
    command->allow_extras();  // so that options of other subcommands can be refused with advice
    command->callback([command, options, &run] {
        refuse_unknown_arguments(command->remaining());
        check_scene_options(options->scene);
        check_sharing_options(options->sharing, true);
        if (options->renderer.toon_objects)
            throw CLI::ValidationError("--toon-objects is not an option of windows; use 'rs-view render'");
        run = [options] { return run_open(*options); };
    });
}

}  // namespace rs::compositor
