#include "compositor/viewer/drawing/frame_compositor.hpp"

#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/viewer/views/engine_views.hpp"

#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

// Runs the passes one after another until one fails.
template <class... Pass>
Status run_in_order(FrameContext& frame, Pass&... passes) {
    Status status;
    static_cast<void>((static_cast<bool>(status = passes.run(frame)) && ...));
    return status;
}

// The scene with raster lights and its environment, both scaled by the exposure.
Scene raster_scene(const Scene& scene, double exposure_ev) {
    Scene raster = scene;
    raster.lights = raster_lights(scene, exposure_ev);
    if (raster.environment) raster.environment->scale *= static_cast<float>(std::exp2(exposure_ev));
    return raster;
}

}  // namespace

Result<FrameCompositor::Passes> FrameCompositor::make_passes(const Scene& scene, std::size_t nodes,
                                                             const FrameOptions& options) {
    const bool has_object_depth = options.object_depth == ObjectDepth::kPixel;
    RS_ASSIGN_OR_RETURN(auto underlay, TracedUnderlayPass::create());
    RS_ASSIGN_OR_RETURN(auto objects, ObjectPass::create(nodes, options.object_depth, options.object_cartoon));
    RS_ASSIGN_OR_RETURN(auto weather, WeatherPass::create(scene));
    return Passes{.object_requests = ObjectRequestPass(has_object_depth, !options.object_cartoon),
                  .shadow_maps = {},
                  .reflections = {},
                  .depth = DepthPass(has_object_depth),
                  .opaque = {},
                  .underlay = std::move(underlay),
                  .objects = std::move(objects),
                  .transparent = {},
                  .weather = std::move(weather),
                  .blend = {},
                  .overlay = {}};
}

Result<FrameCompositor> FrameCompositor::create(const Scene& lit_scene, std::shared_ptr<engine::RenderSession> engine,
                                                std::shared_ptr<const DisplayedNodes> nodes,
                                                const FrameOptions& options) {
    const Scene scene = raster_scene(lit_scene, options.exposure_ev);
    RS_ASSIGN_OR_RETURN(auto background, BackgroundRenderer::create(scene.background));
    RS_TRY(background.set_environment(scene.environment));
    RS_ASSIGN_OR_RETURN(auto area_lights, AreaLightRenderer::create());
    area_lights.set_lights(lit_scene.lights, options.exposure_ev);
    RS_ASSIGN_OR_RETURN(auto geometry, LitGeometry::create(scene, *nodes, options.shadows));
    RS_ASSIGN_OR_RETURN(auto passes, make_passes(scene, nodes->size(), options));
    RS_ASSIGN_OR_RETURN(auto target, FrameTarget::create(options.width, options.height, options.samples));
    Parts parts{.engine = std::move(engine),
                .nodes = ObjectNodes(std::move(nodes), options.object_samples, options.upright_images),
                .background = std::move(background),
                .area_lights = std::move(area_lights),
                .geometry = std::move(geometry),
                .target = std::move(target),
                .passes = std::move(passes)};
    return FrameCompositor(std::move(parts), scene.fog, options);
}

Result<FrameCompositor> FrameCompositor::create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                                const FrameOptions& options) {
    const auto engine = std::make_shared<engine::RenderSession>(viewer_session_limits());
    RS_ASSIGN_OR_RETURN(std::shared_ptr<const DisplayedNodes> nodes, load_all_nodes(objects, *engine));
    return create(scene, engine, std::move(nodes), options);
}

FrameCompositor::FrameCompositor(Parts parts, const std::optional<Fog>& fog, const FrameOptions& options)
    : engine_(std::move(parts.engine)),
      nodes_(std::move(parts.nodes)),
      background_(std::move(parts.background)),
      area_lights_(std::move(parts.area_lights)),
      geometry_(std::move(parts.geometry)),
      target_(std::move(parts.target)),
      passes_(std::move(parts.passes)),
      fog_(fog),
      wire_frame_(options.wire_frame),
      time_parts_(options.time_parts),
      samples_(options.samples),
      relighting_(options.relighting) {}

Status FrameCompositor::set_lights(const Scene& scene, double exposure_ev) {
    const Scene lit_scene = raster_scene(scene, exposure_ev);
    RS_TRY(background_.set_environment(lit_scene.environment));
    area_lights_.set_lights(scene.lights, exposure_ev);
    passes_.reflections.invalidate();
    return geometry_.set_lights(lit_scene, nodes_.shown());
}

Result<Image<Rgba8>> FrameCompositor::compose(const Camera& camera) {
    RS_TRY(draw(camera));
    return image();
}

Status FrameCompositor::draw(const Camera& camera) {
    return draw(camera, false);
}

