#pragma once
// A ray-space object as the tracer meets it: one look-up of the engine answers one ray.
//
// The engine sees an image of one pixel, from a viewpoint on the ray before the object, so that the first that the
// whole line meets is found. Where that lies behind the ray's origin the ray meets nothing: rays that begin inside of
// an object, or between its parts, pass what lies before them.

#include "capture/tracer/scene/scene.hpp"
#include "compositor/viewer/residency/placed_object.hpp"

namespace rs::compositor {

class ObjectRays : public capture::RayPrimitive {
public:
    // Shines with its images' colours times `brightness`; what is less than half opaque is not there.
    ObjectRays(PlacedObject placed, float brightness);
    // Not while rays are traced.
    void set_brightness(float brightness) { brightness_ = brightness; }
    [[nodiscard]] Box bounds() const override { return box_; }
    [[nodiscard]] std::optional<Answer> answer(const glm::vec3& origin, const glm::vec3& direction) const override;

private:
    PlacedObject placed_;
    Similarity object_from_world_;
    glm::dvec3 middle_{0};  // of the object's bounds, object radii
    double reach_ = 1;      // of them from there
    float brightness_;
    Box box_{};
};

}  // namespace rs::compositor
