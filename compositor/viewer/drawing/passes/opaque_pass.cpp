#include "compositor/viewer/drawing/passes/opaque_pass.hpp"

namespace rs::compositor {

Status OpaquePass::run(FrameContext& frame) const {
    if (frame.traced != nullptr) return {};
    frame.transparent_surfaces = frame.geometry.surfaces().draw_opaque(frame.view, frame.wire_frame, OpaqueMode::kLit);
    if (frame.geometry.floor() != nullptr) frame.geometry.floor()->draw(frame.view);
    if (!frame.background.plain()) frame.background.draw(frame.view.camera, BackgroundArea::kBehindGeometry);
    return {};
}

}  // namespace rs::compositor
