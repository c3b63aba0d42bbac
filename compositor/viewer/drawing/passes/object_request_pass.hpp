#pragma once
// First pass of a frame: determines which objects are visible and submits their views to the engine, which renders them
// while geometry is drawn.
//
// The camera is transformed into each node's coordinates (equation 3); only the pixels that the node can cover are
// requested.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

class ObjectRequestPass {
public:
    /// \param depths request a depth per pixel
    explicit ObjectRequestPass(bool depths) : depths_(depths) {}
    /// Fails if the engine rejects a view; the error names the object.
    Status run(FrameContext& frame) const;

private:
    bool depths_;
};

}  // namespace rs::compositor
