#pragma once
// Renders the frames of a loaded scene without a window or a display.
//
//     camera -> traced image, if any -> objects in memory -> FrameCompositor -> image

#include "compositor/gl/context.hpp"
#include "compositor/tools/drawing_options.hpp"
#include "compositor/tools/tracing_options.hpp"
#include "compositor/viewer/drawing/frame_compositor.hpp"
#include "compositor/viewer/frame_times.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace rs::compositor {

struct TracedImage {
    std::shared_ptr<const Image<Rgba8>> image;
    int passes = 0;                                        // 0 if it was traced before
    std::shared_ptr<const LocalIrradiances> irradiance{};  // FrameCompositor::set_traced()
};

/// Returns the traced image of a frame, which takes the place of rasterized geometry and background.
using TracedImages = std::function<Result<TracedImage>(std::size_t frame, const Camera& camera)>;

/// A tracer of the scene's geometry and of the shadows and reflections of its objects. Waits for all objects, prints
/// the tracer's warnings.
/// \param name of the scene, for errors
Result<std::shared_ptr<TracedRenderer>> make_tracer(const LoadedScene& loaded, const RendererOptions& options,
                                                    const std::string& name);

/// Traces each frame by --renderer; an empty function for raster.
/// \param progress counts the passes of each frame; must outlive the result
Result<TracedImages> traced_images(const LoadedScene& loaded, const RendererOptions& options, const PassOptions& limit,
                                   const std::string& name, Progress& progress);

struct HeadlessOptions {
    FrameOptions frame;
    double frames_per_second = 30;
    /// Frames begin at the times of a clock, as in a window, instead of waiting for their objects.
    bool real_time = false;
};

/// Move-only; one thread.
class HeadlessRenderer {
public:
    /// \param loaded must outlive the renderer
    static Result<HeadlessRenderer> create(const LoadedScene& loaded, const HeadlessOptions& options,
                                           TracedImages traced);

    /// Renders the next frame, in the size of its camera. Prints the warnings of objects that cannot be shown.
    Result<Image<Rgba8>> render(const Camera& camera);

    /// Prints a warning if objects in view did not fit into memory.
    void warn_of_missing_objects(std::int64_t memory_mib) const;
    [[nodiscard]] const FrameTimes& times() const { return times_; }

private:
    HeadlessRenderer(const LoadedScene& loaded, const HeadlessOptions& options, TracedImages traced,
                     gl::Context context, FrameCompositor compositor);

    const LoadedScene* loaded_;
    HeadlessOptions options_;
    TracedImages traced_;
    gl::Context context_;
    FrameCompositor compositor_;
    FrameTimes times_;
    int most_missing_ = 0;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace rs::compositor
