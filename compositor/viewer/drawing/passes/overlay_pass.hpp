#pragma once
// Draws the handles of lights over a copy of the finished frame.

#include "compositor/viewer/drawing/handle_renderer.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; move-only.
class OverlayPass {
public:
    /// Sets the handles that the next run() draws.
    void set_handles(std::vector<HandleStroke> strokes) { strokes_ = std::move(strokes); }
    /// The frame must have depths. Fails if the driver rejects a shader or a framebuffer.
    Status run(FrameContext& frame);
    /// The copy with the handles; null before the first run().
    [[nodiscard]] const HandleRenderer* handles() const { return renderer_ ? &*renderer_ : nullptr; }

private:
    std::vector<HandleStroke> strokes_;
    std::optional<HandleRenderer> renderer_;  // created by the first run()
};

}  // namespace rs::compositor
