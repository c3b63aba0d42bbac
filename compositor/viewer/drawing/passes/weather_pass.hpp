#pragma once
// Inserts rain and snow between the blended draws: a layer before each object, because objects may leave no depth that
// drops could be tested against, and the last layer before the camera.

#include "compositor/viewer/drawing/passes/frame_context.hpp"
#include "compositor/viewer/drawing/weather_renderer.hpp"
#include "rayspace/base/result.hpp"

#include <utility>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it. Move-only.
class WeatherPass {
public:
    static Result<WeatherPass> create(const Scene& scene);
    /// The blended draws are in order. The pass must stay in place until they are done.
    Status run(FrameContext& frame) const;

private:
    explicit WeatherPass(WeatherRenderer weather) : weather_(std::move(weather)) {}
    WeatherRenderer weather_;
};

}  // namespace rs::compositor
