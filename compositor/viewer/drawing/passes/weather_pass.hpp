#pragma once
// Inserts layers of rain and snow between the blended draws: one behind each object, since objects may write no depth
// that drops could be tested against, and one between the nearest object and the camera.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "compositor/viewer/drawing/weather_renderer.hpp"
#include "rayspace/base/result.hpp"

#include <utility>

namespace rs::compositor {

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

}  // namespace rs::compositor
