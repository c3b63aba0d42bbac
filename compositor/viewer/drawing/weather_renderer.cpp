#include "compositor/viewer/drawing/weather_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/drawing/weather_shaders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::size_t kMaxLamps = 16;  // capacity of the shader's array
constexpr double kLampsAhead_m = 8;    // lamps nearest to the point at this distance ahead are used

struct ParticleStyle {
    int count = 0;
    double side_m = 0;  // of the box around the eye
    glm::dvec3 velocity{0};
    double shutter_s = 0;
    double width_m = 0;
    double sway_m = 0;
    double opacity = 0;
    double reflectance = 0;  // of ambient light
    bool round = false;
};
constexpr ParticleStyle kDrops{14000, 36, {0, -8.5, 0}, 0.03, 0.005, 0, 0.5, 0.55, false};
constexpr ParticleStyle kFlakes{16000, 30, {0, -1.3, 0}, 0.008, 0.03, 0.25, 0.9, 0.9, true};

// Quadratic attenuation coefficient k of the shader: 1 / max(1, k * d * d).
float fading(const Light& light) {
    return light.attenuation.z / std::max(light.least_attenuation, 1e-6F);
}

}  // namespace

WeatherRenderer::WeatherRenderer(gl::Program program)
    : program_(std::move(program)), drops_(6 * kDrops.count), flakes_(6 * kFlakes.count) {}

Result<WeatherRenderer> WeatherRenderer::create(const Scene& scene) {
    RS_ASSIGN_OR_RETURN(auto program,
                        gl::Program::create("weather", shaders::kWeatherVertex, shaders::kWeatherFragment));
    WeatherRenderer renderer(std::move(program));
    for (const Light& light : scene.lights) {
        if (!light.everywhere) continue;
        if (light.kind == LightKind::kDirectional) {
            renderer.sky_light_ += light.ambient + light.colour * 0.25F;  // averaged over the sphere
        } else {
            renderer.lamps_.push_back(light);
        }
    }
    // Particles scatter a part of the sky's light.
    renderer.sky_light_ += 0.35F * background_colour(scene.background, {0, 1, 0});
    return renderer;
}

void WeatherRenderer::draw(const Weather& weather, double seconds, const FrameView& view, double nearest,
                           double beyond) const {
    if (!weather.rain && !weather.snow) return;
    const ParticleStyle& falling = weather.rain ? kDrops : kFlakes;
    if (nearest >= falling.side_m) return;
    const glm::dvec3 eye = view.camera.centre();
    const glm::dvec3 middle = eye + kLampsAhead_m * view.camera.forward();
    std::vector<const Light*> near;
    for (const Light& lamp : lamps_) {
        if (glm::distance(lamp.location, eye) < lamp.radius + falling.side_m) near.push_back(&lamp);
    }
    std::stable_sort(near.begin(), near.end(), [&](const Light* a, const Light* b) {
        return glm::distance(a->location, middle) < glm::distance(b->location, middle);
    });
    near.resize(std::min(near.size(), kMaxLamps));
    std::array<glm::vec4, 3 * kMaxLamps> rows{};
    for (std::size_t i = 0; i < near.size(); ++i) {
        const Light& lamp = *near[i];
        const double cut_off = lamp.kind == LightKind::kSpot ? lamp.cut_off_rad : kPi;
        const float brightness = 0.5F / std::max(lamp.least_attenuation, 1e-6F);
        rows[3 * i] = {glm::vec3(lamp.location), static_cast<float>(lamp.radius)};
        rows[3 * i + 1] = {lamp.colour * brightness, fading(lamp)};
        rows[3 * i + 2] = {glm::vec3(lamp.towards), static_cast<float>(std::cos(cut_off)) - 1e-6F};
    }
    const Camera& camera = view.camera;
    program_.set("clip_from_world", glm::mat4(view.clip_from_world));
    program_.set("eye", glm::vec3(eye));
    program_.set("screen_px", glm::vec2(camera.width, camera.height));
    program_.set("focal_px", static_cast<float>(camera.fl_x));
    program_.set("seed", static_cast<int>(weather.seed));
    program_.set("seconds", static_cast<float>(seconds));
    program_.set("velocity", glm::vec3(falling.velocity + weather.wind));
    program_.set("particle", glm::vec4(falling.shutter_s, falling.width_m, falling.sway_m, falling.opacity));
    program_.set("side", static_cast<float>(falling.side_m));
    program_.set("range", glm::vec2(nearest, std::min(beyond, 1e6)));
    program_.set("sky_light", sky_light_ * static_cast<float>(falling.reflectance));
    program_.set("lamp_count", static_cast<int>(near.size()));
    program_.set("lamps", std::span<const glm::vec4>(rows));
    program_.set("round_ends", falling.round ? 1.0F : 0.0F);
    gl::draw(program_, weather.rain ? drops_ : flakes_,
             {.depth_write = false, .blending = gl::Blending::kOverPremultiplied});
}

}  // namespace rs::compositor