FrameContext FrameCompositor::context_of(const Camera& camera) {
    return {.view = view_of_frame(camera),
            .target = target_,
            .geometry = geometry_,
            .background = background_,
            .area_lights = area_lights_,
            .nodes = nodes_,
            .statistics = statistics_,
            .engine_views = EngineViews(*engine_),
            .clock = PartClock(time_parts_),
            .traced = traced_.get(),
            .wire_frame = wire_frame_,
            .weather = weather_,
            .weather_s = weather_seconds_,
            .fog = fog_,
            .irradiance = [this](const PlacedObject& placed) { return irradiance_at(placed); },
            .visible_nodes = {},
            .transparent_surfaces = {},
            .blended = {}};
}

std::optional<IrradianceHarmonics> FrameCompositor::irradiance_at(const PlacedObject& placed) {
    if (!traced_ && relighting_ == Relighting::kOn) return geometry_.irradiance_at(middle_of(placed));
    if (!traced_ || !traced_irradiance_) return std::nullopt;
    const IrradianceHarmonics* const nearest = nearest_irradiance(*traced_irradiance_, placed);
    return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

Status FrameCompositor::draw(const Camera& camera, bool needs_depths) {
    RS_CHECK(camera.width == width() && camera.height == height());
    statistics_ = {};
    statistics_.nodes.resize(nodes_.size());
    camera_ = camera;
    FrameContext frame = context_of(camera);
    frame.needs_depths = needs_depths;
    Status status = run_in_order(frame, passes_.object_requests, passes_.shadow_maps, passes_.reflections,
                                 passes_.depth, passes_.opaque, passes_.underlay, passes_.objects, passes_.transparent,
                                 passes_.weather, passes_.blend);
    statistics_.geometry_in_view = geometry_.surfaces().nodes_in_view();
    return status;
}

Status FrameCompositor::ensure_depths() {
    if (!camera_ || statistics_.has_depths) return {};
    return draw(*camera_, true);
}

Status FrameCompositor::draw_handles(const std::vector<HandleStroke>& strokes) {
    RS_CHECK(camera_.has_value());
    RS_TRY(ensure_depths());
    passes_.overlay.set_handles(strokes);
    FrameContext frame = context_of(*camera_);
    return passes_.overlay.run(frame);
}

Status FrameCompositor::resize(int width, int height) {
    RS_ASSIGN_OR_RETURN(auto target, FrameTarget::create(width, height, samples_));
    target_ = std::move(target);
    camera_.reset();
    passes_.depth.invalidate();
    return {};
}

std::optional<SurfacePoint> FrameCompositor::surface_at(int x, int y) {
    constexpr int kAround = kDepthsAcross / 2;
    if (!camera_ || x < kAround || y < kAround || x >= width() - kAround || y >= height() - kAround) {
        return std::nullopt;
    }
    if (!ensure_depths()) return std::nullopt;
    const std::vector<float> depths =
        target_.drawn.depths_at(x - kAround, y - kAround, kDepthsAcross, kDepthsAcross, target_.shown());
    DepthsAround inverse{};
    for (std::size_t i = 0; i < inverse.size(); ++i) inverse[i] = static_cast<double>(depths[i]) / kNear;
    return surface_from_depths(*camera_, x, y, inverse);
}

std::optional<double> FrameCompositor::distance_ahead() {
    if (!ensure_depths()) return std::nullopt;
    const float depth = target_.depth_at(width() / 2, height() / 2);
    if (!(depth > 0)) return std::nullopt;
    return kNear / depth;
}

// Renders this pixel with the engine.
bool FrameCompositor::is_opaque_at(std::size_t node, const ObjectView& view, const glm::ivec2& image_pixel) const {
    constexpr int kOpaque = 128;
    Camera pixel = view.camera;
    pixel.cx -= image_pixel.x;
    pixel.cy -= image_pixel.y;
    pixel.width = 1;
    pixel.height = 1;
    EngineViews views(*engine_);
    if (!views.submit({{nodes_[node].handle, pixel}})) return false;
    const Result<std::vector<engine::DrawnView>> rendered = views.retrieve();
    return rendered && rendered->front().image(0, 0).a >= kOpaque;
}

std::optional<std::size_t> FrameCompositor::object_at(int x, int y) const {
    if (!camera_ || x < 0 || y < 0 || x >= width() || y >= height()) return std::nullopt;
    const double geometry = target_.depth_at(x, y);  // kNear / distance, 0 if there is none
    const glm::dvec3 position(x + 0.5, y + 0.5, 1);
    std::optional<std::size_t> nearest;
    double nearest_distance = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const auto view = nodes_.view_of(i, *camera_);
        if (!view || (nearest && view->plane_distance >= nearest_distance)) continue;
        const ScreenRectangle& area = view->rectangle;
        if (x < area.x || y < area.y || x >= area.x + area.width || y >= area.y + area.height) continue;
        if (glm::dot(view->inverse_depth_facing, position) * kNear < geometry) continue;  // hidden
        const auto at = view->image_pixel(x, y);
        if (!at || !is_opaque_at(i, *view, *at)) continue;
        nearest = i;
        nearest_distance = view->plane_distance;
    }
    return nearest;
}

}  // namespace rs::compositor
