#include "compositor/viewer/object_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/frustum.hpp"
#include "compositor/viewer/shader_constants.hpp"
#include "compositor/viewer/shaders.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace rs::compositor {

namespace {

constexpr float kHidingAlpha = 0.5F;  // alpha from which a pixel hides what is behind it
constexpr float kBeyondOpaque = 2;

// A texture that holds at least width x height texels.
gl::Texture& large_enough(std::optional<gl::Texture>& texture, int width, int height, gl::TexelKind kind) {
    if (!texture || texture->width() < width || texture->height() < height) {
        texture.emplace(std::max(texture ? texture->width() : 0, width),
                        std::max(texture ? texture->height() : 0, height), kind);
    }
    return *texture;
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
    : depth_(depth), programs_(std::move(programs)), rectangle_(4), textures_(nodes) {}

void ObjectRenderer::upload(std::size_t node, ConstImageView<Rgba8> picture, ConstImageView<float> depths) {
    Textures& textures = textures_[node];
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
    const ScreenRectangle& area = view.rectangle;
    const gl::Program& program = programs_[view.smooth ? 0 : static_cast<std::size_t>(view.samples_across)];
    program.set("rectangle", glm::vec4(area.x, area.y, area.width, area.height));
    program.set("screen", glm::vec2(appearance.screen_px));
    program.set("picture_size", glm::ivec2(view.camera.width, view.camera.height));
    program.set("picture_from_screen", glm::mat3(view.picture_from_screen));
    program.set("facing_depth", glm::vec3(view.inverse_depth_facing * kNear));
    program.set("foot_depth", glm::vec3(view.inverse_depth_foot * kNear));
    program.set("from_above", view.from_above ? 1 : 0);
    program.set("fog", glm::vec4(appearance.fog, appearance.own_light));
    program.set("opacity", appearance.opacity);
    if (depth_ == ObjectDepth::kPlane) return draw_pixels(program, 0, kBeyondOpaque, false);
    textures.depths[textures.filled_last]->bind(1);
    program.set("near_of_depths", static_cast<float>(kNear / view.units_per_rig_unit));
    // What is still fading in hides nothing.
    const bool there = appearance.opacity >= 1;
    draw_pixels(program, kHidingAlpha, kBeyondOpaque, there);
    draw_pixels(program, 0, kHidingAlpha, false);
}

void ObjectRenderer::draw_pixels(const gl::Program& program, float least_alpha, float alphas_end,
                                 bool depth_write) const {
    program.set("alphas", glm::vec2(least_alpha, alphas_end));
    gl::draw(program, rectangle_, {.depth_write = depth_write, .blending = gl::Blending::kOverPremultiplied});
}

void ObjectRenderer::release(std::size_t node) {
    textures_[node] = {};
}

}  // namespace rs::compositor
