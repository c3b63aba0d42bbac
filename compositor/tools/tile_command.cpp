// Frames of traced light in tiles, for rendering on several machines:
//
//     plan -> numbers of frames and pixels -> trace, once per tile -> FOLDER/F-X-Y.png -> assemble -> frames
//
// Tiles hold the traced image alone; `assemble` draws objects and blended surfaces over it. The frames equal those of
// `rs-view render` with the same options.

#include "compositor/tools/camera_options.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/frame_output.hpp"
#include "compositor/tools/headless_renderer.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

// The frames that are rendered in tiles. All three subcommands take the same options, so that a script passes one list
// of them.
struct TiledFrames {
    SceneOptions scene;
    ViewOptions view;
    MotionOptions motion;
    std::string size = "1280x720";
    RendererOptions renderer;
    PassOptions passes;
    DrawingOptions drawing;
    ExecutorOptions executor;
    bool upright = false;
    bool quiet = false;
};

struct PlanOptions {
    TiledFrames frames;
    std::string output;
};

struct TraceOptions {
    TiledFrames frames;
    std::string tile;  // FRAME:X,Y,WxH
    std::string output;
};

struct AssembleOptions {
    TiledFrames frames;
    std::string tiles;  // folder
    double frames_per_second = 30;
    std::string output;
    bool force = false;
};

// Rectangle of a frame, px.
struct Tile {
    std::size_t frame = 0;
    capture::PixelRectangle place;
};

// Parses Count non-negative numbers that are separated by the characters of `separators`.
template <std::size_t Count>
std::optional<std::array<int, Count>> numbers_between(std::string_view text, std::string_view separators) {
    std::array<int, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), numbers.at(i));
        if (error != std::errc{} || numbers.at(i) < 0) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (i + 1 == Count) break;
        if (text.empty() || text.front() != separators.at(i)) return std::nullopt;
        text.remove_prefix(1);
    }
    if (!text.empty()) return std::nullopt;
    return numbers;
}

Result<Tile> parse_tile(const std::string& text, const std::vector<Camera>& cameras) {
    const auto numbers = numbers_between<5>(text, ":,,x");
    if (!numbers) return Error{"--tile " + text + ": give FRAME:X,Y,WIDTHxHEIGHT, such as 0:256,0,128x64"};
    const auto [frame, x, y, width, height] = *numbers;
    if (static_cast<std::size_t>(frame) >= cameras.size()) {
        return Error{"--tile " + text + ": there are " + std::to_string(cameras.size()) + " frames; give one of 0.." +
                     std::to_string(cameras.size() - 1)};
    }
    const Camera& camera = cameras[static_cast<std::size_t>(frame)];
    if (width < 1 || height < 1 || width > camera.width || x > camera.width - width || height > camera.height ||
        y > camera.height - height) {
        return Error{"--tile " + text + ": lies outside of the frame of " + std::to_string(camera.width) + "x" +
                     std::to_string(camera.height)};
    }
    return Tile{static_cast<std::size_t>(frame), {x, y, x + width, y + height}};
}

struct OpenFrames {
    LoadedScene loaded;
    std::vector<Camera> cameras;
};

// Opens the scene of the frames; refuses to write `output` over an input.
Result<OpenFrames> open_frames(const TiledFrames& options, const std::string& output, const std::string& tiles = "") {
    RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(options.size));
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, {.outputs = {output},
                                                                .inputs = {options.motion.path.value_or(""), tiles,
                                                                           options.renderer.toon_style.value_or("")}}));
    RS_ASSIGN_OR_RETURN(LoadedScene loaded,
                        load_objects(std::move(scene), options.drawing.object_depth, options.executor, true));
    RS_ASSIGN_OR_RETURN(std::vector<Camera> cameras,
                        requested_cameras(
                            options.view, options.motion, loaded.scene, [&] { return loaded.all_objects(); }, size));
    return OpenFrames{std::move(loaded), std::move(cameras)};
}

Status run_plan(const PlanOptions& options) {
    RS_ASSIGN_OR_RETURN(const OpenFrames frames, open_frames(options.frames, options.output));
    const nlohmann::json plan{{"frames", frames.cameras.size()},
                              {"width", frames.cameras.front().width},
                              {"height", frames.cameras.front().height}};
    return write_file(options.output, plan.dump(2) + "\n");
}

