#pragma once
// Converts a scene's geometry and lights for the tracer, in scene units.
//
// Materials of glTF and MTL keep their surfaces (model_material.hpp), those of VRML97 become the surfaces of
// surface_of(); unlit and emissive surfaces illuminate others, and alpha-masked textures have holes. Whitted and toon
// use the ambient part of lights, which approximates interreflection. Lines, points and blended surfaces (opacity below
// 1, textures with many translucent texels), but for closed meshes of glass, are left to the raster renderer.

#include "capture/tracer/scene/scene.hpp"
#include "compositor/scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace rs::compositor {

/// Movable nodes become instances; nodes of the same mesh and material share a part.
struct TracerScene {
    capture::Scene scene;
    struct MovableNode {
        std::uint32_t id;
        glm::dmat4 world_from_node;  // in the scene
    };
    std::vector<MovableNode> moving;  // [scene.instances]
    int raster_only_nodes = 0;        // number of blended nodes and nodes without area
};

/// Lights and environment for the tracer. Scopes refer to the meshes and instances of make_tracer_scene().
std::vector<Light> traced_lights(const Scene& scene);
capture::LightScopes traced_scopes(const Scene& scene);
capture::Environment traced_environment(const Scene& scene);

/// Pure; thread-safe, like all functions here.
TracerScene make_tracer_scene(const Scene& scene);

/// Headlight at the viewer, used if the scene requests it (Navigation::headlight) and has no other light.
Light headlight_of(const glm::dvec3& forward);

}  // namespace rs::compositor
