#pragma once
// Passes that draw the background and the scene's opaque geometry, in their order in the frame.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <utility>

namespace rs::compositor {

/// Redraws the shadow maps in which something has changed.
class ShadowMapPass {
public:
    Status run(FrameContext& frame) const;
};

/// Captures the surroundings of reflective surfaces once (reflection_pass.cpp): a cube of images of the other opaque
/// surfaces, the floor and the background, from the centre of the reflective surfaces. Reflections then come from
/// infinitely far away. Does nothing in scenes without reflective surfaces. Runs after ShadowMapPass.
class ReflectionPass {
public:
    Status run(FrameContext& frame);
    /// The lighting has changed.
    void invalidate() { captured_ = false; }

private:
    bool captured_ = false;
};

/// Clears the frame. Under a traced image, draws the depths of geometry if something that is blended needs them and the
/// frame does not contain them already from the previous view.
class DepthPass {
public:
    /// \param objects_write_depth objects write depth, so that depths of geometry cannot be reused in the next frame
    explicit DepthPass(bool objects_write_depth) : objects_write_depth_(objects_write_depth) {}
    Status run(FrameContext& frame);
    /// Geometry or the framebuffer has changed: the depths of the last frame cannot be used again.
    void invalidate() { depth_view_.reset(); }

private:
    bool objects_write_depth_;
    std::optional<glm::dmat4> depth_view_;  // clip_from_world of the depths that the frame holds, of geometry alone
};

/// Draws opaque geometry, the floor, the background and area lights; nothing under a traced image, which contains them.
class OpaquePass {
public:
    Status run(FrameContext& frame) const;
};

/// Draws the traced image, if there is one, over the background, and the fog of opaque geometry over it.
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
