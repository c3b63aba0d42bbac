// rs-view: a scene with ray-space objects -> composited frames.

#include "compositor/gl/context.hpp"
#include "compositor/lighting/light_warnings.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/object_argument.hpp"
#include "compositor/scene/scene_file.hpp"
#include "compositor/tools/asked_cameras.hpp"
#include "compositor/tools/asked_tracing.hpp"
#include "compositor/tools/quilt_views.hpp"
#include "compositor/tools/sequence_run.hpp"
#include "compositor/tools/view_options.hpp"
#include "compositor/tools/view_tiles.hpp"
#include "compositor/tools/wall_views.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/frame_times.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/window/visit.hpp"
#include "compositor/window/wall_visit.hpp"
#include "engine/executors/executor_table.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/pictures/picture_io.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

namespace rs::compositor {
namespace {

constexpr double kRowSpacing = 2.2;  // between objects without a place of their own, object radii

Result<Scene> asked_scene(const ViewArguments& arguments) {
    Scene scene;
    if (arguments.scene.empty()) {
        scene.floor = Floor{};
    } else {
        Result<Scene> read = read_scene(arguments.scene);
        if (!read) return read.error();
        scene = std::move(*read);
    }
    if (!arguments.lights.empty()) {
        Result<LightList> list = read_light_list(arguments.lights);
        if (!list) return list.error();
        if (Status added = add_lights(scene, std::move(*list), arguments.lights); !added) return added.error();
    }
    if (!arguments.path.empty()) {
        const Result<Scene> walk = read_scene(arguments.path);
        if (!walk) return walk.error();
        if (!walk->camera)
            return Error{arguments.path + ": has no camera path (compositor/README.md, JSON, \"camera\")"};
        scene.camera = walk->camera;
    }
    const auto count = static_cast<double>(arguments.objects.size());
    for (std::size_t i = 0; i < arguments.objects.size(); ++i) {
        const double row_place = (static_cast<double>(i) - (count - 1) / 2) * kRowSpacing;
        Result<RaySpaceNode> node = parse_object_argument(arguments.objects[i], {row_place, 0, 0});
        if (!node) return node.error();
        scene.objects.push_back(std::move(*node));
    }
    return scene;
}

// The frames with the cameras that saw them, as a set of pictures that other tools can open.
Status write_folder(const std::function<Result<Image<Rgba8>>(const Camera&)>& compose,
                    const std::vector<Camera>& cameras, const ViewArguments& arguments, Progress& progress) {
    Result<StagedFolder> staged = StagedFolder::create(arguments.output);
    if (!staged) return staged.error();
    const Rig rig = rig_of_views(cameras);
    for (const RigView& view : rig.views) {
        const Result<Image<Rgba8>> frame = compose(view.camera);
        if (!frame) return frame.error();
        if (Status status = write_png(staged->temporary_path() / view.file_path, *frame); !status) return status;
        progress.advance();
    }
    if (Status status = write_rig(staged->temporary_path() / kRigFileName, rig); !status) return status;
    return staged->commit();
}

// Who draws with the core; null where that is alone.
Result<std::unique_ptr<engine::Executor>> asked_executor(const ViewArguments& arguments) {
    if (arguments.executor == "core") return std::unique_ptr<engine::Executor>();
    return engine::make_executor(arguments.executor, {.instant_loads = true});
}

ObjectDepth asked_depth(const ViewArguments& arguments) {
    return arguments.object_depth == "pixel" ? ObjectDepth::kPixel : ObjectDepth::kPlane;
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        std::fprintf(stderr, "rs-view: warning: %s\n", printable(warning).c_str());
}

Result<Window> open_window(const ViewArguments& arguments, PixelSize size) {
    return Window::create(
        {.title = arguments.scene.empty() ? "rs-view" : arguments.scene, .width = size.width, .height = size.height});
}

// In a window: beginning where the first camera is, then at the scene's viewpoints.
Status run_visit(Window window, const ViewArguments& arguments, const Scene& scene, std::unique_ptr<Showroom> showroom,
                 const std::string& executor, const Camera& first) {
    VisitOptions options;
    options.wire_frame = arguments.wire_frame;
    options.samples = arguments.samples;
    options.exposure_ev = arguments.exposure_ev;
    const Result<TracedOptions> tracing = asked_tracing(arguments);
    if (!tracing) return tracing.error();
    options.tracing = *tracing;
    options.traced = asked_method(arguments).has_value();
    if (!arguments.lights.empty()) options.lights = arguments.lights;
    options.shadows = arguments.shadows == "on";
    options.executor = executor;
    options.object_depth = asked_depth(arguments);
    options.object_samples = arguments.object_samples;
    options.warn = print_warnings;
    Viewpoint begin;
    begin.world_from_camera = first.world_from_camera;
    begin.field_of_view_rad = 2 * std::atan(0.5 * std::min(first.width, first.height) / first.fl_y);
    options.viewpoints.push_back(begin);
    options.viewpoints.insert(options.viewpoints.end(), scene.viewpoints.begin(), scene.viewpoints.end());
    return visit(std::move(window), scene, std::move(showroom), options);
}

// A window for each wall.
Status run_walls(const ViewArguments& arguments, const Scene& scene, const WallViews& views,
                 std::unique_ptr<Showroom> showroom) {
    if (asked_method(arguments)) return Error{"--renderer " + arguments.renderer + ": on walls it needs -o FOLDER"};
    return visit_walls(scene, std::move(showroom),
                       {.display = views.display,
                        .heads = views.heads,
                        .place = views.places.front(),
                        .stereo = views.stereo,
                        .samples = arguments.samples,
                        .exposure_ev = arguments.exposure_ev,
                        .object_depth = asked_depth(arguments),
                        .object_samples = arguments.object_samples,
                        .warn = print_warnings});
}

Status write_frames(const ViewArguments& arguments, OutputKind kind, const std::vector<Camera>& cameras,
                    const std::function<Result<Image<Rgba8>>(const Camera&)>& compose, Progress& progress) {
    if (kind == OutputKind::video) {
        return write_view_video(arguments.output, arguments.frames_per_second, cameras, compose, progress);
    }
    if (kind == OutputKind::folder) return write_folder(compose, cameras, arguments, progress);
    const Result<Image<Rgba8>> frame = compose(cameras.front());
    if (!frame) return frame.error();
    return write_png(arguments.output, *frame);
}

// Null for the raster renderer.
Result<std::unique_ptr<TracedRenderer>> asked_tracer(const ViewArguments& arguments, const Scene& scene,
                                                     Showroom& showroom) {
    if (!asked_method(arguments) || !arguments.tiles.empty()) return std::unique_ptr<TracedRenderer>();
    const Result<TracedOptions> options = asked_tracing(arguments);
    if (!options) return options.error();
    if (const Status status = showroom.wait_for_all({0, 0, 0}); !status) return status.error();
    auto tracer = TracedRenderer::create(scene, showroom.placed(), *options);
    if (!tracer) return Error{arguments.scene + ": " + tracer.error().message};
    print_warnings(tracer->warnings());
    return std::make_unique<TracedRenderer>(std::move(*tracer));
}

// By as many passes or seconds as were asked for, one pass at least.
std::shared_ptr<const Image<Rgba8>> trace(TracedRenderer& tracer, const ViewArguments& arguments, const Camera& camera,
                                          Progress& progress) {
    constexpr int kUsualPasses = 64;
    const int passes = arguments.passes > 0 ? arguments.passes : arguments.seconds > 0 ? 0 : kUsualPasses;
    const auto begin = std::chrono::steady_clock::now();
    const auto late = [&] {
        const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
        return arguments.seconds > 0 && gone.count() >= arguments.seconds;
    };
    tracer.look(camera);
    if (passes > 0) progress.start("tracing", passes);
    do {
        tracer.add_pass();
        if (passes > 0) progress.advance();
    } while ((passes == 0 || tracer.passes() < passes) && !late());
    if (passes > 0) progress.finish();
    return std::make_shared<const Image<Rgba8>>(tracer.picture());
}

// A piece of one frame's traced picture.
Status run_tile(const ViewArguments& arguments, const Scene& scene, Showroom& showroom,
                const std::vector<Camera>& cameras) {
    const Result<TileRequest> tile = parse_tile(arguments.tile, cameras);
    if (!tile) return tile.error();
    const Result<std::unique_ptr<TracedRenderer>> tracer = asked_tracer(arguments, scene, showroom);
    if (!tracer) return tracer.error();
    (*tracer)->set_part(tile->place);
    ProgressBar progress(arguments.quiet);
    return write_tile(arguments, *tile, *trace(**tracer, arguments, cameras[tile->frame], progress));
}

// The map of what reaches a place.
Status run_probe(const ViewArguments& arguments) {
    constexpr int kUsualSamples = 256;
    const Result<Triple> place = parse_triple(arguments.probe, "--probe");
    if (!place) return place.error();
    const Result<Scene> scene = asked_scene(arguments);
    if (!scene) return scene.error();
    print_warnings(scene->warnings);
    const auto tracer = TracedRenderer::create(*scene, {}, {});
    if (!tracer) return Error{arguments.scene + ": " + tracer.error().message};
    print_warnings(tracer->warnings());
    ProgressBar progress(arguments.quiet);
    const int samples = arguments.passes > 0 ? arguments.passes : kUsualSamples;
    return write_exr(arguments.output, tracer->probe({place->x, place->y, place->z}, samples, progress));
}

Status run_view(ViewArguments arguments) {
    const bool in_tiles = !arguments.quilt.empty();
    const bool on_walls = !arguments.walls.empty();
    Result<PixelSize> size = in_tiles ? asked_tile(arguments) : parse_size(arguments.size);
    if (!size) return size.error();
    Result<Scene> scene = asked_scene(arguments);
    if (!scene) return scene.error();
    print_warnings(scene->warnings);
    print_warnings(light_warnings(*scene));
    if (!arguments.save_lights.empty()) {
        if (Status saved = write_light_list(lights_in_force(*scene), arguments.save_lights); !saved) return saved;
        if (arguments.output.empty()) return {};
    }
    std::optional<Window> window;
    bool in_place_of_window = false;
    if (arguments.output.empty() && arguments.plan.empty() && !on_walls) {
        Result<Window> opened = open_window(arguments, *size);
        if (opened) {
            window.emplace(std::move(*opened));
        } else {  // what a visitor would have seen first
            in_place_of_window = true;
            int number = 0;
            arguments.output = free_name(".", "screenshot", ".png", number).string();
            print_warnings({opened.error().message + "; the first view goes to " + arguments.output});
        }
    }
    const bool plans = !arguments.plan.empty();
    const bool in_window = window.has_value() || (on_walls && arguments.output.empty());
    const Result<OutputKind> kind = in_window || plans ? OutputKind::picture : output_kind(arguments.output);
    if (!kind) return kind.error();
    Result<std::unique_ptr<engine::Executor>> board = asked_executor(arguments);
    if (!board) return board.error();
    const engine::ExecutorTraits drawer = *board ? (*board)->traits() : engine::ExecutorTraits{.name = "software core"};
    if (arguments.object_depth == "pixel" && !drawer.depth) {
        return Error{"--object-depth pixel: " + drawer.name + " gives no depth; leave out --executor"};
    }
    const bool waits = !in_window && !arguments.streaming;
    auto showroom = std::make_unique<Showroom>(
        *scene, ShowroomOptions{.memory_bytes = arguments.memory_mib << 20, .waits = waits}, std::move(*board));
    const auto objects_to_frame = [&]() -> Result<std::vector<PlacedObject>> {
        if (const Status status = showroom->wait_for_all({0, 0, 0}); !status) return status.error();
        return showroom->placed();
    };
    Result<std::vector<Camera>> cameras = asked_cameras(arguments, *scene, objects_to_frame, *size);
    if (!cameras) return cameras.error();
    if (plans) return write_plan(arguments, *cameras);
    if (in_place_of_window) cameras->erase(cameras->begin() + 1, cameras->end());
    std::optional<WallViews> walls;
    std::optional<QuiltViews> quilt;
    const std::size_t moments = cameras->size();
    if (on_walls) {
        Result<WallViews> asked = asked_walls(arguments, *scene, *cameras);
        if (!asked) return asked.error();
        walls = std::move(*asked);
        if (*kind != OutputKind::folder && !in_window) {
            return Error{arguments.output + ": walls go into a folder; give a folder to -o"};
        }
        cameras = wall_cameras(*walls);
    } else if (in_tiles) {
        Result<QuiltViews> asked = asked_quilt(arguments, *scene, *cameras);
        if (!asked) return asked.error();
        quilt = std::move(*asked);
        if (*kind == OutputKind::video) return Error{arguments.output + ": quilts go into a .png or a folder"};
        cameras = quilt->cameras();
    }
    if (!cameras) return cameras.error();
    if (in_window && walls) {
        return run_walls(arguments, *scene, *walls, std::move(showroom));
    }
    if (in_window) {
        return run_visit(std::move(*window), arguments, *scene, std::move(showroom), drawer.name, cameras->front());
    }
    if (!arguments.tile.empty()) return run_tile(arguments, *scene, *showroom, *cameras);
    if (*kind == OutputKind::picture && moments != 1) {
        return Error{arguments.output + ": " + std::to_string(moments) +
                     " frames do not fit one picture; give a folder or an .mp4 to -o"};
    }

    Result<std::unique_ptr<TracedRenderer>> tracer = asked_tracer(arguments, *scene, *showroom);
    if (!tracer) return tracer.error();
    Result<gl::Context> context = gl::Context::create_surfaceless();
    if (!context) return context.error();
    size = PixelSize{cameras->front().width, cameras->front().height};
    const bool upright = arguments.upright || arguments.streaming || !drawer.tilted;
    Result<FrameCompositor> compositor = FrameCompositor::create(*scene, showroom->engine(), showroom->nodes(),
                                                                 {.width = size->width,
                                                                  .height = size->height,
                                                                  .samples = arguments.samples,
                                                                  .wire_frame = arguments.wire_frame,
                                                                  .shadows = arguments.shadows == "on",
                                                                  .exposure_ev = arguments.exposure_ev,
                                                                  .object_depth = asked_depth(arguments),
                                                                  .object_samples = arguments.object_samples,
                                                                  .upright_pictures = upright,
                                                                  .time_parts = !arguments.stats.empty()});
    if (!compositor) return compositor.error();
    ProgressBar progress(arguments.quiet);
    ProgressBar silent(true);
    FrameTimes times;
    const double frame_s = 1 / arguments.frames_per_second;
    const auto begin = std::chrono::steady_clock::now();
    int missing = 0;
    const auto compose = [&](const Camera& camera) -> Result<Image<Rgba8>> {
        if (arguments.streaming) {
            std::this_thread::sleep_until(
                begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                            std::chrono::duration<double>(frame_s * static_cast<double>(times.frames()))));
        }
        if (camera.width != compositor->width() || camera.height != compositor->height()) {
            if (Status status = compositor->resize(camera.width, camera.height); !status) return status.error();
        }
        if (!arguments.tiles.empty()) {
            Result<Image<Rgba8>> traced = read_tiles(arguments, static_cast<std::size_t>(times.frames()), camera);
            if (!traced) return traced.error();
            compositor->set_traced(std::make_shared<const Image<Rgba8>>(std::move(*traced)));
        }
        if (*tracer) {
            const bool alone = cameras->size() == 1;
            compositor->set_traced(trace(**tracer, arguments, camera, alone ? progress : silent));
        }
        if (Status status = times.draw(*showroom, *compositor, camera, frame_s); !status) return status.error();
        print_warnings(showroom->take_warnings());
        missing = std::max(missing, compositor->statistics().nodes_missing);
        return compositor->picture();
    };
    if (!*tracer || cameras->size() > 1) {
        progress.start("compositing", static_cast<std::int64_t>(cameras->size()));
    }
    const Status written = walls   ? write_walls(*walls, arguments, compose, progress)
                           : quilt ? write_quilts(*quilt, arguments, compose, progress)
                                   : write_frames(arguments, *kind, *cameras, compose, progress);
    if (!written) return written;
    progress.finish();
    if (waits && missing > 0) {
        print_warnings({std::to_string(missing) + " objects in view do not fit into --memory " +
                        std::to_string(arguments.memory_mib) + " and are shown as placeholders"});
    }
    return arguments.stats.empty() ? Status() : write_file(arguments.stats, times.to_json(*showroom));
}

}  // namespace
}  // namespace rs::compositor

