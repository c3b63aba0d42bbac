#include "compositor/viewer/drawing/frame_compositor.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/scene/light/raster_lights.hpp"
#include "compositor/viewer/drawing/background_shaders.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "compositor/viewer/views/engine_views.hpp"
#include "engine/core/views/depth_image.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::compositor {
namespace {

// How much of an object's own light is left at a distance.
float kept_in_fog(const std::optional<Fog>& fog, double distance) {
    if (!fog) return 1;
    if (distance >= fog->visibility) return 0;
    const double left = fog->visibility - distance;
    return static_cast<float>(fog->kind == FogKind::kLinear ? left / fog->visibility : std::exp(-distance / left));
}

bool placeholder_in_view(const ShownNode& node, const FrameView& view) {
    return node.placeholder && !node.hidden && may_be_seen(bounds_of(*node.placeholder), view.clip_from_world);
}

// Seconds from lap to lap; of all that was drawn until then if `waits`, else of giving it to the driver.
class PartClock {
public:
    explicit PartClock(bool waits) : waits_(waits) {}
    double lap() {
        if (waits_) gl::finish();
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    bool waits_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

Result<FrameCompositor::Frame> FrameCompositor::Frame::create(int width, int height, int samples) {
    RS_ASSIGN_OR_RETURN(auto drawn, gl::Framebuffer::create(width, height, samples));
    if (drawn.samples() == 1) return Frame{std::move(drawn), std::nullopt};
    RS_ASSIGN_OR_RETURN(auto resolved, gl::Framebuffer::create(width, height, 1));
    return Frame{std::move(drawn), std::move(resolved)};
}

Result<FrameCompositor> FrameCompositor::create(const Scene& lit_scene, std::shared_ptr<engine::RenderSession> engine,
                                                std::shared_ptr<const ShownNodes> nodes, const FrameOptions& options) {
    Scene scene = lit_scene;
    scene.lights = raster_lights(lit_scene, options.exposure_ev);
    RS_ASSIGN_OR_RETURN(auto background, BackgroundRenderer::create(scene.background));
    RS_ASSIGN_OR_RETURN(auto lit, LitGeometry::create(scene, *nodes, options.shadows));
    RS_ASSIGN_OR_RETURN(auto weather, WeatherRenderer::create(scene));
    RS_ASSIGN_OR_RETURN(auto traced,
                        gl::Program::create("traced image", shaders::kWholeFrameVertex, shaders::kImageFragment));
    RS_ASSIGN_OR_RETURN(auto objects, ObjectRenderer::create(nodes->size(), options.object_depth));
    RS_ASSIGN_OR_RETURN(auto placeholders, PlaceholderRenderer::create());
    RS_ASSIGN_OR_RETURN(auto frame, Frame::create(options.width, options.height, options.samples));
    return FrameCompositor(scene, std::move(engine), std::move(nodes),
                           {std::move(traced), std::move(objects), std::move(placeholders), std::move(background),
                            std::move(lit), std::move(weather), std::move(frame)},
                           options);
}

Result<FrameCompositor> FrameCompositor::create(const Scene& scene, const std::vector<PlacedObject>& objects,
                                                const FrameOptions& options) {
    const auto engine = std::make_shared<engine::RenderSession>(limits_of_viewer());
    RS_ASSIGN_OR_RETURN(std::shared_ptr<const ShownNodes> nodes, show_all(objects, *engine));
    return create(scene, engine, std::move(nodes), options);
}

FrameCompositor::FrameCompositor(const Scene& scene, std::shared_ptr<engine::RenderSession> engine,
                                 std::shared_ptr<const ShownNodes> nodes, Renderers renderers,
                                 const FrameOptions& options)
    : fog_(scene.fog),
      engine_(std::move(engine)),
      nodes_(std::move(nodes)),
      turns_rad_(nodes_->size()),
      renderers_(std::move(renderers)),
      wire_frame_(options.wire_frame),
      time_parts_(options.time_parts),
      samples_(options.samples),
      object_depth_(options.object_depth),
      object_samples_(options.object_samples),
      upright_images_(options.upright_images),
      rectangle_(4) {}

Status FrameCompositor::set_lights(const Scene& scene, double exposure_ev) {
    Scene lit_scene = scene;
    lit_scene.lights = raster_lights(scene, exposure_ev);
    return renderers_.lit.set_lights(lit_scene, *nodes_);
}

Result<Image<Rgba8>> FrameCompositor::compose(const Camera& camera) {
    RS_TRY(draw(camera));
    return image();
}

std::optional<ObjectView> FrameCompositor::view_of_node(std::size_t index, const Camera& camera) const {
    const ShownNode& node = (*nodes_)[index];
    if (!node.object || node.hidden) return std::nullopt;
    return view_of_object(turned(index), camera, {object_samples_, upright_images_});
}

PlacedObject FrameCompositor::turned(std::size_t index) const {
    PlacedObject placed = *(*nodes_)[index].object;
    const double angle = placed.world_from_object.mirrors() ? -turns_rad_[index] : turns_rad_[index];
    placed.world_from_object = placed.world_from_object * NodeTransform{.angle_rad = angle}.parent_from_node();
    return placed;
}

std::vector<FrameCompositor::SeenNode> FrameCompositor::seen_nodes(const Camera& camera) const {
    std::vector<SeenNode> seen;
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        if (auto view = view_of_node(i, camera)) seen.push_back({i, *view, {}});
    }
    return seen;
}

Status FrameCompositor::draw(const Camera& camera) {
    return draw(camera, TracedDepths::kWhereBlended);
}

Status FrameCompositor::ensure_depths() {
    if (!camera_ || statistics_.has_depths) return {};
    return draw(*camera_, TracedDepths::kAlways);
}

bool FrameCompositor::blends_something(const std::vector<SeenNode>& seen, const FrameView& view) const {
    return !seen.empty() || fog_ || weather_ || renderers_.lit.surfaces().has_transparent() ||
           std::ranges::any_of(*nodes_, [&](const ShownNode& node) { return placeholder_in_view(node, view); });
}

Status FrameCompositor::draw(const Camera& camera, TracedDepths depths) {
    RS_CHECK(camera.width == width() && camera.height == height());
    const FrameView view = view_of_frame(camera);
    statistics_ = {};
    statistics_.nodes.resize(nodes_->size());
    camera_ = camera;
    PartClock clock(time_parts_);
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        if (!(*nodes_)[i].object) renderers_.objects.release(i);
    }
    std::vector<SeenNode> seen = seen_nodes(camera);
    statistics_.nodes_not_seen = static_cast<int>(nodes_->size() - seen.size());
    std::vector<engine::ViewRequest> requests;
    for (const SeenNode& node : seen) {
        requests.push_back({(*nodes_)[node.index].handle, node.view.camera, object_depth_ == ObjectDepth::kPixel});
    }
    EngineViews views(*engine_);
    RS_TRY(views.submit(std::move(requests)));

