#include "compositor/web/view/scene_view.hpp"

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/object_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::web {
namespace {

// Limits of one object; a scene has several.
constexpr std::uint64_t kSceneObjectCap_bytes = std::uint64_t{512} << 20;
constexpr std::int64_t kSceneObjectBudget_bytes = std::int64_t{96} << 20;
constexpr double kUnmeasured = 0.03;    // other photos may show this much beyond the bounds, object radii
constexpr double kWidestSine = 0.85;    // of the half angle of view, from within an object's bounds
constexpr double kSmallestSide_px = 4;  // smallest screen

compositor::Similarity similarity_of(const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const double scale = std::cbrt(std::abs(glm::determinant(linear)));
    return {linear / scale, glm::dvec3(matrix[3]), scale};
}

// Camera at the eye that looks at the middle of the object and contains it.
Camera screen_towards(const compositor::PlacedObject& placed, const SceneSight& sight) {
    const compositor::BoundingCylinder& bounds = placed.object->bounds;
    const glm::dvec3 middle = placed.world_from_object.point({0, (bounds.bottom + bounds.top) / 2, 0});
    const double radius = placed.world_from_object.scale * std::hypot(bounds.radius, (bounds.top - bounds.bottom) / 2);
    const double distance = glm::distance(sight.eye, middle);
    const double half_rad = std::asin(std::min(radius / std::max(distance, 1e-9), kWidestSine));
    const double side = std::max(2 * std::tan(half_rad) * sight.focal_px, kSmallestSide_px);
    const int side_px = static_cast<int>(std::ceil(std::min({side, std::sqrt(double(sight.max_pixels)), 8192.0})));
    return look_at_camera(sight.eye, middle, 2 * half_rad, side_px, side_px);
}

}  // namespace

Result<SceneObject> SceneObject::open(std::vector<std::byte> file, const std::string& name) {
    RS_ASSIGN_OR_RETURN(const ContainerReader container, ContainerReader::over(std::move(file), name));
    RS_ASSIGN_OR_RETURN(const RaySpaceObject first,
                        read_object(container, {.max_level = 0, .memory_cap_bytes = kSceneObjectCap_bytes}));
    compositor::BoundingCylinder bounds = compositor::bounding_cylinder(first);
    bounds.bottom -= kUnmeasured;
    bounds.top += kUnmeasured;
    const compositor::UprightExtent extent = compositor::estimated_extent(first);
    RS_ASSIGN_OR_RETURN(RaySpaceObject object, read_object(container, {.max_level = kProgressiveLevels - 1,
                                                                       .memory_cap_bytes = kSceneObjectCap_bytes,
                                                                       .decode = false}));
    RS_ASSIGN_OR_RETURN(
        engine::Renderer renderer,
        engine::Renderer::create(std::move(object), {.decoded_budget_bytes = kSceneObjectBudget_bytes}));
    return SceneObject(std::make_shared<const compositor::ViewableObject>(
        compositor::ViewableObject{std::move(renderer), bounds, extent}));
}

Result<bool> SceneObject::render(const SceneSight& sight, SceneView& rendered) const {
    const double volume = glm::determinant(glm::dmat3(sight.world_from_node));
    const bool finite = std::isfinite(sight.eye.x + sight.eye.y + sight.eye.z) && std::isfinite(volume);
    if (!finite || std::abs(volume) < 1e-24 || !(sight.focal_px > 0) || sight.max_pixels < 1) {
        return Error{"view: its camera or the object's matrix has parameters that are out of range"};
    }
    compositor::Similarity world_from_object = similarity_of(sight.world_from_node);
    if (sight.standing) {
        world_from_object =
            world_from_object * compositor::Similarity{glm::dmat3(1.0), {0, -object_->extent.bottom, 0}, 1};
    }
    const compositor::PlacedObject placed{object_, world_from_object};
    rendered.screen = screen_towards(placed, sight);
    const auto view = compositor::view_of_object(placed, rendered.screen, {.upright = true});
    if (!view) return false;
    rendered.view = *view;
    const RaySpaceObject& object = object_->renderer.object();
    RS_ASSIGN_OR_RETURN(const engine::MixedView rings, engine::prepare_mixed_view(object, view->camera));
    rendered.image = Image<Rgba8>(view->camera.width, view->camera.height);
    Image<std::int32_t> lambda_q20(view->camera.width, view->camera.height);
    object_->renderer.render(rings, rendered.image, lambda_q20);
    rendered.depths = engine::depth_image(object, view->camera, lambda_q20);
    return true;
}

}  // namespace rs::web
