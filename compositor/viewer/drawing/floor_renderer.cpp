#include "compositor/viewer/drawing/floor_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "compositor/viewer/shadows/shadow_shaders.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

namespace rs::compositor {

Result<FloorRenderer> FloorRenderer::create(const Scene& scene, const ShadowPlan& shadows) {
    glm::vec3 always(0);
    std::vector<glm::vec4> shadowed;
    std::vector<std::uint32_t> with_maps;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.kind != LightKind::kDirectional || !light.everywhere) continue;
        const float facing = static_cast<float>(std::max(-light.towards.y, 0.0));
        if (shadows.shape_of(i) == ShadowShape::kNone || !(facing > 0)) {
            always += light.ambient + light.colour * facing;
            continue;
        }
        always += light.ambient;
        with_maps.push_back(i);
        shadowed.emplace_back(light.colour * facing, 0);
        shadowed.emplace_back(light.towards, 0);
    }
    RS_ASSIGN_OR_RETURN(
        auto program, gl::Program::create("floor", shaders::kFloorVertex,
                                          "#version 450 core\n" +
                                              shaders::shader_constant("kShadows", static_cast<int>(with_maps.size())) +
                                              "const float kNear = " + std::to_string(kNear) + ";\n" +
                                              shaders::kShadowLookUp + shaders::kFloorFragment));
    FloorRenderer renderer(std::move(program), *scene.floor);
    renderer.light_ = always;
    renderer.background_ = background_colour(scene.background, {0, 0, -1});
    renderer.shadowed_ = std::move(shadowed);
    renderer.shadows_ = rows_of(shadows, with_maps);
    return renderer;
}

void FloorRenderer::draw(const FrameView& view) const {
    program_.set("clip_from_world", glm::mat4(view.clip_from_world));
    program_.set("height", static_cast<float>(floor_.height));
    program_.set("radius", static_cast<float>(floor_.radius));
    program_.set("square", static_cast<float>(floor_.square));
    // Without shadows the light is multiplied into the colours.
    const glm::vec3 light = shadows_.empty() ? light_ : glm::vec3(1);
    program_.set("colour_a", floor_.colour_a * light);
    program_.set("colour_b", floor_.colour_b * light);
    program_.set("background", background_);
    if (!shadows_.empty()) {
        program_.set("unshadowed", light_);
        program_.set("shadowed", std::span(shadowed_));
        program_.set("shadows", std::span(&shadows_.front().u, 4 * shadows_.size()));
    }
    gl::draw(program_, square_, {});
}

}  // namespace rs::compositor
