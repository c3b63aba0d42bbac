#include "compositor/viewer/drawing/floor_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/drawing/geometry_shaders.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "compositor/viewer/shadows/shadow_shaders.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace rs::compositor {
namespace {

// Square around the disc that faces upwards.
GeometryNode floor_node(const Floor& floor) {
    auto mesh = std::make_shared<Mesh>();
    const auto radius = static_cast<float>(floor.radius);
    for (const glm::vec2 at : {glm::vec2(-1, -1), {-1, 1}, {1, 1}, {1, -1}}) {
        mesh->vertices.push_back({glm::vec3(at.x * radius, floor.height, at.y * radius), {0, 1, 0}});
    }
    mesh->indices = {0, 1, 2, 0, 2, 3};
    mesh->two_sided = false;
    GeometryNode node;
    node.mesh = std::move(mesh);
    return node;
}

SurfaceKind floor_kind(const Scene& scene, const ShadowPlan& shadows, const std::vector<std::uint32_t>& lights) {
    SurfaceKind kind;
    kind.lit = true;
    add_lights(scene, shadows, lights, kind);
    kind.headlight = scene.navigation.headlight;
    kind.environment = scene.environment.has_value();
    kind.phong = scene.shading == Shading::kPhong;
    return kind;
}

// Background colour towards -Z, or the mean of a visible environment along the horizon.
glm::vec3 rim_colour(const Scene& scene) {
    if (!scene.environment || !scene.environment->seen) return background_colour(scene.background, {0, 0, -1});
    const Image<RgbaF>& pixels = *scene.environment->pixels;
    glm::vec3 sum(0);
    for (int x = 0; x < pixels.width(); ++x) {
        const RgbaF& p = pixels(x, pixels.height() / 2);
        sum += glm::min(scene.environment->scale * glm::vec3(p.r, p.g, p.b), glm::vec3(1));
    }
    return sum / static_cast<float>(pixels.width());
}

}  // namespace

Result<FloorRenderer> FloorRenderer::create(const Scene& scene, const ShadowPlan& shadows,
                                            const std::optional<IrradianceHarmonics>& environment) {
    FloorRenderer renderer(*scene.floor);
    RS_TRY(renderer.set_lights(scene, shadows, environment));
    return renderer;
}

Status FloorRenderer::set_lights(const Scene& scene, const ShadowPlan& shadows,
                                 const std::optional<IrradianceHarmonics>& environment) {
    const GeometryNode node = floor_node(floor_);
    const SurfaceLights reaching = lights_of(scene, node, bounds_of(*node.mesh));
    std::vector<std::uint32_t> ordered = sort_for_shader(scene, shadows, reaching.lights);
    ordered.resize(std::min(ordered.size(), static_cast<std::size_t>(kMaxCountedLights)));
    const SurfaceKind kind = floor_kind(scene, shadows, ordered);
    if (!program_ || kind != kind_) {
        RS_ASSIGN_OR_RETURN(auto program, gl::Program::create("floor", shaders::kFloorVertex,
                                                              constants_of(kind) + shaders::kShadowLookUp +
                                                                  shaders::kLighting + shaders::kFloorFragment));
        program_.emplace(std::move(program));
        kind_ = kind;
    }
    Material matte;  // without colour, which the shader computes
    matte.ambient = 1;
    material_ = row_of(matte, Shading::kVrml);
    material_.ambient_light = glm::vec4(reaching.ambient, 0);
    lights_ = rows_of(scene, ordered);
    shadows_ = rows_of(shadows, ordered);
    environment_ = environment;
    background_ = rim_colour(scene);
    return {};
}

void FloorRenderer::draw(const FrameView& view) const {
    const gl::Program& program = *program_;
    const auto set = [&](const char* name, const auto& value) {
        if (program.has_uniform(name)) program.set(name, value);
    };
    program.set("clip_from_world", glm::mat4(view.clip_from_world));
    program.set("height", static_cast<float>(floor_.height));
    program.set("radius", static_cast<float>(floor_.radius));
    program.set("square", static_cast<float>(floor_.square));
    program.set("colour_a", floor_.colour_a);
    program.set("colour_b", floor_.colour_b);
    program.set("background", background_);
    set("eye", glm::vec3(view.camera.centre()));
    set("headlight", glm::vec3(view.camera.forward()));
    // Rows of vec4 without padding; surface_tables.cpp asserts their sizes.
    set("material", std::span(&material_.diffuse_opacity, kMaterialRows));
    if (!lights_.empty()) set("lights", std::span(&lights_.front().colour, 5 * lights_.size()));
    if (!shadows_.empty()) set("shadows", std::span(&shadows_.front().u, 4 * shadows_.size()));
    if (!cascades_.empty()) set("cascades", std::span(cascades_));
    if (environment_) set("environment", std::span(environment_->factors));
    gl::draw(program, square_, {});
}

}  // namespace rs::compositor
