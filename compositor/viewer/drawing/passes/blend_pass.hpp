#pragma once
// Performs the blended draws in their order and averages the samples of the frame.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

class BlendPass {
public:
    Status run(FrameContext& frame) const;
};

}  // namespace rs::compositor
