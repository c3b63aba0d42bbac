#pragma once
// Draws the traced image, if there is one, over the background, and the fog of opaque geometry over it.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

#include <utility>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; move-only.
class TracedUnderlayPass {
public:
    static Result<TracedUnderlayPass> create();
    Status run(FrameContext& frame) const;

private:
    explicit TracedUnderlayPass(gl::Program program) : program_(std::move(program)), rectangle_(4) {}
    gl::Program program_;
    gl::VertexArray rectangle_;
};

}  // namespace rs::compositor
