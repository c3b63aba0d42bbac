#pragma once
// Surfaces that sixteen rays have met, made ready for light: where they are, which way they face, their colour, and
// what of their scattering depends on the viewer alone. The twins are RayScene::surface_at(), sample_texture(),
// LightTransport::vertex_at() and the constructor of Surface.

#include "capture/tracer/packets/packet.hpp"
#include "capture/tracer/scene/scene.hpp"

namespace rs::capture {

// What is constant over a material, one of them for each lane. Kinds are SurfaceKind as numbers.
struct MaterialLanes {
    Lanes kind;
    Lanes alpha, ior, translucency;
    Lanes base;  // max(1 - mean albedo of the coat, 1e-4): what divides the light that the base scatters
    // Of the albedo's kAlbedoNumbers within `tables` of the caller; as many of any where there are none.
    LanesOf<std::int32_t> table;
};

struct SurfaceLanes {
    MaterialLanes material;
    MaskLanes front_side;
    Lanes3 position;
    Lanes3 near_start, far_start;  // of rays, off the surface, on the viewer's side and on the other
    Lanes3 geometric_normal;       // face the viewer
    Lanes3 normal;                 // first the shading normal; face_viewers() bends it
    Lanes3 tangent, bitangent;
    Lanes2 uv;
    Lanes3 colour;  // the material's times the vertices' times the texture's
    Lanes3 viewer;  // wo, local
    Lanes albedo;   // E(wo)
    Lanes lambda;   // smith_lambda() of wo
};

// Of material's lanes only the translucency need be there. `step_off` as RayScene has it.
void place_surfaces(const TriangleLanes& triangles, const Lanes3& direction, float step_off, SurfaceLanes& surfaces);

// Multiplies `colour` by the texture of each lane, where there is one (null: none).
void texture_surfaces(const std::array<const Texture*, kLanes>& textures, SurfaceLanes& surfaces);

// From the shading normals and `direction`, in which the rays came.
void face_viewers(const Lanes3& direction, const float* tables, SurfaceLanes& surfaces);

}  // namespace rs::capture
