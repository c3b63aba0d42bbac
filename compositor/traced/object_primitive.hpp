#pragma once
// Ray-space object as a primitive of the tracer: each ray is answered by one lookup of the engine.
//
// The engine renders an image of one pixel from a viewpoint on the ray in front of the object, which finds the first
// hit along the whole line. A hit behind the ray's origin counts as a miss: rays that start inside an object, or
// between its parts, ignore surfaces in front of them.

#include "capture/tracer/scene/scene.hpp"
#include "compositor/viewer/residency/object_relighting.hpp"
#include "compositor/viewer/residency/placed_object.hpp"

namespace rs::compositor {

class ObjectPrimitive : public capture::RayPrimitive {
public:
    /// Emits the colours of its images times `brightness`; pixels less than half opaque are empty.
    ObjectPrimitive(PlacedObject placed, float brightness);
    // The setters must not be called while rays are traced.
    void set_brightness(float brightness) { brightness_ = brightness; }
    /// Relights the object: `gain` as by relighting_gain(); nullopt: its images as they are.
    void set_gain(const std::optional<IrradianceHarmonics>& gain) { gain_ = gain; }
    [[nodiscard]] const PlacedObject& placed() const { return placed_; }
    [[nodiscard]] Box bounds() const override { return box_; }
    [[nodiscard]] std::optional<Answer> answer(const glm::vec3& origin, const glm::vec3& direction) const override;

private:
    PlacedObject placed_;
    Similarity object_from_world_;
    glm::dvec3 middle_{0};  // centre of the object's bounds, object radii
    double reach_ = 1;      // radius of the bounds about middle_
    float brightness_;
    std::optional<IrradianceHarmonics> gain_;
    NormalProxy proxy_;
    Box box_{};
};

}  // namespace rs::compositor
