#pragma once
// Transforms of scenes: instances to static meshes, a room to the surroundings of an object, and the normalised size
// that recipes use as the unit of distances.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

/// Transforms a mesh by an invertible affine matrix. The winding is reversed for mirroring matrices, so that outer
/// sides stay outer.
Mesh transform_mesh(const Mesh& mesh, const glm::dmat4& world_from_mesh);

/// The scene at time 0 with meshes in place of parts and instances.
Scene flattened(Scene scene);

/// Adds the meshes, materials and textures of `room` as surroundings of an object without surroundings: images show the
/// object alone, lit by the room's lights and walls.
/// \param object_from_room affine and invertible
void add_surroundings(Scene& object, Scene room, const glm::dmat4& object_from_room);

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
