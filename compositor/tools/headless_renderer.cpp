#include "compositor/tools/headless_renderer.hpp"

#include "compositor/tools/scene_options.hpp"

#include <algorithm>
#include <string>
#include <thread>
#include <utility>

namespace rs::compositor {

namespace {

// Lines and points have no surface for rays to meet.
void warn_of_lines(const Scene& scene, const std::string& name) {
    const auto count = std::ranges::count_if(
        scene.geometry, [](const GeometryNode& node) { return node.mesh->topology != Topology::kTriangles; });
    if (count == 0) return;
    print_warnings({name + ": " + std::to_string(count) + (count == 1 ? " shape" : " shapes") +
                    " of lines or points cannot be traced; --renderer raster draws them"});
}

}  // namespace

Result<std::shared_ptr<TracedRenderer>> make_tracer(const LoadedScene& loaded, const RendererOptions& options,
                                                    const std::string& name) {
    RS_ASSIGN_OR_RETURN(const TracedOptions traced, traced_options(options));
    warn_of_lines(loaded.scene, name);
    RS_ASSIGN_OR_RETURN(const std::vector<PlacedObject> objects, loaded.all_objects());
    Result<TracedRenderer> tracer = TracedRenderer::create(loaded.scene, objects, traced);
    if (!tracer) return Error{name + ": " + tracer.error().message};
    return std::make_shared<TracedRenderer>(std::move(*tracer));
}

Result<TracedImages> traced_images(const LoadedScene& loaded, const RendererOptions& options, const PassOptions& limit,
                                   const std::string& name, Progress& progress) {
    if (!options.method()) return TracedImages();
    Result<std::shared_ptr<TracedRenderer>> tracer = make_tracer(loaded, options, name);
    if (!tracer) return tracer.error();
    return TracedImages(
        [tracer = std::move(*tracer), limit, &progress](std::size_t, const Camera& camera) -> Result<TracedImage> {
            std::shared_ptr<const Image<Rgba8>> image = trace_frame(*tracer, limit, camera, progress);
            return TracedImage{std::move(image), tracer->passes(), tracer->object_irradiance()};
        });
}

Result<HeadlessRenderer> HeadlessRenderer::create(const LoadedScene& loaded, const HeadlessOptions& options,
                                                  TracedImages traced) {
    RS_ASSIGN_OR_RETURN(gl::Context context, gl::Context::create_surfaceless());
    RS_ASSIGN_OR_RETURN(FrameCompositor compositor, FrameCompositor::create(loaded.scene, loaded.showroom->engine(),
                                                                            loaded.showroom->nodes(), options.frame));
    return HeadlessRenderer(loaded, options, std::move(traced), std::move(context), std::move(compositor));
}

HeadlessRenderer::HeadlessRenderer(const LoadedScene& loaded, const HeadlessOptions& options, TracedImages traced,
                                   gl::Context context, FrameCompositor compositor)
    : loaded_(&loaded),
      options_(options),
      traced_(std::move(traced)),
      context_(std::move(context)),
      compositor_(std::move(compositor)) {}

Result<Image<Rgba8>> HeadlessRenderer::render(const Camera& camera) {
    using Clock = std::chrono::steady_clock;
    const std::size_t frame = times_.frames();
    const double frame_s = 1 / options_.frames_per_second;
    if (options_.real_time) {
        std::this_thread::sleep_until(begin_ +
                                      std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>(frame_s * static_cast<double>(frame))));
    }
    if (camera.width != compositor_.width() || camera.height != compositor_.height()) {
        RS_TRY(compositor_.resize(camera.width, camera.height));
    }
    TracingWork work;
    if (traced_) {
        const auto begin = Clock::now();
        RS_ASSIGN_OR_RETURN(TracedImage traced, traced_(frame, camera));
        work = {std::chrono::duration<double>(Clock::now() - begin).count(), traced.passes};
        compositor_.set_traced(std::move(traced.image), std::move(traced.irradiance));
    }
    RS_TRY(times_.draw(*loaded_->showroom, compositor_, camera, frame_s, work));
    print_warnings(loaded_->showroom->take_warnings());
    most_missing_ = std::max(most_missing_, compositor_.statistics().nodes_missing);
    return compositor_.image();
}

void HeadlessRenderer::warn_of_missing_objects(std::int64_t memory_mib) const {
    if (most_missing_ == 0) return;
    print_warnings({std::to_string(most_missing_) + " objects in view do not fit into --memory " +
                    std::to_string(memory_mib) + " and are shown as placeholders"});
}

}  // namespace rs::compositor
