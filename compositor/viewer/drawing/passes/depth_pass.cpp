#include "compositor/viewer/drawing/passes/depth_pass.hpp"

namespace rs::compositor {
namespace {

bool blends_something(const FrameContext& frame) {
    if (!frame.seen.empty() || frame.fog || frame.weather || frame.geometry.surfaces().has_transparent()) return true;
    for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
        if (frame.nodes.placeholder_in_view(i, frame.view)) return true;
    }
    return false;
}

}  // namespace

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

}  // namespace rs::compositor
