#include "compositor/viewer/drawing/passes/overlay_pass.hpp"

namespace rs::compositor {

Status OverlayPass::run(FrameContext& frame) {
    if (!renderer_) {
        Result<HandleRenderer> created = HandleRenderer::create();
        if (!created) return created.error();
        renderer_.emplace(std::move(*created));
    }
    return renderer_->draw(strokes_, frame.view.camera, frame.target.shown(), frame.target.drawn);
}

}  // namespace rs::compositor
