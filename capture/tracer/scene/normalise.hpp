#pragma once
// Normalises the size of a scene's meshes to the unit of distances in recipes.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

namespace rs::capture {

// Point of the meshes that is moved to the origin: on the turntable's axis, at height 0.
enum class ObjectCentre {
    bounding_box,  // centre of the bounding box
    mesh_origin,   // origin of the mesh's own coordinates
};

/// Moves the meshes so that their centre is the origin and scales them so that the farthest vertex is at distance 1
/// from it. Ignores vertices that no triangle uses. Lights and environment are unchanged. \return the object radius in
/// the new units: the largest distance of a vertex from the Y axis; an error if the triangles have no extent, or none
/// across the Y axis
Result<double> normalise_meshes(Scene& scene, ObjectCentre origin = ObjectCentre::bounding_box);

/// Y of the lowest vertex used by a triangle; there must be one.
double ground_height(const Scene& scene);

}  // namespace rs::capture
