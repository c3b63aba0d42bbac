#include "compositor/traced/traced_renderer.hpp"

#include "compositor/traced/traced_room.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {

Result<TracedRenderer> TracedRenderer::create(const Scene& scene, const TracedOptions& options) {
    TracedRoom room = traced_room(scene);
    std::vector<Light> lights = room.scene.lights;
    const bool shines = !lights.empty() || std::ranges::any_of(room.scene.materials, [](const auto& material) {
        return material.emission != glm::vec3(0);
    });
    auto tracer = capture::Tracer::create(std::move(room.scene));
    if (!tracer) return tracer.error();
    TracedRenderer renderer(std::move(*tracer), options);
    renderer.headlight_ = scene.navigation.headlight && !shines;
    renderer.lights_ = std::move(lights);
    if (room.without_own_lights > 0) {
        renderer.warnings_.push_back(std::to_string(room.without_own_lights) +
                                     " lights that shine on parts of the scene only are not traced");
    }
    return renderer;
}

void TracedRenderer::look(const Camera& camera) {
    camera_ = camera;
    sum_ = {};
    if (!headlight_) return;
    std::vector<Light> lights = lights_;
    lights.push_back(headlight_of(camera.forward()));
    tracer_.set_lights(std::move(lights));
}

bool TracedRenderer::add_pass(Progress* progress, const std::atomic<bool>* stop) {
    capture::RenderOptions options;
    options.max_bounces = options_.max_bounces;
    return tracer_.accumulate(camera_, options, 1, sum_, progress, stop);
}

Image<Rgba8> TracedRenderer::picture() const {
    Image<RgbaF> mean = sum_.mean();
    const auto brighter = static_cast<float>(std::exp2(options_.exposure_ev));
    for (RgbaF& pixel : mean.pixels()) {
        pixel.r *= brighter;
        pixel.g *= brighter;
        pixel.b *= brighter;
    }
    return capture::to_srgb8(mean);
}

}  // namespace rs::compositor
