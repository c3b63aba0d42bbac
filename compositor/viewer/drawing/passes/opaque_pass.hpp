#pragma once
// Draws opaque geometry, the floor, and the background behind them; nothing under a traced image, which has them.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

class OpaquePass {
public:
    Status run(FrameContext& frame) const;
};

}  // namespace rs::compositor
