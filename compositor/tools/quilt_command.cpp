#include "compositor/displays/quilt.hpp"
#include "compositor/tools/camera_options.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/frame_output.hpp"
#include "compositor/tools/headless_renderer.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/output/view_output.hpp"

#include <filesystem>
#include <memory>

namespace rs::compositor {
namespace {

struct QuiltOptions {
    SceneOptions scene;
    ViewOptions view;
    MotionOptions motion;
    std::string layout;
    std::string tile_size = "420x560";
    double cone_deg = 40;
    RendererOptions renderer;
    PassOptions passes;
    DrawingOptions drawing;
    ExecutorOptions executor;
    bool upright = false;
    std::string output;
    bool force = false;
    bool quiet = false;
};

// Axial depth of the object that is largest in the image; 0 if none is visible.
double depth_of_largest_object(const Scene& scene, const Camera& camera) {
    double depth = 0;
    double largest = 0;
    for (const RaySpaceNode& object : scene.objects) {
        const Similarity place = world_from_node(object.chain);
        const glm::dvec3 at = camera.project(place.translation);
        const bool inside = at.z > 0 && at.x >= 0 && at.y >= 0 && at.x <= camera.width && at.y <= camera.height;
        if (!inside || place.scale / at.z <= largest) continue;
        largest = place.scale / at.z;
        depth = at.z;
    }
    return depth;
}

// Axial depth that has no parallax between the views.
Result<double> zero_parallax_depth(const QuiltOptions& options, const Scene& scene, const Camera& camera) {
    if (options.renderer.focus) return *options.renderer.focus;
    if (const double depth = depth_of_largest_object(scene, camera); depth > 0) return depth;
    const BoundingBox box = bounds_from(scene, 0, 0);
    const double depth = box.empty() ? 0 : glm::dot(box.middle() - camera.centre(), camera.forward());
    if (depth > 0) return depth;
    return Error{"rs-view quilt: nothing is in front of the camera to focus on; give --focus DISTANCE"};
}

// The views of each frame's quilt: [frame][view].
using QuiltFrames = std::vector<std::vector<Camera>>;

Result<QuiltFrames> cameras_of_quilts(const QuiltOptions& options, const QuiltLayout& layout, const Scene& scene,
                                      const std::vector<Camera>& cameras) {
    QuiltFrames frames;
    for (const Camera& camera : cameras) {
        RS_ASSIGN_OR_RETURN(const double depth, zero_parallax_depth(options, scene, camera));
        frames.push_back(quilt_cameras(camera, layout, radians(options.cone_deg), depth));
    }
    return frames;
}

Result<Image<Rgba8>> render_quilt(const QuiltLayout& layout, const std::vector<Camera>& cameras,
                                  HeadlessRenderer& renderer, Progress& progress) {
    Image<Rgba8> quilt(layout.width(), layout.height());
    for (std::size_t view = 0; view < cameras.size(); ++view) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> tile, renderer.render(cameras[view]));
        place_tile(layout, static_cast<int>(view), tile, quilt);
        progress.advance();
    }
    return quilt;
}

// Writes one quilt, or a folder of quilts for several frames, with the layout in each file name.
Status write_quilts(const std::string& output, bool force, const QuiltLayout& layout, const QuiltFrames& frames,
                    HeadlessRenderer& renderer, Progress& progress) {
    if (frames.size() == 1) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> quilt, render_quilt(layout, frames.front(), renderer, progress));
        return write_png(quilt_path(output, layout), quilt);
    }
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(output, "quilts", force));
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> quilt, render_quilt(layout, frames[frame], renderer, progress));
        const std::filesystem::path path = staged.temporary_path() / numbered_image_name(frame);
        RS_TRY(write_png(quilt_path(path, layout), quilt));
    }
    return staged.commit();
}

