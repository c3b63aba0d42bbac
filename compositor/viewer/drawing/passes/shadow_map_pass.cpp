#include "compositor/viewer/drawing/passes/shadow_map_pass.hpp"

namespace rs::compositor {

Status ShadowMapPass::run(FrameContext& frame) const {
    // Under a traced image only transparent surfaces are lit.
    const bool lights_something = frame.traced == nullptr || frame.geometry.surfaces().has_transparent();
    if (frame.geometry.shadows() && lights_something) {
        frame.statistics.shadow_maps_drawn = frame.geometry.draw_shadows(frame.nodes.shadow_casters());
    }
    frame.statistics.shadows_s = frame.clock.lap();
    return {};
}

}  // namespace rs::compositor
