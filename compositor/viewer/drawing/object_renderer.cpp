#include "compositor/viewer/drawing/object_renderer.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/drawing/image_coverage.hpp"
#include "compositor/viewer/drawing/shaders.hpp"
#include "compositor/viewer/views/screen_rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace rs::compositor {

namespace {

constexpr float kDepthWriteAlpha = 0.5F;  // pixels of at least this alpha write depth

// Calls make(width, height) for an image that is missing or smaller than width x height.
template <class Sized, class Make>
Status ensure_size(std::optional<Sized>& image, int width, int height, const Make& make) {
    if (image && image->width() >= width && image->height() >= height) return {};
    const int columns = std::max(image ? image->width() : 0, width);
    const int rows = std::max(image ? image->height() : 0, height);
    image.reset();
    RS_ASSIGN_OR_RETURN(image, make(columns, rows));
    return {};
}

// Largest distance, in image pixels, from the projection of a screen pixel at which it or a neighbour samples the
// image.
int margin_of(const ObjectView& view) {
    const auto place = [&](double x, double y) {
        const glm::dvec3 p = view.image_from_screen * glm::dvec3(x, y, 1);
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
    constexpr double kMaxMargin = 64;
    return static_cast<int>(std::ceil(std::min(farthest, kMaxMargin) + kBetweenTexels));
}

std::optional<gl::VertexArray> triangles(const std::vector<glm::vec3>& corners,
                                         const std::vector<std::uint32_t>& indices) {
    if (indices.empty()) return std::nullopt;
    return std::make_optional<gl::VertexArray>(std::as_bytes(std::span(corners)), static_cast<int>(sizeof(glm::vec3)),
                                               std::vector<gl::VertexAttribute>{{3, 0}}, indices);
}

}  // namespace

Result<ObjectRenderer> ObjectRenderer::create(std::size_t nodes, ObjectDepth depth) {
    Programs programs;
    for (const bool opaque : {false, true}) {
        for (int samples = 0; samples <= kMaxSamplesAcross; ++samples) {
            const std::string constants = "#version 450 core\n" +
                                          shaders::shader_constant("kPixelDepth", depth == ObjectDepth::kPixel) +
                                          shaders::shader_constant("kOpaque", opaque) +
                                          shaders::shader_constant("kSamplesAcross", std::max(samples, 1)) +
                                          shaders::shader_constant("kSmooth", samples == 0);
            RS_ASSIGN_OR_RETURN(auto program, gl::Program::create("object", shaders::kObjectVertex,
                                                                  constants + shaders::kObjectFragment));
            (opaque ? programs.opaque : programs.blended).push_back(std::move(program));
        }
    }
    return ObjectRenderer(std::move(programs), nodes, depth);
}

ObjectRenderer::ObjectRenderer(Programs programs, std::size_t nodes, ObjectDepth depth)
    : depth_(depth), programs_(std::move(programs)), textures_(nodes) {}

Status ObjectRenderer::upload(std::size_t node, const ObjectView& view, const Image<Rgba8>& image,
                              const Image<std::int32_t>& depths_q20) {
    Textures& textures = textures_[node];
    textures.is_drawn = false;
    const CoverageMesh shown =
        coverage_mesh(coverage_bands(image, margin_of(view)), glm::inverse(view.image_from_screen));
    textures.opaque = triangles(shown.corners, shown.opaque);
    textures.blended = triangles(shown.corners, shown.blended);
    textures.filled_last ^= 1;
    const int width = image.width();
    const int height = image.height();
    std::optional<gl::Texture>& colours = textures.in_turns[textures.filled_last];
    RS_TRY(ensure_size(colours, width, height,
                       [](int columns, int rows) -> Result<gl::Texture> { return gl::Texture(columns, rows); }));
    colours->upload(image);
    if (depth_ != ObjectDepth::kPixel) return {};
    RS_CHECK(depths_q20.width() == width && depths_q20.height() == height);
    std::optional<gl::IntegerTexture>& depths = textures.depths[textures.filled_last];
    RS_TRY(ensure_size(depths, width, height, [](int columns, int rows) {
        return gl::IntegerTexture::create(gl::IntegerFormat::kSigned32, columns, rows);
    }));
    depths->upload(width, height, depths_q20.data());
    return {};
}

Result<const gl::IntegerTarget*> ObjectRenderer::target(std::size_t node, const ObjectView& view) {
    Textures& textures = textures_[node];
    RS_TRY(ensure_size(textures.drawn, view.camera.width, view.camera.height, gl::IntegerTarget::create));
    return &*textures.drawn;
}

void ObjectRenderer::set_drawn(std::size_t node, const ObjectView& view, std::span<const PixelRect> visible) {
    Textures& textures = textures_[node];
    textures.is_drawn = true;
    const CoverageMesh shown =
        coverage_mesh(coverage_bands(visible, margin_of(view)), glm::inverse(view.image_from_screen));
    textures.opaque.reset();
    textures.blended = triangles(shown.corners, shown.blended);
}

ObjectRenderer::Relight ObjectRenderer::relight_of(const PlacedObject& placed, const Camera& camera,
                                                   const IrradianceHarmonics& scene) {
    const NormalProxy proxy = normal_proxy(*placed.object);
    const Similarity object_from_world = placed.world_from_object.inverse();
    const auto ray = [&](double x, double y) {
        return glm::vec3(object_from_world.direction(camera.ray(x, y)) / proxy.half_axes);
    };
    const glm::vec3 origin = ray(0, 0);
    return {.gain = relighting_gain(placed, scene),
            .eye = glm::vec3((object_from_world.point(camera.centre()) - proxy.centre) / proxy.half_axes),
            .ray_from_screen = glm::mat3(ray(1, 0) - origin, ray(0, 1) - origin, origin),
            .normal_from_point = glm::vec3(1.0 / proxy.half_axes)};
}

const gl::Program& ObjectRenderer::set_up(const std::vector<gl::Program>& programs, const ObjectView& view,
                                          const Appearance& appearance) const {
    const gl::Program& program = programs[view.smooth ? 0 : static_cast<std::size_t>(view.samples_across)];
    program.set("screen", glm::vec2(appearance.screen_px));
    program.set("picture_from_screen", glm::mat3(view.image_from_screen));
    program.set("facing_depth", glm::vec3(view.inverse_depth_facing * kNear));
    program.set("foot_depth", glm::vec3(view.inverse_depth_foot * kNear));
    program.set("from_above", view.from_above ? 1 : 0);
    program.set("fog", glm::vec4(appearance.fog, appearance.own_light));
    program.set("opacity", appearance.opacity);
    program.set("relit", appearance.relight ? 1 : 0);
    if (appearance.relight) {
        program.set("gain", appearance.relight->gain.factors);
        program.set("eye", appearance.relight->eye);
        program.set("ray_from_screen", appearance.relight->ray_from_screen);
        program.set("normal_from_point", appearance.relight->normal_from_point);
    }
    if (depth_ == ObjectDepth::kPixel) {
        program.set("near_of_depths", static_cast<float>(kNear / view.units_per_rig_unit));
        program.set("to_viewpoint", appearance.depth_scale.to_viewpoint);
        program.set("units_per_radius", appearance.depth_scale.units_per_radius);
    }
    return program;
}

void ObjectRenderer::draw(std::size_t node, const ObjectView& view, const Appearance& appearance) const {
    const Textures& textures = textures_[node];
    if (textures.is_drawn) {
        textures.drawn->bind_colours(0);
        textures.drawn->bind_numbers(1);
    } else {
        textures.in_turns[textures.filled_last]->bind(0);
        if (depth_ == ObjectDepth::kPixel) textures.depths[textures.filled_last]->bind(1);
    }
    const bool there = appearance.opacity >= 1;  // objects that fade in write no depth
    if (textures.opaque) {
        gl::draw(set_up(programs_.opaque, view, appearance), *textures.opaque,
                 {.depth_write = there && depth_ == ObjectDepth::kPixel,
                  .blending = there ? gl::Blending::kReplace : gl::Blending::kOverPremultiplied});
    }
    if (textures.blended) {
        const gl::Program& program = set_up(programs_.blended, view, appearance);
        program.set("picture_size", glm::ivec2(view.camera.width, view.camera.height));
        draw_blended_parts(*textures.blended, program, there);
    }
}

void ObjectRenderer::draw_blended_parts(const gl::VertexArray& parts, const gl::Program& program, bool there) const {
    const auto draw_alphas = [&](float least, float end, bool hides) {
        program.set("alphas", glm::vec2(least, end));
        gl::draw(program, parts, {.depth_write = hides, .blending = gl::Blending::kOverPremultiplied});
    };
    constexpr float kMoreThanAll = 2;
    if (depth_ == ObjectDepth::kPlane) return draw_alphas(0, kMoreThanAll, false);
    draw_alphas(kDepthWriteAlpha, kMoreThanAll, there);
    draw_alphas(0, kDepthWriteAlpha, false);
}

void ObjectRenderer::release(std::size_t node) {
    textures_[node] = {};
}

}  // namespace rs::compositor
