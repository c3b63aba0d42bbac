#pragma once
// Options of rs-view that choose how frames are drawn, by which executor, and how much memory objects may take.

#include "compositor/scene/scene.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/showroom.hpp"
#include "rayspace/api/types/executor.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace rs::compositor {

struct DrawingOptions {
    int samples = FrameOptions{}.samples;  // per pixel, for the edges of geometry
    bool shadows = true;
    bool wire_frame = false;
    ObjectDepth object_depth = ObjectDepth::kPlane;
    int object_samples = FrameOptions{}.object_samples;  // across a pixel
};

struct ExecutorOptions {
    std::string executor = "core";
    std::int64_t memory_mib = default_memory_budget() >> 20;
};

/// Adds --samples, --shadows, --wire-frame, --object-depth and --object-samples.
void add_drawing_options(CLI::App& command, DrawingOptions& options);
/// Adds --upright, for frames that are not shown in a window.
void add_upright_option(CLI::App& command, bool& upright);
/// Adds --executor and --memory.
void add_executor_options(CLI::App& command, ExecutorOptions& options);

/// \param upright draw objects for level cameras and resample their images
FrameOptions frame_options(const DrawingOptions& options, const RendererOptions& renderer, PixelSize size,
                           bool upright);

/// The executor that draws the objects.
struct ObjectExecutor {
    std::unique_ptr<engine::Executor> executor;  // null: the software core
    engine::ExecutorTraits traits;
};

/// Creates the executor. Fails if it does not give the requested depth.
Result<ObjectExecutor> create_executor(const ExecutorOptions& options, ObjectDepth depth);

/// A scene with its objects, which are read in the background.
struct LoadedScene {
    Scene scene;
    engine::ExecutorTraits executor;
    std::unique_ptr<Showroom> showroom;

    /// Waits for all objects that fit into memory.
    [[nodiscard]] Result<std::vector<PlacedObject>> all_objects() const;
};

/// Creates the executor and starts to read the scene's objects. Fails if the executor does not give the requested
/// depth.
/// \param waits every frame waits for its objects, so that the same options give the same images
Result<LoadedScene> load_objects(Scene scene, ObjectDepth depth, const ExecutorOptions& options, bool waits);

}  // namespace rs::compositor
