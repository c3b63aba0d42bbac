#pragma once
// Brings a scene's meshes to the size that distances in recipes count in.

#include "capture/tracer/scene.hpp"
#include "rayspace/result.hpp"

namespace rs::capture {

// Moves the meshes so that the centre of their bounding box is the origin and scales them so that the farthest vertex
// is at distance 1 from it. Only vertices that triangles use count. Lights and environment stay as they are. Returns
// the object radius in the new units: the largest distance of a vertex from the Y axis. Fails where no triangle has a
// size.
Result<double> normalise_meshes(Scene& scene);

}  // namespace rs::capture
