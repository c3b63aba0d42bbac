#include "compositor/viewer/drawing/area_light_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {

Result<AreaLightRenderer> AreaLightRenderer::create() {
    RS_ASSIGN_OR_RETURN(auto program,
                        gl::Program::create("area light", shaders::kAreaLightVertex, shaders::kAreaLightFragment));
    return AreaLightRenderer(std::move(program));
}

void AreaLightRenderer::set_lights(const std::vector<Light>& lights, double exposure_ev) {
    areas_.clear();
    for (const Light& light : lights) {
        const bool shines = std::max({light.colour.r, light.colour.g, light.colour.b}) > 0;
        if (!shines || model_of(light).form != LightForm::kArea) continue;
        areas_.push_back(light);
        areas_.back().colour *= static_cast<float>(std::exp2(exposure_ev));
    }
}

void AreaLightRenderer::draw(const FrameView& view, const std::optional<Fog>& fog) const {
    const auto distance = [&](const Light& light) { return glm::distance(light.location, view.camera.centre()); };
    std::vector<const Light*> sorted;
    for (const Light& light : areas_) sorted.push_back(&light);
    std::ranges::stable_sort(sorted, [&](const Light* a, const Light* b) { return distance(*a) > distance(*b); });
    for (const Light* light : sorted) {
        glm::vec3 shown = glm::min(light->colour, glm::vec3(1));
        if (fog) shown = glm::mix(fog->colour, shown, fog_transmittance(*fog, distance(*light)));
        program_.set("clip_from_world", glm::mat4(view.clip_from_world));
        program_.set("centre", glm::vec3(light->location));
        program_.set("half_u", glm::vec3(light->half_u));
        program_.set("half_v", glm::vec3(light->half_v));
        program_.set("radiance", shown);
        program_.set("is_disc", light->kind == LightKind::kDisc ? 1 : 0);
        gl::draw(program_, square_,
                 {.depth_write = false, .blending = gl::Blending::kOverPremultiplied, .culling = gl::Culling::kBack});
    }
}

}  // namespace rs::compositor