    // Under a traced image only what is blended is lit here.
    const bool lights_something = !traced_ || renderers_.lit.surfaces().has_transparent();
    if (shadows() && lights_something) statistics_.shadow_maps_drawn = renderers_.lit.draw_shadows(shadow_casters());
    statistics_.shadows_s = clock.lap();
    const bool depth_is_there = traced_ && depth_from_ == view.clip_from_world;
    statistics_.has_depths =
        !traced_ || depth_is_there || depths == TracedDepths::kAlways || blends_something(seen, view);
    renderers_.frame.drawn.begin(renderers_.background.zenith(), depth_is_there);
    const bool draws_geometry = statistics_.has_depths && !depth_is_there;
    const OpaquePass pass = !draws_geometry ? OpaquePass::kNone : traced_ ? OpaquePass::kDepthOnly : OpaquePass::kLit;
    const auto transparent = renderers_.lit.surfaces().draw_opaque(view, wire_frame_, pass);
    statistics_.geometry_in_view = renderers_.lit.surfaces().nodes_in_view();
    const FloorRenderer* const floor = renderers_.lit.floor();
    if (floor != nullptr && draws_geometry) floor->draw(view);
    depth_from_.reset();
    if (traced_ && statistics_.has_depths && object_depth_ == ObjectDepth::kPlane) depth_from_ = view.clip_from_world;
    if (traced_) {
        draw_traced(camera);
        renderers_.lit.surfaces().draw_fog(view);
    } else if (!renderers_.background.plain()) {
        renderers_.background.draw(camera, BackgroundArea::kBehindGeometry);
    }
    gl::flush();
    statistics_.geometry_s = clock.lap();

