#include "compositor/viewer/drawing/placeholder_renderer.hpp"

#include "compositor/gl/draw.hpp"

#include <array>

namespace rs::compositor {
namespace {

constexpr double kWidth = 0.55;  // half width, in object radii

// Upright rectangle through the object's axis that faces the viewer.
constexpr const char* kVertex = R"(#version 450 core
uniform mat4 clip_from_world;
uniform vec4 corners[4];
out vec2 place;  // -1 .. 1 across, 0 .. 1 upwards
void main() {
    place = vec2((gl_VertexID & 1) * 2 - 1, gl_VertexID >> 1);
    gl_Position = clip_from_world * vec4(corners[gl_VertexID].xyz, 1.0);
})";
constexpr const char* kFragment = R"(#version 450 core
in vec2 place;
uniform float opacity;
uniform float progress;
out vec4 result;
void main() {
    // Capsule whose opacity grows with its thickness.
    float beyond = max(abs(place.y - 0.5) - 0.3, 0.0) / 0.2;
    float alpha = 1.0 - smoothstep(0.1, 1.0, length(vec2(place.x, beyond)));
    float filled = 1.0 - smoothstep(progress - 0.04, progress + 0.04, place.y);
    alpha *= opacity * mix(0.22, 0.5, filled);
    if (alpha <= 0.0) discard;
    result = vec4(vec3(0.55, 0.58, 0.62) * alpha, alpha);
})";

}  // namespace

Result<PlaceholderRenderer> PlaceholderRenderer::create() {
    RS_ASSIGN_OR_RETURN(auto program, gl::Program::create("placeholder", kVertex, kFragment));
    return PlaceholderRenderer(std::move(program));
}

void PlaceholderRenderer::draw(const Placeholder& placeholder, const FrameView& view) const {
    const Similarity& place = placeholder.world_from_object;
    const glm::dvec3 bottom = place.point({0, placeholder.bottom, 0});
    const glm::dvec3 top = place.point({0, placeholder.top, 0});
    const glm::dvec3 aside = glm::cross(top - bottom, view.camera.centre() - bottom);
    if (!(glm::length(aside) > 0)) return;  // viewed along the axis
    const glm::dvec3 half = glm::normalize(aside) * (kWidth * place.scale);
    const std::array corners = {glm::vec4(bottom - half, 1), glm::vec4(bottom + half, 1), glm::vec4(top - half, 1),
                                glm::vec4(top + half, 1)};
    program_.set("clip_from_world", glm::mat4(view.clip_from_world));
    program_.set("corners", corners);
    program_.set("opacity", placeholder.opacity);
    program_.set("progress", placeholder.progress);
    gl::draw(program_, rectangle_, {.depth_write = false, .blending = gl::Blending::kOverPremultiplied});
}

BoundingBox bounds_of(const Placeholder& placeholder) {
    const Similarity& place = placeholder.world_from_object;
    BoundingBox box{{-kWidth, placeholder.bottom, -kWidth}, {kWidth, placeholder.top, kWidth}};
    return box.moved(place.matrix());
}

}  // namespace rs::compositor
