#include "capture/tracer/session/sensor.hpp"

#include "capture/tracer/session/seeded_draws.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

Image<Rgba8> expose(ConstImageView<RgbaF> light, const Sensor& sensor) {
    SeededDraws draws(sensor.seed, 0);
    const auto code = [&](float linear) {
        const float exposed = std::clamp(linear * static_cast<float>(sensor.exposure), 0.0F, 1.0F);
        const double noise = sensor.noise_codes > 0 ? sensor.noise_codes * draws.normal() : 0.0;
        const double value = 255.0 * static_cast<double>(srgb_from_linear(exposed)) + noise;
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
    };
    Image<Rgba8> image(light.width(), light.height());
    for (int y = 0; y < light.height(); ++y) {
        for (int x = 0; x < light.width(); ++x) {
            const RgbaF& p = light(x, y);
            Rgba8& to = image(x, y);
            to.r = code(p.r);  // one after the other: each draws its noise
            to.g = code(p.g);
            to.b = code(p.b);
            to.a = 255;
        }
    }
    return image;
}

}  // namespace rs::capture
