#include "compositor/viewer/frame_compositor.hpp"

#include "compositor/gl/draw.hpp"
#include "compositor/viewer/shaders.hpp"
#include "engine/core/view_registers.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

// How much of an object's own light is left at a distance.
float kept_in_fog(const std::optional<Fog>& fog, double distance) {
    if (!fog) return 1;
    if (distance >= fog->visibility) return 0;
    const double left = fog->visibility - distance;
    return static_cast<float>(fog->kind == FogKind::kLinear ? left / fog->visibility : std::exp(-distance / left));
}

// Seconds from lap to lap; of all that was drawn until then if `waits`, else of giving it to the driver.
class PartClock {
public:
    explicit PartClock(bool waits) : waits_(waits) {}
    double lap() {
        if (waits_) gl::finish();
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    bool waits_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace

Result<FrameCompositor> FrameCompositor::create(const Scene& scene, std::vector<PlacedObject> objects,
                                                const FrameOptions& options) {
    auto background = BackgroundRenderer::create(scene.background);
    if (!background) return background.error();
    auto surfaces = SurfaceRenderer::create(scene);
    if (!surfaces) return surfaces.error();
    auto floor = gl::Program::create("floor", shaders::kFloorVertex, shaders::kFloorFragment);
    if (!floor) return floor.error();
    auto object = gl::Program::create("object", shaders::kObjectVertex, shaders::kObjectFragment);
    if (!object) return object.error();
    auto frame = gl::Framebuffer::create(options.width, options.height, options.samples);
    if (!frame) return frame.error();
    auto resolved = gl::Framebuffer::create(options.width, options.height, 1);
    if (!resolved) return resolved.error();
    return FrameCompositor(scene, std::move(objects), {std::move(*floor), std::move(*object)}, std::move(*background),
                           std::move(*surfaces), std::move(*frame), std::move(*resolved), options);
}

FrameCompositor::FrameCompositor(const Scene& scene, std::vector<PlacedObject> objects, Programs programs,
                                 BackgroundRenderer background, SurfaceRenderer surfaces, gl::Framebuffer frame,
                                 gl::Framebuffer resolved, const FrameOptions& options)
    : floor_(scene.floor),
      floor_background_(background_colour(scene.background, {0, 0, -1})),
      fog_(scene.fog),
      objects_(std::move(objects)),
      programs_(std::move(programs)),
      background_(std::move(background)),
      surfaces_(std::move(surfaces)),
      wire_frame_(options.wire_frame),
      time_parts_(options.time_parts),
      samples_(options.samples),
      frame_(std::move(frame)),
      resolved_(std::move(resolved)),
      rectangle_(4),
      textures_(objects_.size()) {
    for (const PlacedObject& placed : objects_) first_places_.push_back(placed.world_from_object);
    for (const Light& light : scene.lights) {
        if (light.kind != LightKind::kDirectional || !light.everywhere) continue;
        floor_light_ += light.ambient + light.colour * static_cast<float>(std::max(-light.towards.y, 0.0));
    }
}

Result<Image<Rgba8>> FrameCompositor::compose(const Camera& camera) {
    if (Status status = draw(camera); !status) return status.error();
    return picture();
}

Status FrameCompositor::draw(const Camera& camera) {
    RS_CHECK(camera.width == frame_.width() && camera.height == frame_.height());
    const FrameView view = view_of_frame(camera);
    statistics_ = {};
    statistics_.nodes.resize(objects_.size());
    camera_ = camera;
    PartClock clock(time_parts_);
    frame_.begin(background_.zenith());
    if (!background_.plain()) background_.draw(camera);
    const std::vector<SurfaceRenderer::Transparent> transparent = surfaces_.draw_opaque(view, wire_frame_);
    statistics_.geometry_in_view = surfaces_.nodes_in_view();
    if (floor_) draw_floor(view);
    statistics_.geometry_s = clock.lap();

    std::vector<std::pair<std::size_t, ObjectView>> seen;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        if (auto object = view_of_object(objects_[i], camera)) seen.emplace_back(i, *object);
    }
    statistics_.nodes_not_seen = static_cast<int>(objects_.size() - seen.size());

    // Everything that is blended, the farthest first; of the same distance geometry before objects.
    struct Blended {
        double distance;
        const SurfaceRenderer::Transparent* surface;
        const std::pair<std::size_t, ObjectView>* object;
    };
    std::vector<Blended> blended;
    for (const auto& surface : transparent) blended.push_back({surface.distance, &surface, nullptr});
    for (const auto& object : seen) blended.push_back({object.second.plane_distance, nullptr, &object});
    std::stable_sort(blended.begin(), blended.end(),
                     [](const Blended& a, const Blended& b) { return a.distance > b.distance; });
    for (const Blended& item : blended) {
        if (item.surface != nullptr) {
            surfaces_.draw_transparent(*item.surface, view, wire_frame_);
        } else if (const Status status = draw_object(item.object->first, item.object->second); !status) {
            return status.error();
        }
    }
    frame_.resolve_to(resolved_);
    statistics_.composite_s = clock.lap() - statistics_.engine_s - statistics_.upload_s;
    return {};
}

Status FrameCompositor::resize(int width, int height) {
    auto frame = gl::Framebuffer::create(width, height, samples_);
    if (!frame) return frame.error();
    auto resolved = gl::Framebuffer::create(width, height, 1);
    if (!resolved) return resolved.error();
    frame_ = std::move(*frame);
    resolved_ = std::move(*resolved);
    camera_.reset();
    return {};
}

void FrameCompositor::turn_object(std::size_t index, double angle_rad) {
    objects_[index].world_from_object = first_places_[index] * NodeTransform{.angle_rad = angle_rad}.parent_from_node();
}

std::optional<double> FrameCompositor::distance_ahead() const {
    const float depth = frame_.depth_at(frame_.width() / 2, frame_.height() / 2, resolved_);
    if (!(depth > 0)) return std::nullopt;
    return kNear / depth;
}

std::optional<std::size_t> FrameCompositor::object_at(int x, int y) const {
    if (!camera_ || x < 0 || y < 0 || x >= width() || y >= height()) return std::nullopt;
    const double geometry = frame_.depth_at(x, y, resolved_);  // kNear / distance, 0 where there is none
    const glm::dvec3 position(x + 0.5, y + 0.5, 1);
    std::optional<std::size_t> nearest;
    double nearest_distance = 0;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        const auto view = view_of_object(objects_[i], *camera_);
        if (!view || (nearest && view->plane_distance >= nearest_distance)) continue;
        const ScreenRectangle& area = view->rectangle;
        if (x < area.x || y < area.y || x >= area.x + area.width || y >= area.y + area.height) continue;
        if (glm::dot(view->inverse_depth_facing, position) * kNear < geometry) continue;  // hidden
        const engine::Renderer& renderer = objects_[i].object->renderer;
        const auto registers = engine::prepare_view(renderer.object(), view->camera);
        if (!registers) continue;
        Image<Rgba8> shown(area.width, area.height);
        renderer.render(*registers, shown);
        if (shown(x - area.x, y - area.y).a < 128) continue;
        nearest = i;
        nearest_distance = view->plane_distance;
    }
    return nearest;
}

