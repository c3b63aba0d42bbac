#include "compositor/viewer/drawing/passes/geometry_passes.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gl/texture.hpp"
#include "compositor/viewer/drawing/background_shaders.hpp"
#include "compositor/viewer/drawing/shaders.hpp"

namespace rs::compositor {
namespace {

bool blends_something(const FrameContext& frame) {
    if (!frame.visible_nodes.empty() || frame.fog || frame.weather || frame.geometry.surfaces().has_transparent())
        return true;
    for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
        if (frame.nodes.placeholder_in_view(i, frame.view)) return true;
    }
    return false;
}

}  // namespace

Status ShadowMapPass::run(FrameContext& frame) const {
    // Under a traced image only transparent surfaces are lit.
    const bool lights_something = frame.traced == nullptr || frame.geometry.surfaces().has_transparent();
    if (frame.geometry.shadows() && lights_something) {
        frame.statistics.shadow_maps_drawn =
            frame.geometry.draw_shadows(frame.view.camera.centre(), frame.nodes.shadow_casters());
    }
    frame.statistics.shadows_s = frame.clock.lap();
    return {};
}

Status DepthPass::run(FrameContext& frame) {
    const bool traced = frame.traced != nullptr;
    const bool held = traced && depth_view_ == frame.view.clip_from_world;
    const bool has_depths = !traced || held || frame.needs_depths || blends_something(frame);
    depth_view_.reset();
    if (traced && has_depths && !objects_write_depth_) depth_view_ = frame.view.clip_from_world;
    frame.statistics.has_depths = has_depths;
    frame.target.drawn.begin(frame.background.zenith(), held);
    if (!traced) return {};
    const bool draws = has_depths && !held;
    frame.transparent_surfaces = frame.geometry.surfaces().draw_opaque(
        frame.view, frame.wire_frame, draws ? OpaqueMode::kDepthOnly : OpaqueMode::kNone);
    if (draws && frame.geometry.floor() != nullptr) frame.geometry.floor()->draw(frame.view);
    return {};
}

Status OpaquePass::run(FrameContext& frame) const {
    if (frame.traced != nullptr) return {};
    frame.transparent_surfaces = frame.geometry.surfaces().draw_opaque(frame.view, frame.wire_frame, OpaqueMode::kLit);
    if (frame.geometry.floor() != nullptr) frame.geometry.floor()->draw(frame.view);
    if (!frame.background.plain()) frame.background.draw(frame.view.camera, BackgroundArea::kBehindGeometry);
    frame.area_lights.draw(frame.view, frame.fog);
    return {};
}

Result<TracedUnderlayPass> TracedUnderlayPass::create() {
    RS_ASSIGN_OR_RETURN(auto program,
                        gl::Program::create("traced image", shaders::kWholeFrameVertex, shaders::kImageFragment));
    return TracedUnderlayPass(std::move(program));
}

Status TracedUnderlayPass::run(FrameContext& frame) const {
    if (frame.traced == nullptr) return {};
    RS_CHECK(frame.traced->width() == frame.target.drawn.width() &&
             frame.traced->height() == frame.target.drawn.height());
    frame.background.draw(frame.view.camera, BackgroundArea::kWholeFrame);
    const gl::Texture texture(frame.traced->width(), frame.traced->height());
    texture.upload(frame.traced->view());
    texture.bind(1);
    gl::draw(program_, rectangle_,
             {.depth_test = false, .depth_write = false, .blending = gl::Blending::kOverPremultiplied});
    frame.geometry.surfaces().draw_fog(frame.view);
    return {};
}

}  // namespace rs::compositor
