#pragma once
// Surfaces hit by sixteen rays, prepared for shading: position, orientation, colour, and the parts of the BSDF that
// depend on the viewer only. Scalar counterparts: RayScene::surface_at(), sample_texture(), LightTransport::vertex_at()
// and the constructor of Surface.

#include "capture/tracer/packets/packet.hpp"
#include "capture/tracer/scene/scene.hpp"

namespace rs::capture {

// Material parameters of each lane.
struct MaterialLanes {
    Lanes kind;  // SurfaceKind as a number
    Lanes alpha, ior, translucency;
    Lanes base;  // max(1 - mean albedo of the coat, 1e-4): divisor of the light scattered by the base
    // Offset of the material's albedo table (kAlbedoNumbers values) in the caller's `tables`; any table if it has none.
    LanesOf<std::int32_t> table;
};

struct SurfaceLanes {
    MaterialLanes material;
    MaskLanes front_side;
    Lanes3 position;
    Lanes3 near_start, far_start;  // offset ray origins on the viewer's side and on the far side
    Lanes3 geometric_normal;       // faces the viewer
    Lanes3 normal;                 // shading normal; orient_surfaces() bends it towards the viewer
    Lanes3 tangent, bitangent;
    Lanes2 uv;
    Lanes3 colour;                       // the material's times the vertices' times the texture's
    Lanes3 viewer;                       // wo, local
    Lanes albedo;                        // E(wo)
    Lanes lambda;                        // smith_lambda() of wo
    LanesOf<std::uint32_t> light_group;  // index into LightScopes::groups
};

// Computes positions, normals and ray origins. Of the material only the translucency must be set. `step_off`: see
// RayScene.
void place_surfaces(const TriangleLanes& triangles, const Lanes3& direction, float step_off, SurfaceLanes& surfaces);

// Multiplies `colour` by the texture of each lane (null: none).
void texture_surfaces(const std::array<const Texture*, kLanes>& textures, SurfaceLanes& surfaces);

// Computes frames, local viewer directions, albedo and lambda from the shading normals and the ray directions.
void orient_surfaces(const Lanes3& direction, const float* tables, SurfaceLanes& surfaces);

}  // namespace rs::capture
