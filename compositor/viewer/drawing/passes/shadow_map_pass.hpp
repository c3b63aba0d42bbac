#pragma once
// Redraws the shadow maps in which something has changed.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

class ShadowMapPass {
public:
    Status run(FrameContext& frame) const;
};

}  // namespace rs::compositor
