#pragma once
// A scene's geometry and lights as the tracer takes them. In scene units: rooms are not normalised.
//
// What becomes of VRML97's materials:
//   lit                   a matte surface of the diffuse colour, texture and colours of the vertices; with a specular
//                         colour a coat over it, whose roughness gives the highlight the same width (GGX alpha =
//                         sqrt(2 / (exponent + 2)), B. Walter and others 2007)
//   unlit, emissive       shines, and lights what is around it
//   textures with holes   holes
// The ambient part of lights is left out: it stands for the light that walls reflect, which is traced. Lines, points
// and what is blended (opacity below 1, textures of many half-transparent texels) are left to the raster renderer.

#include "capture/tracer/scene/scene.hpp"
#include "compositor/scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace rs::compositor {

// Nodes that may be moved become instances; those of the same mesh and look share a part.
struct TracedRoom {
    capture::Scene scene;
    struct Moving {
        std::uint32_t id;            // GeometryNode::moving
        glm::dmat4 world_from_node;  // as the scene has it
    };
    std::vector<Moving> moving;  // of each of scene.instances
    int left_to_raster = 0;      // nodes that are blended, or have no area
    int without_own_lights = 0;  // lights that shine on some nodes only, which the tracer does not know
};

// The lights and the environment of it.
std::vector<Light> traced_lights(const Scene& scene);
capture::Environment traced_environment(const Scene& scene);

// Pure; thread-safe, as all here.
TracedRoom traced_room(const Scene& scene);

// Goes along with the viewer where the scene requires that (Navigation::headlight) and nothing else shines.
Light headlight_of(const glm::dvec3& forward);

}  // namespace rs::compositor