Status run_quilt(const QuiltOptions& options) {
    RS_ASSIGN_OR_RETURN(const PixelSize tile, parse_size(options.tile_size));
    RS_ASSIGN_OR_RETURN(const QuiltLayout layout, parse_quilt(options.layout, tile.width, tile.height, "--layout"));
    RS_ASSIGN_OR_RETURN(Scene scene, open_scene(options.scene, {.outputs = {options.output},
                                                                .inputs = {options.motion.path.value_or(""),
                                                                           options.renderer.toon_style.value_or("")}}));
    RS_ASSIGN_OR_RETURN(const OutputKind kind, output_kind(options.output));
    if (kind == OutputKind::video) return Error{options.output + ": quilts go into a .png or a folder"};
    RS_ASSIGN_OR_RETURN(const LoadedScene loaded,
                        load_objects(std::move(scene), options.drawing.object_depth, options.executor, true));
    RS_ASSIGN_OR_RETURN(const std::vector<Camera> cameras,
                        requested_cameras(
                            options.view, options.motion, loaded.scene, [&] { return loaded.all_objects(); }, tile));
    RS_TRY(check_frame_count(options.output, kind, cameras.size()));
    RS_ASSIGN_OR_RETURN(const QuiltFrames frames, cameras_of_quilts(options, layout, loaded.scene, cameras));

    const std::size_t views = frames.size() * frames.front().size();
    FrameProgress progress(options.quiet, views, options.renderer.method().has_value());
    RS_ASSIGN_OR_RETURN(TracedImages traced, traced_images(loaded, options.renderer, options.passes,
                                                           scene_name(options.scene), progress.of_passes()));
    const HeadlessOptions headless{
        .frame = frame_options(options.drawing, options.renderer, tile, options.upright || !loaded.executor.tilted)};
    RS_ASSIGN_OR_RETURN(HeadlessRenderer renderer, HeadlessRenderer::create(loaded, headless, std::move(traced)));
    progress.start();
    RS_TRY(write_quilts(options.output, options.force, layout, frames, renderer, progress.of_frames()));
    progress.finish();
    renderer.warn_of_missing_objects(options.executor.memory_mib);
    return {};
}

}  // namespace

void add_quilt_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<QuiltOptions>();
    CLI::App* command =
        app.add_subcommand("quilt", "Render the views of a display with horizontal parallax as the tiles of one image");
    hide_help_option(*command);
    add_scene_options(*command, options->scene);
    command->add_option("-o,--output", options->output, "FILE.png, to which the layout is added, or a folder")
        ->required()
        ->type_name("");
    command->add_option("--layout", options->layout, "tiles, from left to right and from bottom to top")
        ->required()
        ->type_name("COLSxROWS");
    command->add_option("--tile-size", options->tile_size, "size of a tile in pixels")
        ->type_name("WxH")
        ->capture_default_str();
    command->add_option("--cone", options->cone_deg, "angle between the leftmost and the rightmost view, 0.01..170")
        ->check(CLI::Range(0.01, 170.0).description(""))
        ->type_name("DEG")
        ->capture_default_str();
    add_view_options(*command, options->view);
    add_motion_options(*command, options->motion);
    add_renderer_options(*command, options->renderer);
    add_lens_options(*command, options->renderer);
    CLI::Option* focus = command->get_option("--focus")->description(
        "distance without parallax, in focus with --lens (default: largest object, or scene)");
    focus->remove_needs(command->get_option("--lens"));
    add_pass_options(*command, options->passes);
    add_drawing_options(*command, options->drawing);
    add_upright_option(*command, options->upright);
    add_executor_options(*command, options->executor);
    command->add_flag("--force", options->force, kForceHelp);
    command->add_flag("-q,--quiet", options->quiet, "no progress bar");
    command->footer("Example: rs-view quilt hall.wrl --viewpoint shop --layout 5x9 -o shop.png");
    command->callback([command, options, &run] {
        check_scene_options(options->scene);
        check_renderer_options(*command, options->renderer);
        run = [options] { return run_quilt(*options); };
    });
}

}  // namespace rs::compositor