void FrameCompositor::draw_floor(const FrameView& view) const {
    const gl::Program& program = programs_.floor;
    program.set("clip_from_world", glm::mat4(view.clip_from_world));
    program.set("height", static_cast<float>(floor_->height));
    program.set("radius", static_cast<float>(floor_->radius));
    program.set("square", static_cast<float>(floor_->square));
    program.set("colour_a", floor_->colour_a * floor_light_);
    program.set("colour_b", floor_->colour_b * floor_light_);
    program.set("background", floor_background_);
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
    const ImageView<Rgba8> shown = picture_.view().crop(0, 0, area.width, area.height);
    PartClock clock(time_parts_);
    renderer.render(*registers, shown);
    const double engine_s = clock.lap();
    statistics_.nodes[index] = {true, area.width, area.height, engine_s};
    statistics_.engine_s += engine_s;
    statistics_.nodes_rendered += 1;
    statistics_.pixels_rendered += std::int64_t{area.width} * area.height;

    std::optional<gl::Texture>& texture = textures_[index];
    if (!texture || texture->width() < area.width || texture->height() < area.height) {
        texture.emplace(std::max(texture ? texture->width() : 0, area.width),
                        std::max(texture ? texture->height() : 0, area.height));
    }
    texture->upload(shown);
    texture->bind(0);
    statistics_.upload_s += clock.lap();

    const gl::Program& program = programs_.object;
    program.set("rectangle", glm::vec4(area.x, area.y, area.width, area.height));
    program.set("screen", glm::vec2(frame_.width(), frame_.height()));
    program.set("first_pixel", glm::ivec2(area.x, area.y));
    program.set("facing_depth", glm::vec3(view.inverse_depth_facing * kNear));
    program.set("foot_depth", glm::vec3(view.inverse_depth_foot * kNear));
    program.set("from_above", view.from_above ? 1 : 0);
    program.set("fog", glm::vec4(fog_ ? fog_->colour : glm::vec3(0), kept_in_fog(fog_, view.plane_distance)));
    gl::draw(program, rectangle_, {.depth_write = false, .blending = gl::Blending::kOverPremultiplied});
    return {};
}

}  // namespace rs::compositor
