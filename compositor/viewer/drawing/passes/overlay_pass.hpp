#pragma once
// Draws the handles of lights over a copy of the finished frame, so that the frame itself stays without them.

#include "compositor/viewer/drawing/handle_renderer.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it. Move-only.
class OverlayPass {
public:
    /// For the next run().
    void set_handles(std::vector<HandleStroke> strokes) { strokes_ = std::move(strokes); }
    /// The frame must have depths. Fails if the driver refuses a shader or a framebuffer.
    Status run(FrameContext& frame);
    /// The copy with the handles; null before the first run().
    [[nodiscard]] const HandleRenderer* handles() const { return renderer_ ? &*renderer_ : nullptr; }

private:
    std::vector<HandleStroke> strokes_;
    std::optional<HandleRenderer> renderer_;  // created by the first run()
};

}  // namespace rs::compositor
