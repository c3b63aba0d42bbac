#include "compositor/viewer/drawing/passes/overlay_pass.hpp"

namespace rs::compositor {

Status OverlayPass::run(FrameContext& frame) {
    if (!renderer_) {
        RS_ASSIGN_OR_RETURN(auto created, HandleRenderer::create());
        renderer_ = std::move(created);
    }
    return renderer_->draw(strokes_, frame.view.camera, frame.target.shown(), frame.target.drawn);
}

}  // namespace rs::compositor