Status run_trace(const TraceOptions& options) {
    RS_ASSIGN_OR_RETURN(const OpenFrames frames, open_frames(options.frames, options.output));
    RS_ASSIGN_OR_RETURN(const Tile tile, parse_tile(options.tile, frames.cameras));
    RS_ASSIGN_OR_RETURN(const std::shared_ptr<TracedRenderer> tracer,
                        make_tracer(frames.loaded, options.frames.renderer, scene_name(options.frames.scene)));
    tracer->set_part(tile.place);
    ProgressBar progress(options.frames.quiet);
    const auto traced = trace_frame(*tracer, options.frames.passes, frames.cameras[tile.frame], progress);
    const auto& [x0, y0, x1, y1] = tile.place;
    Image<Rgba8> image(x1 - x0, y1 - y0);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) image(x - x0, y - y0) = (*traced)(x, y);
    }
    return write_png(options.output, image);
}

// The files FRAME-X-Y.png of a folder, sorted.
Result<std::vector<fs::path>> tile_files(const std::string& folder, std::size_t frame) {
    const std::string begin = std::to_string(frame) + "-";
    std::vector<fs::path> files;
    std::error_code error;
    for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        if (at->path().filename().string().starts_with(begin)) files.push_back(at->path());
    }
    if (error) return Error{folder + ": cannot be read: " + error.message()};
    std::ranges::sort(files);
    return files;
}

// The traced image of a frame from its tiles, which must cover each pixel once.
Result<Image<Rgba8>> read_tiles(const std::string& folder, std::size_t frame, const Camera& camera) {
    RS_ASSIGN_OR_RETURN(const std::vector<fs::path> files, tile_files(folder, frame));
    Image<Rgba8> image(camera.width, camera.height);
    Image<std::uint8_t> covered(camera.width, camera.height);
    for (const fs::path& path : files) {
        const auto place = numbers_between<3>(path.stem().string(), "--");
        if (!place) return Error{path.string() + ": is not named as a tile, such as 0-256-0.png; remove it"};
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> tile, read_image(path));
        const auto [number, x0, y0] = *place;
        if (x0 > camera.width - tile.width() || y0 > camera.height - tile.height()) {
            return Error{path.string() + ": lies outside of the frame; remove it"};
        }
        for (int y = 0; y < tile.height(); ++y) {
            for (int x = 0; x < tile.width(); ++x) {
                if (++covered(x0 + x, y0 + y) > 1) return Error{path.string() + ": overlaps another tile; remove one"};
                image(x0 + x, y0 + y) = tile(x, y);
            }
        }
    }
    if (std::ranges::count(covered.pixels(), std::uint8_t{0}) > 0) {
        return Error{folder + ": lacks tiles of frame " + std::to_string(frame) +
                     "; make them with 'rs-view tile trace'"};
    }
    return image;
}

Status run_assemble(const AssembleOptions& options) {
    const TiledFrames& tiled = options.frames;
    RS_ASSIGN_OR_RETURN(const OutputKind kind, output_kind(options.output));
    RS_ASSIGN_OR_RETURN(const OpenFrames frames, open_frames(tiled, options.output, options.tiles));
    const std::vector<Camera>& cameras = frames.cameras;
    RS_TRY(check_frame_count(options.output, kind, cameras.size()));
    // Has the light of the objects.
    RS_ASSIGN_OR_RETURN(const std::shared_ptr<TracedRenderer> tracer,
                        make_tracer(frames.loaded, tiled.renderer, scene_name(tiled.scene)));
    const TracedImages from_tiles = [&](std::size_t frame, const Camera& camera) -> Result<TracedImage> {
        RS_ASSIGN_OR_RETURN(Image<Rgba8> image, read_tiles(options.tiles, frame, camera));
        return TracedImage{std::make_shared<const Image<Rgba8>>(std::move(image)), 0, tracer->object_irradiance()};
    };
    RS_ASSIGN_OR_RETURN(FrameOptions frame,
                        frame_options(tiled.drawing, tiled.renderer, {cameras.front().width, cameras.front().height},
                                      tiled.upright || !frames.loaded.executor.tilted));
    const HeadlessOptions headless{.frame = std::move(frame), .frames_per_second = options.frames_per_second};
    RS_ASSIGN_OR_RETURN(HeadlessRenderer renderer, HeadlessRenderer::create(frames.loaded, headless, from_tiles));
    FrameProgress progress(tiled.quiet, cameras.size(), false);
    progress.start();
    const RenderView render = [&](const Camera& camera) { return renderer.render(camera); };
    const FrameOutput output{
        .path = options.output, .kind = kind, .force = options.force, .frames_per_second = options.frames_per_second};
    RS_TRY(write_frames(output, cameras, render, progress.of_frames()));
    progress.finish();
    renderer.warn_of_missing_objects(tiled.executor.memory_mib);
    return {};
}

