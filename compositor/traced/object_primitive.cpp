#include "compositor/traced/object_primitive.hpp"

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/image/linear_light.hpp"

#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kViewpointDistance = 3;  // from the centre to the viewpoint, in units of reach_
constexpr double kFocalLength_px = 1000;

// Camera of one pixel whose centre ray is `direction`.
Camera one_pixel(const glm::dvec3& eye, const glm::dvec3& direction) {
    const glm::dvec3 back = -direction;
    const glm::dvec3 level(back.z, 0, -back.x);  // cross product of Y and back
    const double length = glm::length(level);
    const glm::dvec3 right = length > 1e-9 ? level / length : glm::dvec3(1, 0, 0);
    Camera camera;
    camera.width = camera.height = 1;
    camera.fl_x = camera.fl_y = kFocalLength_px;
    camera.cx = camera.cy = 0.5;
    camera.world_from_camera = glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(back, right), 0),
                                          glm::dvec4(back, 0), glm::dvec4(eye, 1));
    return camera;
}

}  // namespace

ObjectPrimitive::ObjectPrimitive(PlacedObject placed, float brightness)
    : placed_(std::move(placed)),
      object_from_world_(placed_.world_from_object.inverse()),
      brightness_(brightness),
      proxy_(normal_proxy(*placed_.object)) {
    const BoundingCylinder& cylinder = placed_.object->bounds;
    const double half_height = std::max(0.5 * (cylinder.top - cylinder.bottom), 0.0);
    middle_ = {0, 0.5 * (cylinder.top + cylinder.bottom), 0};
    reach_ = std::max(std::hypot(cylinder.radius, half_height), 1e-6);
    BoundingBox box;
    box.include({-cylinder.radius, cylinder.bottom, -cylinder.radius});
    box.include({cylinder.radius, std::max(cylinder.top, cylinder.bottom), cylinder.radius});
    const BoundingBox in_world = box.moved(placed_.world_from_object.matrix());
    box_ = {glm::vec3(in_world.lowest), glm::vec3(in_world.highest)};
}

std::optional<ObjectPrimitive::Answer> ObjectPrimitive::answer(const glm::vec3& origin,
                                                               const glm::vec3& direction) const {
    const glm::dvec3 from = object_from_world_.point(glm::dvec3(origin));
    const glm::dvec3 along = glm::normalize(object_from_world_.direction(glm::dvec3(direction)));
    const double to_viewpoint = glm::dot(middle_ - from, along) - kViewpointDistance * reach_;
    const engine::Renderer& renderer = placed_.object->renderer;
    const double units = renderer.object().units_per_radius;
    const auto registers =
        engine::prepare_view(renderer.object(), one_pixel((from + to_viewpoint * along) * units, along));
    if (!registers) return std::nullopt;
    Rgba8 colour{};
    std::int32_t lambda_q20 = 0;
    renderer.render(*registers, {&colour, 1, 1, 1}, {&lambda_q20, 1, 1, 1});
    if (colour.a < 128) return std::nullopt;
    const double distance =
        (to_viewpoint + std::ldexp(static_cast<double>(lambda_q20), -20)) * placed_.world_from_object.scale;
    if (!(distance > 0)) return std::nullopt;
    glm::vec3 radiance =
        brightness_ * glm::vec3(linear_from_srgb8(colour.r), linear_from_srgb8(colour.g), linear_from_srgb8(colour.b));
    if (gain_) radiance *= gain_->at(glm::vec3(proxy_.normal(from, along)));
    return Answer{static_cast<float>(distance), radiance};
}

}  // namespace rs::compositor
