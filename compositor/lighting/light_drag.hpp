#pragma once
// Editing of lights by dragging handles with the pointer. Pure; thread-safe.
//
//     axis   moves the light along the axis to the point closest to the pointer's ray, with the initial offset
//     body   moves the light onto the visible surface under the pointer and aligns it with the surface normal; without
//     a
//            surface it keeps its depth. Directional lights rotate about the dome's centre
//     aim    aims the light at the point under the pointer

#include "compositor/lighting/light_handles.hpp"
#include "compositor/lighting/surface_point.hpp"

#include <functional>

namespace rs::compositor {

// Surface visible at a position in pixels; empty for the background.
using SurfaceAt = std::function<std::optional<SurfacePoint>(const glm::dvec2& at_px)>;

class LightDrag {
public:
    // `lift`: distance of lights in front of surfaces, scene units, > 0.
    LightDrag(const LightEntry& entry, HandlePart part, const Camera& camera, const glm::dvec2& at_px, double lift);

    // The initial light dragged to a pointer position; the camera may have moved since the start of the drag.
    [[nodiscard]] LightEntry to(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const;

private:
    [[nodiscard]] std::optional<double> axis_position(const glm::dvec2& at_px, const Camera& camera) const;
    [[nodiscard]] LightEntry drag_on_surface(const glm::dvec2& at_px, const Camera& camera,
                                             const SurfaceAt& surface) const;
    [[nodiscard]] LightEntry drag_on_dome(const glm::dvec2& at_px, const Camera& camera) const;
    [[nodiscard]] LightEntry drag_aim(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const;

    LightEntry entry_;
    HandlePart part_;
    double lift_;
    glm::dvec2 grab_offset_px_{0};  // handle position minus initial pointer position
    double grab_position_ = 0;      // along the axis, relative to the light
    bool before_dome_ = false;      // its handle is on the dome's side facing the camera
};

}  // namespace rs::compositor
