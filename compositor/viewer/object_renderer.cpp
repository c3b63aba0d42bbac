#include "compositor/viewer/object_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/frustum.hpp"
#include "compositor/viewer/shader_constants.hpp"
#include "compositor/viewer/shaders.hpp"
#include "compositor/viewer/shown_parts.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace rs::compositor {

namespace {

constexpr float kHidingAlpha = 0.5F;  // alpha from which a pixel hides what is behind it

// A texture that holds at least width x height texels.
gl::Texture& large_enough(std::optional<gl::Texture>& texture, int width, int height, gl::TexelKind kind) {
    if (!texture || texture->width() < width || texture->height() < height) {
        texture.emplace(std::max(texture ? texture->width() : 0, width),
                        std::max(texture ? texture->height() : 0, height), kind);
    }
    return *texture;
}

// How far from its place a pixel of the screen, or one that touches it, reads the picture.
int margin_of(const ObjectView& view) {
    const auto place = [&](double x, double y) {
        const glm::dvec3 p = view.picture_from_screen * glm::dvec3(x, y, 1);
        return glm::dvec2(p) / p.z;
    };
    const ScreenRectangle& area = view.rectangle;
    double farthest = 0;
    for (const int x : {area.x, area.x + area.width - 1}) {
        for (const int y : {area.y, area.y + area.height - 1}) {
            const glm::dvec2 across = glm::abs(place(x + 1, y) - place(x, y));
            const glm::dvec2 down = glm::abs(place(x, y + 1) - place(x, y));
            farthest = std::max({farthest, across.x + down.x, across.y + down.y});
        }
    }
    constexpr double kBetweenTexels = 1.5;
    constexpr double kMost = 64;
    return static_cast<int>(std::ceil(std::min(farthest, kMost) + kBetweenTexels));
}

std::optional<gl::VertexArray> triangles(const std::vector<glm::vec3>& corners,
                                         const std::vector<std::uint32_t>& indices) {
    if (indices.empty()) return std::nullopt;
    return std::make_optional<gl::VertexArray>(std::as_bytes(std::span(corners)), static_cast<int>(sizeof(glm::vec3)),
                                               std::vector<gl::VertexAttribute>{{3, 0}}, indices);
}

}  // namespace

Result<ObjectRenderer> ObjectRenderer::create(std::size_t nodes, ObjectDepth depth) {
    std::vector<gl::Program> programs;
    for (int samples = 0; samples <= kMostSamplesAcross; ++samples) {
        const std::string constants =
            "#version 450 core\n" + shader_constant("kPixelDepth", depth == ObjectDepth::kPixel) +
            shader_constant("kSamplesAcross", std::max(samples, 1)) + shader_constant("kSmooth", samples == 0);
        auto program = gl::Program::create("object", shaders::kObjectVertex, constants + shaders::kObjectFragment);
        if (!program) return program.error();
        programs.push_back(std::move(*program));
    }
    return ObjectRenderer(std::move(programs), nodes, depth);
}

ObjectRenderer::ObjectRenderer(std::vector<gl::Program> programs, std::size_t nodes, ObjectDepth depth)
    : depth_(depth), programs_(std::move(programs)), textures_(nodes) {}

void ObjectRenderer::upload(std::size_t node, const ObjectView& view, ConstImageView<Rgba8> picture,
                            ConstImageView<float> depths) {
    Textures& textures = textures_[node];
    const ShownMesh shown = shown_mesh(shown_bands(picture, margin_of(view)), glm::inverse(view.picture_from_screen));
    textures.opaque = triangles(shown.corners, shown.opaque);
    textures.blended = triangles(shown.corners, shown.blended);
    textures.filled_last ^= 1;
    const int width = picture.width();
    const int height = picture.height();
    large_enough(textures.in_turns[textures.filled_last], width, height, gl::TexelKind::kColour).upload(picture);
    if (depth_ != ObjectDepth::kPixel) return;
    RS_CHECK(depths.width() == width && depths.height() == height);
    large_enough(textures.depths[textures.filled_last], width, height, gl::TexelKind::kFloat).upload(depths);
}

void ObjectRenderer::draw(std::size_t node, const ObjectView& view, const Appearance& appearance) const {
    const Textures& textures = textures_[node];
    textures.in_turns[textures.filled_last]->bind(0);
    const gl::Program& program = programs_[view.smooth ? 0 : static_cast<std::size_t>(view.samples_across)];
    program.set("screen", glm::vec2(appearance.screen_px));
    program.set("picture_size", glm::ivec2(view.camera.width, view.camera.height));
    program.set("picture_from_screen", glm::mat3(view.picture_from_screen));
    program.set("facing_depth", glm::vec3(view.inverse_depth_facing * kNear));
    program.set("foot_depth", glm::vec3(view.inverse_depth_foot * kNear));
    program.set("from_above", view.from_above ? 1 : 0);
    program.set("fog", glm::vec4(appearance.fog, appearance.own_light));
    program.set("opacity", appearance.opacity);
    const bool there = appearance.opacity >= 1;
    if (depth_ == ObjectDepth::kPlane) return draw_pixels(program, textures, {.there = there});
    textures.depths[textures.filled_last]->bind(1);
    program.set("near_of_depths", static_cast<float>(kNear / view.units_per_rig_unit));
    // What is still fading in hides nothing.
    draw_pixels(program, textures, {.least_alpha = kHidingAlpha, .depth_write = there, .there = there});
    draw_pixels(program, textures, {.alphas_end = kHidingAlpha, .there = there});
}

void ObjectRenderer::draw_pixels(const gl::Program& program, const Textures& textures, const Pass& pass) {
    program.set("alphas", glm::vec2(pass.least_alpha, pass.alphas_end));
    const auto draw_part = [&](const std::optional<gl::VertexArray>& part, gl::Blending blending) {
        if (part) gl::draw(program, *part, {.depth_write = pass.depth_write, .blending = blending});
    };
    draw_part(textures.opaque, pass.there ? gl::Blending::kReplace : gl::Blending::kOverPremultiplied);
    draw_part(textures.blended, gl::Blending::kOverPremultiplied);
}

void ObjectRenderer::release(std::size_t node) {
    textures_[node] = {};
}

}  // namespace rs::compositor
