#include "compositor/viewer/frame_compositor.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/shaders.hpp"
#include "engine/core/view_registers.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace rs::compositor {
namespace {

// Depth of the near plane in scene units. Depth is stored as kNear / depth in floating point, whose relative precision
// is the same near and far: it may be small.
constexpr double kNear = 0.001;

// Reversed depth with the far plane at infinity (gl/context.hpp). Points have camera coordinates: right, up, back.
glm::dmat4 clip_from_camera(const Camera& camera) {
    glm::dmat4 m(0.0);
    m[0][0] = 2 * camera.fl_x / camera.width;
    m[1][1] = 2 * camera.fl_y / camera.height;
    m[2][0] = 1 - 2 * camera.cx / camera.width;
    m[2][1] = 2 * camera.cy / camera.height - 1;
    m[2][3] = -1;
    m[3][2] = kNear;
    return m;
}

gl::VertexArray upload(const Mesh& mesh) {
    return {std::as_bytes(std::span(mesh.vertices)),
            sizeof(MeshVertex),
            {{3, offsetof(MeshVertex, position)}, {3, offsetof(MeshVertex, normal)}},
            mesh.indices};
}

}  // namespace

Result<FrameCompositor> FrameCompositor::create(const Scene& scene, std::vector<PlacedObject> objects,
                                                const FrameOptions& options) {
    auto geometry = gl::Program::create("geometry", shaders::kGeometryVertex, shaders::kGeometryFragment);
    if (!geometry) return geometry.error();
    auto floor = gl::Program::create("floor", shaders::kFloorVertex, shaders::kFloorFragment);
    if (!floor) return floor.error();
    auto object = gl::Program::create("object", shaders::kObjectVertex, shaders::kObjectFragment);
    if (!object) return object.error();
    auto frame = gl::Framebuffer::create(options.width, options.height, options.samples);
    if (!frame) return frame.error();
    auto resolved = gl::Framebuffer::create(options.width, options.height, 1);
    if (!resolved) return resolved.error();
    return FrameCompositor(scene, std::move(objects), {std::move(*geometry), std::move(*floor), std::move(*object)},
                           std::move(*frame), std::move(*resolved));
}

FrameCompositor::FrameCompositor(const Scene& scene, std::vector<PlacedObject> objects, Programs programs,
                                 gl::Framebuffer frame, gl::Framebuffer resolved)
    : background_(scene.background),
      floor_(scene.floor),
      lights_(scene.lights),
      objects_(std::move(objects)),
      programs_(std::move(programs)),
      frame_(std::move(frame)),
      resolved_(std::move(resolved)),
      rectangle_(4),
      textures_(objects_.size()) {
    for (const GeometryNode& node : scene.geometry) {
        geometry_.push_back({upload(node.mesh), node.colour, world_from_node(node.chain)});
    }
}

Result<Image<Rgba8>> FrameCompositor::compose(const Camera& camera) {
    RS_CHECK(camera.width == frame_.width() && camera.height == frame_.height());
    const glm::dmat4 clip_from_world = clip_from_camera(camera) * glm::inverse(camera.world_from_camera);
    statistics_ = {};
    frame_.begin(background_);
    draw_geometry(clip_from_world);
    if (floor_) draw_floor(clip_from_world);

    std::vector<std::pair<std::size_t, ObjectView>> seen;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        if (auto view = view_of_object(objects_[i], camera)) seen.emplace_back(i, *view);
    }
    statistics_.nodes_not_seen = static_cast<int>(objects_.size() - seen.size());
    std::stable_sort(seen.begin(), seen.end(),
                     [](const auto& a, const auto& b) { return a.second.plane_distance > b.second.plane_distance; });
    for (const auto& [index, view] : seen) {
        if (const Status status = draw_object(index, view); !status) return status.error();
    }
    frame_.resolve_to(resolved_);
    return resolved_.read_picture();
}

void FrameCompositor::draw_geometry(const glm::dmat4& clip_from_world) const {
    const gl::Program& program = programs_.geometry;
    program.set("to_light", glm::vec3(-glm::normalize(lights_.towards)));
    program.set("directional", lights_.directional);
    program.set("ambient", lights_.ambient);
    for (const GeometryDraw& item : geometry_) {
        program.set("clip_from_node", glm::mat4(clip_from_world * item.world_from_node.matrix()));
        program.set("world_from_node", glm::mat3(item.world_from_node.rotation));
        program.set("colour", item.colour);
        gl::draw(program, item.triangles, {});
    }
}

void FrameCompositor::draw_floor(const glm::dmat4& clip_from_world) const {
    const gl::Program& program = programs_.floor;
    const auto up = static_cast<float>(std::max(-glm::normalize(lights_.towards).y, 0.0));
    const glm::vec3 light = lights_.ambient + lights_.directional * up;
    program.set("clip_from_world", glm::mat4(clip_from_world));
    program.set("height", static_cast<float>(floor_->height));
    program.set("radius", static_cast<float>(floor_->radius));
    program.set("square", static_cast<float>(floor_->square));
    program.set("colour_a", floor_->colour_a * light);
    program.set("colour_b", floor_->colour_b * light);
    program.set("background", background_);
    gl::draw(program, rectangle_, {});
}

Status FrameCompositor::draw_object(std::size_t index, const ObjectView& view) {
    const PlacedObject& placed = objects_[index];
    const engine::Renderer& renderer = placed.object->renderer;
    const Result<engine::ViewRegisters> registers = engine::prepare_view(renderer.object(), view.camera);
    if (!registers) return Error{renderer.object().name + ": " + registers.error().message};
    const ScreenRectangle& area = view.rectangle;
    if (picture_.width() < area.width || picture_.height() < area.height) {
        picture_ = Image<Rgba8>(std::max(picture_.width(), area.width), std::max(picture_.height(), area.height));
    }
    const ImageView<Rgba8> picture = picture_.view().crop(0, 0, area.width, area.height);
    renderer.render(*registers, picture);
    statistics_.nodes_rendered += 1;
    statistics_.pixels_rendered += std::int64_t{area.width} * area.height;

    std::optional<gl::Texture>& texture = textures_[index];
    if (!texture || texture->width() < area.width || texture->height() < area.height) {
        texture.emplace(std::max(texture ? texture->width() : 0, area.width),
                        std::max(texture ? texture->height() : 0, area.height));
    }
    texture->upload(picture);
    texture->bind(0);

    const gl::Program& program = programs_.object;
    program.set("rectangle", glm::vec4(area.x, area.y, area.width, area.height));
    program.set("screen", glm::vec2(frame_.width(), frame_.height()));
    program.set("first_pixel", glm::ivec2(area.x, area.y));
    program.set("facing_depth", glm::vec3(view.inverse_depth_facing * kNear));
    program.set("foot_depth", glm::vec3(view.inverse_depth_foot * kNear));
    program.set("from_above", view.from_above ? 1 : 0);
    gl::draw(program, rectangle_, {.depth_write = false, .blending = gl::Blending::kOverPremultiplied});
    return {};
}

}  // namespace rs::compositor