    RS_ASSIGN_OR_RETURN(std::vector<engine::DrawnView> drawn, views.retrieve());
    statistics_.engine_wait_s = clock.lap();
    for (std::size_t n = 0; n < seen.size(); ++n) {
        seen[n].drawn = std::move(drawn[n]);
        upload(seen[n]);
    }
    statistics_.upload_s = clock.lap();
    draw_blended(transparent, seen, view);
    if (const auto& resolved = renderers_.frame.resolved) renderers_.frame.drawn.resolve_to(*resolved);
    statistics_.composite_s = clock.lap();
    return {};
}

// Everything that is blended, the farthest first; of the same distance geometry before objects.
void FrameCompositor::draw_blended(const std::vector<SurfaceRenderer::Transparent>& surfaces,
                                   const std::vector<SeenNode>& nodes, const FrameView& view) {
    struct Blended {
        double distance;
        const SurfaceRenderer::Transparent* surface;
        const SeenNode* node;
        const Placeholder* placeholder;
    };
    std::vector<Blended> blended;
    for (const auto& surface : surfaces) blended.push_back({surface.distance, &surface, nullptr, nullptr});
    for (const SeenNode& node : nodes) blended.push_back({node.view.plane_distance, nullptr, &node, nullptr});
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        if (!placeholder_in_view((*nodes_)[i], view)) continue;
        const auto& placeholder = (*nodes_)[i].placeholder;
        statistics_.nodes[i].missing = !(*nodes_)[i].object;
        statistics_.nodes_missing += statistics_.nodes[i].missing ? 1 : 0;
        const double distance = glm::distance(placeholder->world_from_object.translation, view.camera.centre());
        blended.push_back({distance, nullptr, nullptr, &*placeholder});
    }
    std::stable_sort(blended.begin(), blended.end(),
                     [](const Blended& a, const Blended& b) { return a.distance > b.distance; });
    // What falls is drawn by distance between them, for objects leave no depth.
    double beyond = std::numeric_limits<double>::infinity();
    const auto fall = [&](double nearest) {
        if (weather_ && nearest < beyond) renderers_.weather.draw(*weather_, weather_seconds_, view, nearest, beyond);
        beyond = std::min(beyond, nearest);
    };
    for (const Blended& item : blended) {
        if (item.node != nullptr || item.placeholder != nullptr) fall(item.distance);
        if (item.surface != nullptr) renderers_.lit.surfaces().draw_transparent(*item.surface, view, wire_frame_);
        if (item.node != nullptr) draw_object(*item.node);
        if (item.placeholder != nullptr) renderers_.placeholders.draw(*item.placeholder, view);
    }
    fall(0);
}

Status FrameCompositor::resize(int width, int height) {
    RS_ASSIGN_OR_RETURN(auto frame, Frame::create(width, height, samples_));
    renderers_.frame = std::move(frame);
    camera_.reset();
    depth_from_.reset();
    return {};
}

void FrameCompositor::turn_object(std::size_t index, double angle_rad) {
    turns_rad_[index] = angle_rad;
}

Status FrameCompositor::draw_handles(const std::vector<HandleStroke>& strokes) {
    RS_CHECK(camera_.has_value());
    if (Status there = ensure_depths(); !there) return there;
    if (!handles_) {
        RS_ASSIGN_OR_RETURN(auto made, HandleRenderer::create());
        handles_ = std::move(made);
    }
    return handles_->draw(strokes, *camera_, renderers_.frame.shown(), renderers_.frame.drawn);
}

std::optional<SurfacePoint> FrameCompositor::surface_at(int x, int y) {
    constexpr int kAround = kDepthsAcross / 2;
    if (!camera_ || x < kAround || y < kAround || x >= width() - kAround || y >= height() - kAround) {
        return std::nullopt;
    }
    if (!ensure_depths()) return std::nullopt;
    const Frame& frame = renderers_.frame;
    const std::vector<float> depths =
        frame.drawn.depths_at(x - kAround, y - kAround, kDepthsAcross, kDepthsAcross, frame.shown());
    DepthsAround inverse{};
    for (std::size_t i = 0; i < inverse.size(); ++i) inverse[i] = static_cast<double>(depths[i]) / kNear;
    return surface_from_depths(*camera_, x, y, inverse);
}

