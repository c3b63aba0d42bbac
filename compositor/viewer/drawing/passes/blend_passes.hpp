#pragma once
// Passes that blend over opaque geometry, in their order in the frame, and the overlay.

#include "compositor/viewer/drawing/handle_renderer.hpp"
#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "compositor/viewer/drawing/weather_renderer.hpp"
#include "rayspace/base/result.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace rs::compositor {

/// Adds the transparent surfaces of geometry to the blended draws and sorts these back to front; at equal distance,
/// surfaces come before objects.
class TransparentPass {
public:
    Status run(FrameContext& frame) const;
};

/// Inserts layers of rain and snow between the blended draws: one behind each object, since objects may write no depth
/// that drops could be tested against, and one between the nearest object and the camera.
/// Requires a current gl::Context that outlives it; move-only.
class WeatherPass {
public:
    static Result<WeatherPass> create(const Scene& scene);
    /// Requires sorted blended draws. The pass must not move until they are done.
    Status run(FrameContext& frame) const;

private:
    explicit WeatherPass(WeatherRenderer weather) : weather_(std::move(weather)) {}
    WeatherRenderer weather_;
};

/// Performs the blended draws in their order and averages the samples of the frame.
class BlendPass {
public:
    Status run(FrameContext& frame) const;
};

/// Draws the handles of lights over a copy of the finished frame.
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
