#pragma once
// Clears the frame. Under a traced image, draws the depths of geometry, if something that is blended needs them and the
// frame does not hold them from the last view.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

class DepthPass {
public:
    /// \param objects_write_depth objects leave depths, so that those of geometry cannot be kept for the next frame
    explicit DepthPass(bool objects_write_depth) : objects_write_depth_(objects_write_depth) {}
    Status run(FrameContext& frame);
    /// Geometry or the framebuffer has changed: the depths of the last frame cannot be used again.
    void invalidate() { held_from_.reset(); }

private:
    bool objects_write_depth_;
    std::optional<glm::dmat4> held_from_;  // clip_from_world of the depths that the frame holds, of geometry alone
};

}  // namespace rs::compositor
