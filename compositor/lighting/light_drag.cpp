#include "compositor/lighting/light_drag.hpp"

#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

// Point under the pointer in the plane through `place` parallel to the image.
glm::dvec3 unproject_at_depth(const glm::dvec3& place, const glm::dvec2& at_px, const Camera& camera) {
    const double depth = glm::dot(place - camera.centre(), camera.forward());
    return camera.centre() + depth * camera.ray(at_px.x, at_px.y);
}

// Snaps nearly axis-aligned normals. Single-precision depths cause errors of 2e-3 for floors that extend below the
// camera.
glm::dvec3 snap_to_axes(const glm::dvec3& normal) {
    constexpr double kNoise = 4e-3;
    glm::dvec3 kept = normal;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(normal[i]) < kNoise) kept[i] = 0;
        if (1 - std::abs(normal[i]) < kNoise * kNoise) kept[i] = std::copysign(1.0, normal[i]);
    }
    return unit_vector(kept);
}

}  // namespace

LightDrag::LightDrag(const LightEntry& entry, HandlePart part, const Camera& camera, const glm::dvec2& at_px,
                     double lift)
    : entry_(entry), part_(part), lift_(lift) {
    const glm::dvec3 place = part == HandlePart::kAim ? aim_position(entry, camera).value_or(entry.location)
                                                      : handle_position(entry, camera);
    grab_offset_px_ = glm::dvec2(camera.project(place)) - at_px;
    grab_position_ = axis_position(at_px, camera).value_or(0);
    const Dome dome = dome_of(camera);
    before_dome_ = glm::dot(place - dome.centre, dome.centre - camera.centre()) < 0;
}

std::optional<double> LightDrag::axis_position(const glm::dvec2& at_px, const Camera& camera) const {
    constexpr double kMinSine = 0.02;  // for axes nearly parallel to the ray the position is ill-conditioned
    const glm::dvec3 axis = direction_of(part_);
    const glm::dvec3 ray = glm::normalize(camera.ray(at_px.x, at_px.y));
    const double cosine = glm::dot(axis, ray);
    const double sine2 = 1 - cosine * cosine;
    if (sine2 < kMinSine * kMinSine) return std::nullopt;
    const glm::dvec3 way = camera.centre() - entry_.location;
    return (glm::dot(way, axis) - cosine * glm::dot(way, ray)) / sine2;
}

LightEntry LightDrag::to(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const {
    if (part_ == HandlePart::kAim) return drag_aim(at_px + grab_offset_px_, camera, surface);
    if (part_ == HandlePart::kBody) {
        const glm::dvec2 place_px = at_px + grab_offset_px_;
        return model_of(entry_).words.has_place ? drag_on_surface(place_px, camera, surface)
                                                : drag_on_dome(place_px, camera);
    }
    LightEntry dragged = entry_;
    if (const auto along = axis_position(at_px, camera))
        dragged.location += (*along - grab_position_) * direction_of(part_);
    dragged.location = glm::clamp(dragged.location, -kMaxLightDistance, kMaxLightDistance);
    return dragged;
}

LightEntry LightDrag::drag_on_surface(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const {
    LightEntry dragged = entry_;
    if (const auto hit = surface(at_px)) {
        dragged.location = hit->place + lift_ * hit->normal;
        if (model_of(dragged).words.has_aim) dragged.aim = snap_to_axes(hit->normal);
    } else {
        dragged.location = unproject_at_depth(entry_.location, at_px, camera);
    }
    dragged.location = glm::clamp(dragged.location, -kMaxLightDistance, kMaxLightDistance);
    return dragged;
}

LightEntry LightDrag::drag_on_dome(const glm::dvec2& at_px, const Camera& camera) const {
    const Dome dome = dome_of(camera);
    const glm::dvec3 ray = glm::normalize(camera.ray(at_px.x, at_px.y));
    const glm::dvec3 way = camera.centre() - dome.centre;
    const double nearest = -glm::dot(way, ray);
    const double within = dome.radius * dome.radius - (glm::dot(way, way) - nearest * nearest);
    // Pointer outside the dome: on its rim.
    const double half = std::sqrt(std::max(within, 0.0));
    const glm::dvec3 on_dome = way + (nearest + (before_dome_ ? -half : half)) * ray;
    LightEntry dragged = entry_;
    dragged.aim = -glm::normalize(on_dome);
    return dragged;
}

LightEntry LightDrag::drag_aim(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const {
    const auto hit = surface(at_px);
    const glm::dvec3 towards =
        (hit ? hit->place : unproject_at_depth(entry_.location, at_px, camera)) - entry_.location;
    LightEntry dragged = entry_;
    const double length = glm::length(towards);
    if (length > lift_) dragged.aim = towards / length;
    return dragged;
}

}  // namespace rs::compositor
