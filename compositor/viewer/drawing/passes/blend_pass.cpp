#include "compositor/viewer/drawing/passes/blend_pass.hpp"

namespace rs::compositor {

Status BlendPass::run(FrameContext& frame) const {
    for (const BlendedDraw& item : frame.blended) item.draw();
    if (frame.target.resolved) frame.target.drawn.resolve_to(*frame.target.resolved);
    frame.statistics.composite_s = frame.clock.lap();
    return {};
}

}  // namespace rs::compositor
