// rs-view: a scene with ray-space objects -> composited frames.

#include "compositor/gl/context.hpp"
#include "compositor/lighting/light_warnings.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/tools/quilt_views.hpp"
#include "compositor/tools/requested_cameras.hpp"
#include "compositor/tools/requested_scene.hpp"
#include "compositor/tools/sequence_run.hpp"
#include "compositor/tools/traced_run.hpp"
#include "compositor/tools/view_options.hpp"
#include "compositor/tools/view_tiles.hpp"
#include "compositor/tools/wall_views.hpp"
#include "compositor/tools/window_run.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/frame_times.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/window/visit.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

namespace rs::compositor {
namespace {

// The frames with the cameras that saw them, as a set of images that other tools can open.
Status write_folder(const std::function<Result<Image<Rgba8>>(const Camera&)>& compose,
                    const std::vector<Camera>& cameras, const ViewArguments& arguments, Progress& progress) {
    Result<StagedFolder> staged = StagedFolder::create(arguments.output, "composited views");
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

Status run_view(ViewArguments arguments) {
    const bool in_tiles = !arguments.quilt.empty();
    const bool on_walls = !arguments.walls.empty();
    Result<PixelSize> size = in_tiles ? requested_tile(arguments) : parse_size(arguments.size);
    if (!size) return size.error();
    Result<Scene> scene = requested_scene(arguments);
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
    const Result<OutputKind> kind = in_window || plans ? OutputKind::image : output_kind(arguments.output);
    if (!kind) return kind.error();
    Result<std::unique_ptr<engine::Executor>> board = requested_executor(arguments);
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
    Result<std::vector<Camera>> cameras = requested_cameras(arguments, *scene, objects_to_frame, *size);
    if (!cameras) return cameras.error();
    if (plans) return write_plan(arguments, *cameras);
    if (in_place_of_window) cameras->erase(cameras->begin() + 1, cameras->end());
    std::optional<WallViews> walls;
    std::optional<QuiltViews> quilt;
    const std::size_t moments = cameras->size();
    if (on_walls) {
        if (*kind != OutputKind::folder && !in_window) {
            return Error{arguments.output + ": walls go into a folder; give a folder to -o"};
        }
        Result<WallViews> requested = requested_walls(arguments, *scene, *cameras);
        if (!requested) return requested.error();
        walls = std::move(*requested);
        cameras = wall_cameras(*walls);
    } else if (in_tiles) {
        Result<QuiltViews> requested = requested_quilt(arguments, *scene, *cameras);
        if (!requested) return requested.error();
        quilt = std::move(*requested);
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
    if (*kind == OutputKind::image && moments != 1) {
        return Error{arguments.output + ": " + std::to_string(moments) +
                     " frames do not fit one image; give a folder or an .mp4 to -o"};
    }

    Result<std::unique_ptr<TracedRenderer>> tracer = requested_tracer(arguments, *scene, *showroom);
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
                                                                  .object_depth = requested_depth(arguments),
                                                                  .object_samples = arguments.object_samples,
                                                                  .upright_images = upright,
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
        return compositor->image();
    };
    if (!*tracer || cameras->size() > 1) {
        progress.start("compositing", static_cast<std::int64_t>(cameras->size()));
    }
    Status written = walls   ? write_walls(*walls, arguments, compose, progress)
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
    CLI::App app("Composites ray-space objects and geometry: in a window to walk through, or into images or a video.",
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
            throw CLI::ValidationError("--headless needs -o: the image, video or folder to write");
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
            throw CLI::ValidationError("--lens is for traced images; add --renderer path, or another that traces");
        }
        run = [&] { return arguments.probe.empty() ? run_view(arguments) : run_probe(arguments); };
    });
    return rs::tool_main(app, argc, argv, run);
}
