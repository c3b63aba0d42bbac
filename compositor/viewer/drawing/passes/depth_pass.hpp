#pragma once
// Clears the frame. Under a traced image, draws the depths of geometry if something that is blended needs them and the
// frame does not contain them already from the previous view.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

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

}  // namespace rs::compositor
