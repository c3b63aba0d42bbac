#pragma once
// What a pointer that drags a handle makes of a light. Pure; thread-safe.
//
//     an axis   the light goes along it: to the place nearest to the pointer's ray, less where it was grasped
//     the body  the light goes over what the image shows, onto the surface, and turns to its normal; where there is
//               no surface it goes at its distance from the camera. Directional lights turn about the dome's middle
//     the aim   the light is turned to what is under the pointer

#include "compositor/lighting/light_handles.hpp"
#include "compositor/lighting/surface_point.hpp"

#include <functional>

namespace rs::compositor {

// What is seen at a position in pixels; nothing where that is nothing.
using SurfaceAt = std::function<std::optional<SurfacePoint>(const glm::dvec2& at_px)>;

class LightDrag {
public:
    // `lift`: how far before surfaces lights come to stand, scene units, > 0.
    LightDrag(const LightEntry& entry, HandlePart part, const Camera& camera, const glm::dvec2& at_px, double lift);

    // The light that was grasped, dragged to there; the camera may have another place by now.
    [[nodiscard]] LightEntry to(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const;

private:
    [[nodiscard]] std::optional<double> along_axis(const glm::dvec2& at_px, const Camera& camera) const;
    [[nodiscard]] LightEntry over_surfaces(const glm::dvec2& at_px, const Camera& camera,
                                           const SurfaceAt& surface) const;
    [[nodiscard]] LightEntry about_dome(const glm::dvec2& at_px, const Camera& camera) const;
    [[nodiscard]] LightEntry aimed(const glm::dvec2& at_px, const Camera& camera, const SurfaceAt& surface) const;

    LightEntry entry_;
    HandlePart part_;
    double lift_;
    glm::dvec2 grasped_beside_px_{0};  // the handle's place less the pointer's
    double grasped_at_ = 0;            // along the axis, from the light
    bool before_dome_ = false;         // its handle is on the side of the dome that faces the camera
};

}  // namespace rs::compositor
