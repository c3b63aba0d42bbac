#pragma once
// Brings a scene's meshes to the size that distances in recipes count in.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

namespace rs::capture {

// Which point of the meshes comes to stand on the turntable's axis, at height 0.
enum class ObjectCentre {
    bounding_box,  // the middle of the bounding box
    mesh_origin,   // the origin of the mesh's own coordinates
};

// Moves the meshes so that their centre is the origin and scales them so that the farthest vertex is at distance 1 from
// it. Only vertices that triangles use count. Lights and environment stay as they are. Returns the object radius in the
// new units: the largest distance of a vertex from the Y axis. Fails where the triangles have no size,
// or no width across the Y axis.
Result<double> normalise_meshes(Scene& scene, ObjectCentre which = ObjectCentre::bounding_box);

// Y of the lowest vertex that a triangle uses: of the ground that the object stands on. There must be one.
double ground_height(const Scene& scene);

}  // namespace rs::capture
