#include "compositor/viewer/drawing/passes/object_passes.hpp"

#include "compositor/gl/draw.hpp"
#include "engine/core/definition/view_registers.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace rs::compositor {
namespace {

// Width of a screen pixel at the middle of the object, in pixels of its image.
double pixel_in_image(const ObjectView& view) {
    const auto place = [&](double x, double y) {
        const glm::dvec3 p = view.image_from_screen * glm::dvec3(x, y, 1);
        return glm::dvec2(p) / p.z;
    };
    const double x = view.rectangle.x + 0.5 * view.rectangle.width, y = view.rectangle.y + 0.5 * view.rectangle.height;
    return glm::distance(place(x - 0.5, y), place(x + 0.5, y));
}

Image<Rgba8> as_cartoon(const Image<Rgba8>& image, const ObjectCartoon& style, const ObjectView& view,
                        const Camera& camera) {
    const double line_px = style.line_width ? *style.line_width * camera.fl_x / view.plane_distance : 1;
    const double pixel = pixel_in_image(view);
    return cartoon_of(image, style, pixel, line_px * pixel);
}

}  // namespace

Status ObjectRequestPass::run(FrameContext& frame) const {
    std::vector<engine::ViewRequest> requests;
    for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
        auto view = frame.nodes.view_of(i, frame.view.camera);
        if (!view) continue;
        requests.push_back({frame.nodes[i].handle, view->camera, depths_, may_defer_});
        frame.visible_nodes.push_back({i, *view});
    }
    frame.statistics.nodes_not_seen = static_cast<int>(frame.nodes.size() - frame.visible_nodes.size());
    return frame.engine_views.submit(std::move(requests));
}

Result<ObjectPass> ObjectPass::create(std::size_t nodes, ObjectDepth depth,
                                      std::shared_ptr<const ObjectCartoon> cartoon) {
    RS_ASSIGN_OR_RETURN(auto objects, ObjectRenderer::create(nodes, depth));
    RS_ASSIGN_OR_RETURN(auto placeholders, PlaceholderRenderer::create());
    return ObjectPass(std::move(objects), std::move(placeholders), std::move(cartoon));
}

Status ObjectPass::run(FrameContext& frame) {
    gl::flush();
    frame.statistics.geometry_s = frame.clock.lap();
    release_unloaded(frame.nodes);
    RS_ASSIGN_OR_RETURN(const std::vector<engine::DrawnView> rendered, frame.engine_views.retrieve());
    frame.statistics.engine_wait_s = frame.clock.lap();
    for (std::size_t n = 0; n < frame.visible_nodes.size(); ++n) {
        const VisibleNode& node = frame.visible_nodes[n];
        RS_TRY(add_image(node, rendered[n], frame));
        frame.blended.push_back({node.view.plane_distance, true, [this, &node, &frame] { draw(node, frame); }});
    }
    frame.target.drawn.resume();  // targets of objects may have begun
    add_placeholders(frame);
    frame.statistics.upload_s = frame.clock.lap();
    return {};
}

void ObjectPass::release_unloaded(const ObjectNodes& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].object) objects_.release(i);
    }
}

Status ObjectPass::add_image(const VisibleNode& node, const engine::DrawnView& rendered, FrameContext& frame) {
    const auto begin = std::chrono::steady_clock::now();
    const auto* const deferred = dynamic_cast<const DeferredGpuView*>(rendered.deferred.get());
    RS_TRY(deferred != nullptr ? render(node, *deferred) : upload(node, rendered, frame));
    const double seconds = deferred == nullptr
                               ? rendered.seconds
                               : std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const int width = node.view.camera.width;
    const int height = node.view.camera.height;
    FrameStatistics& statistics = frame.statistics;
    statistics.nodes[node.index] = {true, width, height, seconds, rendered.by_board};
    statistics.engine_s += seconds;
    statistics.nodes_rendered += 1;
    statistics.nodes_by_board += rendered.by_board ? 1 : 0;
    statistics.pixels_rendered += std::int64_t{width} * height;
    return {};
}

Status ObjectPass::upload(const VisibleNode& node, const engine::DrawnView& rendered, const FrameContext& frame) {
    const Image<Rgba8> cartoon =
        cartoon_ ? as_cartoon(rendered.image, *cartoon_, node.view, frame.view.camera) : Image<Rgba8>();
    return objects_.upload(node.index, node.view, cartoon_ ? cartoon : rendered.image, rendered.depth_q20);
}

Status ObjectPass::render(const VisibleNode& node, const DeferredGpuView& deferred) {
    if (!gpu_) {
        RS_ASSIGN_OR_RETURN(gpu_, GpuRenderer::create({.memory_bytes = deferred.memory_bytes}));
    }
    RS_ASSIGN_OR_RETURN(const gl::IntegerTarget* const target, objects_.target(node.index, node.view));
    RS_ASSIGN_OR_RETURN(const std::vector<PixelRect> visible, gpu_->draw(deferred.object, deferred.registers, *target));
    objects_.set_drawn(node.index, node.view, visible);
    return {};
}

void ObjectPass::draw(const VisibleNode& node, const FrameContext& frame) const {
    std::optional<ObjectRenderer::Relight> relight;
    if (frame.irradiance) {
        const PlacedObject placed = frame.nodes.turned(node.index);
        if (const auto scene = frame.irradiance(placed)) {
            relight = ObjectRenderer::relight_of(placed, frame.view.camera, *scene);
        }
    }
    const RaySpaceObject& object = frame.nodes[node.index].object->object->renderer.object();
    objects_.draw(node.index, node.view,
                  {.screen_px = {frame.target.drawn.width(), frame.target.drawn.height()},
                   .fog = frame.fog ? frame.fog->colour : glm::vec3(0),
                   .own_light = frame.fog ? fog_transmittance(*frame.fog, node.view.plane_distance) : 1.0F,
                   .opacity = frame.nodes[node.index].opacity,
                   .relight = relight,
                   .depth_scale = engine::depth_scale(object, node.view.camera)});
}

void ObjectPass::add_placeholders(FrameContext& frame) const {
    for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
        if (!frame.nodes.placeholder_in_view(i, frame.view)) continue;
        const Placeholder& placeholder = *frame.nodes[i].placeholder;
        frame.statistics.nodes[i].missing = !frame.nodes[i].object;
        frame.statistics.nodes_missing += frame.statistics.nodes[i].missing ? 1 : 0;
        const double distance = glm::distance(placeholder.world_from_object.translation, frame.view.camera.centre());
        frame.blended.push_back(
            {distance, true, [this, &placeholder, &frame] { placeholders_.draw(placeholder, frame.view); }});
    }
}

}  // namespace rs::compositor
