#include "compositor/viewer/drawing/handle_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/gl/vertex_array.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <array>
#include <span>

namespace rs::compositor {
namespace {

constexpr float kRim_px = 1.5F;
constexpr float kHiddenStrength = 0.35F;
constexpr double kDepthBias = 1.004;  // depth scale that brings strokes on a surface in front of it

constexpr const char* kStrokeVertex = R"(#version 450 core
layout(location = 0) in vec3 corner;  // x, y in pixels; depth
layout(location = 1) in vec4 ends;    // pixels
layout(location = 2) in vec4 look;  // colour; half width in pixels
uniform vec2 screen;
flat out vec4 stroke;
flat out vec4 appearance;
void main() {
    stroke = ends;
    appearance = look;
    gl_Position = vec4(corner.x / screen.x * 2.0 - 1.0, 1.0 - corner.y / screen.y * 2.0, corner.z, 1.0);
})";
constexpr const char* kStrokeFragment = R"(#version 450 core
flat in vec4 stroke;
flat in vec4 appearance;
uniform float strength;
out vec4 result;
void main() {
    vec2 way = stroke.zw - stroke.xy;
    vec2 here = gl_FragCoord.xy - stroke.xy;
    float t = clamp(dot(here, way) / max(dot(way, way), 1e-9), 0.0, 1.0);
    float beyond = length(here - t * way) - appearance.w;
    float core = clamp(0.5 - beyond, 0.0, 1.0);
    float rim = 0.6 * clamp(1.5 - beyond, 0.0, 1.0);
    float alpha = max(core, rim) * strength;
    if (alpha <= 0.0) discard;
    result = vec4(appearance.rgb * core * strength, alpha);
})";

struct StrokeVertex {
    glm::vec3 corner;
    glm::vec4 ends;
    glm::vec4 look;
};
static_assert(sizeof(StrokeVertex) == 44);

struct StrokeEnd {
    glm::dvec2 px;
    double depth;  // depth buffer value
};

// End points of the part of a stroke in front of the near plane; nullopt if there is none.
std::optional<std::array<StrokeEnd, 2>> ends_of(const HandleStroke& stroke, const Camera& camera) {
    constexpr double kNearest = 2 * kNear;
    const auto depth = [&](const glm::dvec3& p) { return glm::dot(p - camera.centre(), camera.forward()); };
    glm::dvec3 a = stroke.from;
    glm::dvec3 b = stroke.to;
    const double za = depth(a);
    const double zb = depth(b);
    if (za < kNearest && zb < kNearest) return std::nullopt;
    if (za < kNearest) a = glm::mix(b, a, (zb - kNearest) / (zb - za));
    if (zb < kNearest) b = glm::mix(a, b, (za - kNearest) / (za - zb));
    const auto end = [&](const glm::dvec3& p) {
        const glm::dvec3 seen = camera.project(p);
        return StrokeEnd{glm::dvec2(seen), std::min(kDepthBias * kNear / seen.z, 1.0)};
    };
    return std::array{end(a), end(b)};
}

void add_quad(const HandleStroke& stroke, const Camera& camera, std::vector<StrokeVertex>& vertices,
              std::vector<std::uint32_t>& indices) {
    const auto ends = ends_of(stroke, camera);
    if (!ends) return;
    const glm::dvec2 from = (*ends)[0].px;
    const glm::dvec2 to = (*ends)[1].px;
    const double length = glm::distance(from, to);
    const double reach = 0.5 * static_cast<double>(stroke.width_px) + static_cast<double>(kRim_px);
    const glm::dvec2 along = reach * (length > 1e-9 ? (to - from) / length : glm::dvec2(1, 0));
    const glm::dvec2 aside(-along.y, along.x);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const std::uint32_t i : {0U, 1U, 2U, 2U, 1U, 3U}) indices.push_back(first + i);
    for (int corner = 0; corner < 4; ++corner) {
        const StrokeEnd& end = (*ends)[corner < 2 ? 0 : 1];
        const glm::dvec2 px = end.px + (corner < 2 ? -1.0 : 1.0) * along + (corner % 2 == 0 ? -1.0 : 1.0) * aside;
        vertices.push_back({glm::vec3(glm::dvec3(px, end.depth)), glm::vec4(glm::dvec4(from, to)),
                            glm::vec4(stroke.colour, 0.5F * stroke.width_px)});
    }
}

}  // namespace

Result<HandleRenderer> HandleRenderer::create() {
    RS_ASSIGN_OR_RETURN(auto program, gl::Program::create("handles", kStrokeVertex, kStrokeFragment));
    return HandleRenderer(std::move(program));
}

Status HandleRenderer::draw(const std::vector<HandleStroke>& strokes, const Camera& camera,
                            const gl::Framebuffer& image, const gl::Framebuffer& depths) {
    if (!copy_ || copy_->width() != image.width() || copy_->height() != image.height()) {
        RS_ASSIGN_OR_RETURN(auto made, gl::Framebuffer::create(image.width(), image.height(), 1));
        copy_ = std::move(made);
    }
    copy_->begin(glm::vec3(0));
    image.resolve_to(*copy_);
    depths.copy_depths_to(*copy_);
    std::vector<StrokeVertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const HandleStroke& stroke : strokes) add_quad(stroke, camera, vertices, indices);
    if (indices.empty()) return {};
    const gl::VertexArray quads(
        std::as_bytes(std::span(vertices)), static_cast<int>(sizeof(StrokeVertex)),
        {{3, offsetof(StrokeVertex, corner)}, {4, offsetof(StrokeVertex, ends)}, {4, offsetof(StrokeVertex, look)}},
        indices);
    program_.set("screen", glm::vec2(image.width(), image.height()));
    for (const bool hidden : {true, false}) {
        program_.set("strength", hidden ? kHiddenStrength : 1.0F);
        gl::draw(program_, quads,
                 {.depth_test = !hidden, .depth_write = false, .blending = gl::Blending::kOverPremultiplied});
    }
    return {};
}

}  // namespace rs::compositor
