#pragma once
// Draws opaque geometry, the floor and the background; nothing under a traced image, which contains them.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

class OpaquePass {
public:
    Status run(FrameContext& frame) const;
};

}  // namespace rs::compositor
