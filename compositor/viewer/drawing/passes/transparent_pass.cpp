#include "compositor/viewer/drawing/passes/transparent_pass.hpp"

#include <algorithm>

namespace rs::compositor {

Status TransparentPass::run(FrameContext& frame) const {
    for (const SurfaceRenderer::Transparent& surface : frame.transparent_surfaces) {
        frame.blended.push_back({surface.distance, false, [&surface, &frame] {
                                     frame.geometry.surfaces().draw_transparent(surface, frame.view, frame.wire_frame);
                                 }});
    }
    std::ranges::stable_sort(frame.blended, [](const BlendedDraw& a, const BlendedDraw& b) {
        if (a.distance != b.distance) return a.distance > b.distance;
        return !a.is_object && b.is_object;
    });
    return {};
}

}  // namespace rs::compositor
