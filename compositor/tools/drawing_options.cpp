#include "compositor/tools/drawing_options.hpp"

#include "compositor/gpu/gpu_executor.hpp"

#include <utility>

namespace rs::compositor {

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
    command.add_option("--samples", options.samples, "samples per pixel at the edges of geometry, 1..16")
        ->check(CLI::Range(1, 16).description(""))
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--shadows", [&options](const std::string& value) { options.shadows = value == "on"; },
            "raster: lights cast shadows of geometry and objects onto geometry; on or off")
        ->check(CLI::IsMember({"on", "off"}).description(""))
        ->type_name("on|off")
        ->default_str("on");
    command.add_flag("--wire-frame", options.wire_frame, "draw only the edges of the geometry's triangles");
    command
        .add_option_function<std::string>(
            "--object-depth",
            [&options](const std::string& value) {
                options.object_depth = value == "pixel" ? ObjectDepth::kPixel : ObjectDepth::kPlane;
            },
            "depth of an object: one plane, or per pixel, so that intersections are visible")
        ->check(CLI::IsMember({"plane", "pixel"}).description(""))
        ->type_name("plane|pixel")
        ->default_str("plane");
    command
        .add_option("--object-samples", options.object_samples,
                    "most samples across a pixel for distant objects, 1.." + std::to_string(kMaxSamplesAcross))
        ->check(CLI::Range(1, kMaxSamplesAcross).description(""))
        ->type_name("N")
        ->capture_default_str();
}

void add_upright_option(CLI::App& command, bool& upright) {
    command.add_flag("--upright", upright, "draw objects for level cameras and resample: faster, slightly softer");
}

void add_executor_options(CLI::App& command, ExecutorOptions& options) {
    command
        .add_option("--executor", options.executor,
                    executors_with_gpu().names() + ": draws the objects; the core draws what it cannot")
        ->type_name("NAME")
        ->capture_default_str();
    command.add_option("--memory", options.memory_mib, "limit for objects in memory (default: half of the machine's)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 30).description(""))
        ->type_name("MIB");
}

namespace {

// Null without --toon-objects.
Result<std::shared_ptr<const ObjectCartoon>> object_cartoon(const RendererOptions& renderer) {
    if (!renderer.toon_objects) return std::shared_ptr<const ObjectCartoon>();
    RS_ASSIGN_OR_RETURN(const TracedOptions traced, traced_options(renderer));
    return std::make_shared<const ObjectCartoon>(ObjectCartoon{.thresholds = traced.toon.thresholds,
                                                               .values = traced.toon.values,
                                                               .line_colour = traced.toon.edge_colour,
                                                               .line_width = traced.line_radius});
}

}  // namespace

Result<FrameOptions> frame_options(const DrawingOptions& options, const RendererOptions& renderer, PixelSize size,
                                   bool upright) {
    RS_ASSIGN_OR_RETURN(const auto cartoon, object_cartoon(renderer));
    return FrameOptions{.width = size.width,
                        .height = size.height,
                        .samples = options.samples,
                        .wire_frame = options.wire_frame,
                        .shadows = options.shadows,
                        .exposure_ev = renderer.exposure_ev,
                        .relighting = renderer.relighting,
                        .object_depth = options.object_depth,
                        .object_samples = options.object_samples,
                        .object_cartoon = cartoon,
                        .upright_images = upright};
}

Result<std::vector<PlacedObject>> LoadedScene::all_objects() const {
    RS_TRY(showroom->wait_for_all({0, 0, 0}));
    return showroom->placed();
}

Result<ObjectExecutor> create_executor(const ExecutorOptions& options, ObjectDepth depth) {
    ObjectExecutor created{nullptr, engine::ExecutorTraits{.name = "software core"}};
    if (options.executor != "core") {
        RS_ASSIGN_OR_RETURN(created.executor, executors_with_gpu().create(options.executor));
        created.traits = created.executor->traits();
    }
    if (depth == ObjectDepth::kPixel && !created.traits.depth) {
        return Error{"--object-depth pixel: " + created.traits.name + " gives no depth; leave out --executor"};
    }
    return created;
}

Result<LoadedScene> load_objects(Scene scene, ObjectDepth depth, const ExecutorOptions& options, bool waits) {
    RS_ASSIGN_OR_RETURN(ObjectExecutor created, create_executor(options, depth));
    LoadedScene loaded;
    loaded.executor = std::move(created.traits);
    loaded.showroom = std::make_unique<Showroom>(
        scene, ShowroomOptions{.memory_bytes = options.memory_mib << 20, .waits = waits}, std::move(created.executor));
    loaded.scene = std::move(scene);
    return loaded;
}

}  // namespace rs::compositor
