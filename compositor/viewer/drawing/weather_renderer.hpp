#pragma once
// Draws rain and snow (weather_shaders.hpp): tested against the depth of what is drawn already, blended over it, lit by
// the sky and the lamps near by. The same seed, time and camera give the same image.

#include "compositor/gl/program.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/scene/weather.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"
#include "rayspace/base/result.hpp"

#include <vector>

namespace rs::compositor {

// Needs a gl::Context that is current, and outlives it; one thread. Move-only.
class WeatherRenderer {
public:
    // By the lights of the scene, which are punctual.
    static Result<WeatherRenderer> create(const Scene& scene);

    // What is at distances [nearest, beyond) from the eye. Nothing in fog alone.
    void draw(const Weather& weather, double seconds, const FrameView& view, double nearest, double beyond) const;

private:
    explicit WeatherRenderer(gl::Program program);

    gl::Program program_;
    gl::VertexArray drops_;
    gl::VertexArray flakes_;
    glm::vec3 sky_light_{0};
    std::vector<Light> lamps_;  // points and spots
};

}  // namespace rs::compositor