int main(int argc, char** argv) {
    using namespace rs::compositor;
    CLI::App app("Composites ray-space objects and geometry: in a window to walk through, or into pictures or a video.",
                 "rs-view");
    ViewArguments arguments;
    bool headless = false;
    add_view_options(app, arguments, headless);
    std::function<rs::Status()> run;
    app.callback([&] {
        check_sequence_options(arguments);
        arguments.frames_per_second_given = app.count("--fps") > 0;
        arguments.size_given = app.count("--size") > 0;
        if (!arguments.sequences.empty()) {
            run = [&] { return arguments.output.empty() ? run_sequence_window(arguments) : run_sequences(arguments); };
            return;
        }
        if (!arguments.quilt.empty() && arguments.output.empty()) {
            throw CLI::ValidationError("--quilt needs -o: the .png to write, or a folder");
        }
        if (arguments.scene.empty() && arguments.objects.empty()) {
            throw CLI::ValidationError("nothing to show; give a scene file or --object FILE.rso");
        }
        if (arguments.streaming && arguments.output.empty()) {
            throw CLI::ValidationError("--streaming is for -o; in a window objects always come while you walk");
        }
        if (headless && arguments.output.empty()) {
            throw CLI::ValidationError("--headless needs -o: the picture, video or folder to write");
        }
        if (!arguments.probe.empty() && rs::lower_case_extension(arguments.output) != ".exr") {
            throw CLI::ValidationError("--probe needs -o FILE.exr, the map to write");
        }
        if (!arguments.tile.empty() && rs::lower_case_extension(arguments.output) != ".png") {
            throw CLI::ValidationError("--tile needs -o FILE.png, the tile to write");
        }
        const bool in_pieces = !arguments.tile.empty() || !arguments.tiles.empty();
        if (in_pieces && (arguments.renderer == "raster" || arguments.seconds > 0)) {
            throw CLI::ValidationError("--tile and --tiles are of a --renderer that traces, by --passes");
        }
        if (arguments.renderer == "raster" && !arguments.output.empty() && !arguments.lens.empty()) {
            throw CLI::ValidationError("--lens is for traced pictures; add --renderer path, or another that traces");
        }
        run = [&] { return arguments.probe.empty() ? run_view(arguments) : run_probe(arguments); };
    });
    return rs::tool_main(app, argc, argv, run);
}
