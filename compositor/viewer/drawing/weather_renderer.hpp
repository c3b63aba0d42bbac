#pragma once
// Draws rain and snow (weather_shaders.hpp): depth-tested, blended, lit by the sky and nearby lamps. Deterministic in
// seed, time and camera.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/weather.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

#include <vector>

namespace rs::compositor {

/// Requires a current gl::Context that outlives it; single-threaded, move-only.
class WeatherRenderer {
public:
    /// \param scene its lights must be punctual.
    static Result<WeatherRenderer> create(const Scene& scene);

    /// Draws particles at distances [nearest, beyond) from the eye. Draws nothing if the weather is fog alone.
    void draw(const Weather& weather, double seconds, const FrameView& view, double nearest, double beyond) const;

private:
    explicit WeatherRenderer(gl::Program program);

    gl::Program program_;
    gl::VertexArray drops_;
    gl::VertexArray flakes_;
    glm::vec3 sky_light_{0};
    std::vector<Light> lamps_;  // point and spot lights
};

}  // namespace rs::compositor