std::optional<double> FrameCompositor::distance_ahead() {
    if (!ensure_depths()) return std::nullopt;
    const float depth = renderers_.frame.depth_at(width() / 2, height() / 2);
    if (!(depth > 0)) return std::nullopt;
    return kNear / depth;
}

std::optional<std::size_t> FrameCompositor::object_at(int x, int y) const {
    if (!camera_ || x < 0 || y < 0 || x >= width() || y >= height()) return std::nullopt;
    const double geometry = renderers_.frame.depth_at(x, y);  // kNear / distance, 0 where there is none
    const glm::dvec3 position(x + 0.5, y + 0.5, 1);
    std::optional<std::size_t> nearest;
    double nearest_distance = 0;
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        const auto view = view_of_node(i, *camera_);
        if (!view || (nearest && view->plane_distance >= nearest_distance)) continue;
        const ScreenRectangle& area = view->rectangle;
        if (x < area.x || y < area.y || x >= area.x + area.width || y >= area.y + area.height) continue;
        if (glm::dot(view->inverse_depth_facing, position) * kNear < geometry) continue;  // hidden
        const auto at = view->image_pixel(x, y);
        if (!at) continue;
        Camera pixel = view->camera;
        pixel.cx -= at->x;
        pixel.cy -= at->y;
        pixel.width = 1;
        pixel.height = 1;
        EngineViews views(*engine_);
        if (!views.submit({{(*nodes_)[i].handle, pixel}})) continue;
        const Result<std::vector<engine::DrawnView>> drawn = views.retrieve();
        if (!drawn || drawn->front().image(0, 0).a < 128) continue;
        nearest = i;
        nearest_distance = view->plane_distance;
    }
    return nearest;
}

void FrameCompositor::draw_traced(const Camera& camera) {
    RS_CHECK(traced_->width() == width() && traced_->height() == height());
    renderers_.background.draw(camera, BackgroundArea::kWholeFrame);
    const gl::Texture texture(width(), height());
    texture.upload(traced_->view());
    texture.bind(1);
    gl::draw(renderers_.traced, rectangle_,
             {.depth_test = false, .depth_write = false, .blending = gl::Blending::kOverPremultiplied});
}

std::vector<std::optional<PlacedObject>> FrameCompositor::shadow_casters() const {
    constexpr float kThere = 0.5F;  // opacity from which on an object that fades in throws its shadow
    std::vector<std::optional<PlacedObject>> objects(nodes_->size());
    for (std::size_t i = 0; i < nodes_->size(); ++i) {
        const ShownNode& node = (*nodes_)[i];
        if (node.object && !node.hidden && node.opacity >= kThere) objects[i] = turned(i);
    }
    return objects;
}

void FrameCompositor::upload(const SeenNode& node) {
    const engine::DrawnView& drawn = node.drawn;
    Image<float> depths;
    if (object_depth_ == ObjectDepth::kPixel) {
        const RaySpaceObject& object = (*nodes_)[node.index].object->object->renderer.object();
        depths = engine::depth_image(object, node.view.camera, drawn.depth_q20);
    }
    renderers_.objects.upload(node.index, node.view, drawn.image, depths);
    const int width = drawn.image.width();
    const int height = drawn.image.height();
    statistics_.nodes[node.index] = {true, width, height, drawn.seconds, drawn.by_board};
    statistics_.engine_s += drawn.seconds;
    statistics_.nodes_rendered += 1;
    statistics_.nodes_by_board += drawn.by_board ? 1 : 0;
    statistics_.pixels_rendered += std::int64_t{width} * height;
}

void FrameCompositor::draw_object(const SeenNode& node) const {
    renderers_.objects.draw(node.index, node.view,
                            {.screen_px = {width(), height()},
                             .fog = fog_ ? fog_->colour : glm::vec3(0),
                             .own_light = kept_in_fog(fog_, node.view.plane_distance),
                             .opacity = (*nodes_)[node.index].opacity});
}

}  // namespace rs::compositor