void add_frames_options(CLI::App& command, TiledFrames& frames) {
    add_scene_options(command, frames.scene);
    add_view_options(command, frames.view);
    add_motion_options(command, frames.motion);
    add_size_option(command, frames.size);
    add_renderer_options(command, frames.renderer);
    add_lens_options(command, frames.renderer);
    require_traced_renderer(command, frames.renderer);
    command.add_option("--passes", frames.passes.passes, "rays per pixel of a frame, 1..65536 (default: 64)")
        ->check(CLI::Range(1, 65536).description(""))
        ->type_name("N");
    add_drawing_options(command, frames.drawing);
    add_upright_option(command, frames.upright);
    add_executor_options(command, frames.executor);
    command.add_flag("-q,--quiet", frames.quiet, "no progress bar");
}

void add_plan_command(CLI::App& tile, std::function<Status()>& run) {
    auto options = std::make_shared<PlanOptions>();
    CLI::App* command = tile.add_subcommand("plan", "Write the number and the size of the frames as JSON");
    command->add_option("-o,--output", options->output, "FILE.json: {\"frames\": 4, \"width\": 1280, \"height\": 720}")
        ->required()
        ->check(ends_in({".json"}))
        ->type_name("");
    add_frames_options(*command, options->frames);
    command->footer("Example: rs-view tile plan hall.wrl --orbit 4 --passes 1024 -o plan.json");
    command->callback([command, options, &run] {
        check_scene_options(options->frames.scene);
        check_renderer_options(*command, options->frames.renderer);
        run = [options] { return run_plan(*options); };
    });
}

void add_trace_command(CLI::App& tile, std::function<Status()>& run) {
    auto options = std::make_shared<TraceOptions>();
    CLI::App* command = tile.add_subcommand("trace", "Trace one tile of a frame");
    command->add_option("--tile", options->tile, "of frame F (from 0) the W x H pixels from column X and row Y")
        ->required()
        ->type_name("F:X,Y,WxH");
    command->add_option("-o,--output", options->output, "tile to write, F-X-Y.png")
        ->required()
        ->check(ends_in({".png"}))
        ->type_name("");
    add_frames_options(*command, options->frames);
    command->footer("Example: rs-view tile trace hall.wrl --passes 1024 --tile 0:256,0,256x256 -o tiles/0-256-0.png");
    command->callback([command, options, &run] {
        check_scene_options(options->frames.scene);
        check_renderer_options(*command, options->frames.renderer);
        run = [options] { return run_trace(*options); };
    });
}

void add_assemble_command(CLI::App& tile, std::function<Status()>& run) {
    auto options = std::make_shared<AssembleOptions>();
    CLI::App* command = tile.add_subcommand("assemble", "Make frames of traced tiles, and draw objects into them");
    command->add_option("--tiles", options->tiles, "folder of tiles F-X-Y.png")
        ->required()
        ->check(CLI::ExistingDirectory.description(""))
        ->type_name("FOLDER");
    command->add_option("-o,--output", options->output, "FILE.png, FILE.mp4 or a folder")->required()->type_name("");
    command->add_option("--fps", options->frames_per_second, "frames per second of an .mp4, 1..240")
        ->check(CLI::Range(1.0, 240.0).description(""))
        ->type_name("RATE")
        ->capture_default_str();
    add_frames_options(*command, options->frames);
    command->add_flag("--force", options->force, kForceHelp);
    command->footer("Example: rs-view tile assemble hall.wrl --passes 1024 --tiles tiles -o hall.png");
    command->callback([command, options, &run] {
        check_scene_options(options->frames.scene);
        check_renderer_options(*command, options->frames.renderer);
        run = [options] { return run_assemble(*options); };
    });
}

}  // namespace

void add_tile_command(CLI::App& app, std::function<Status()>& run) {
    CLI::App* command = app.add_subcommand(
        "tile", "Trace frames in tiles, for rendering on several machines; frames equal those of `rs-view render`");
    add_plan_command(*command, run);
    add_trace_command(*command, run);
    add_assemble_command(*command, run);
    command->footer(
        "The three subcommands take the same options of the frames, so that a script passes one list to all of them.\n"
        "Example:\n"
        "  rs-view tile plan hall.wrl --passes 1024 -o plan.json\n"
        "  rs-view tile trace hall.wrl --passes 1024 --tile 0:0,0,640x720 -o tiles/0-0-0.png\n"
        "  rs-view tile trace hall.wrl --passes 1024 --tile 0:640,0,640x720 -o tiles/0-640-0.png\n"
        "  rs-view tile assemble hall.wrl --passes 1024 --tiles tiles -o hall.png");
    command->require_subcommand(1);
}

}  // namespace rs::compositor
