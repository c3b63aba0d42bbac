#pragma once
// How much room an object takes, told from its captured pictures. Pure; thread-safe.

#include "rayspace/object/ray_space_object.hpp"

namespace rs::compositor {

// An upright cylinder about the object's axis, in object radii.
struct BoundingCylinder {
    double radius = 0;
    double bottom = 0;
    double top = 0;
    [[nodiscard]] bool empty() const { return bottom >= top; }
};

// Holds every point at which the engine can show something of the object: for each picture the heights that its
// occupied rows take over all plane points the RS map covers (RECONSTRUCTION.md, section 3, solved for Y). Larger than
// the object itself. Empty where no picture shows anything. Looks at every pixel; the pictures must be loaded.
BoundingCylinder bounding_cylinder(const RaySpaceObject& object);

// An estimate of where the object itself begins and ends on its axis, in object radii: `bottom` is what would touch a
// floor that it stands on, which the object itself may say (RaySpaceObject::foot_q20). Else each picture's lowest row
// is taken for the rim of the foot that is nearest to the camera. How far that is before the axis is seen from the
// side, in the pictures a quarter turn away. Of all pictures the median counts. The top is found likewise, but with the
// object's width for its depth. Both 0 where no picture shows anything.
struct UprightExtent {
    double bottom = 0;
    double top = 0;
};
UprightExtent estimated_extent(const RaySpaceObject& object);

}  // namespace rs::compositor
