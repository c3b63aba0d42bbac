#pragma once
// Adds the transparent surfaces of geometry to the blended draws and sorts these back to front; at equal distance,
// surfaces come before objects.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

class TransparentPass {
public:
    Status run(FrameContext& frame) const;
};

}  // namespace rs::compositor
