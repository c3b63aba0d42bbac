#pragma once
// Packets of sixteen rays as structures of arrays for SIMD: lane i of every array belongs to ray i.
//
//     RayLanes -> HitLanes -> TriangleLanes      Embree; gathered lane by lane (rays/ray_scene.hpp)
//     TriangleLanes -> SurfaceLanes              place_surfaces(), texture_surfaces(), orient_surfaces()
//     SurfaceLanes, a light -> LightLanes        light_from_direction(), _point(), _area(), _virtual(); or lane by lane
//                                                (LightSet)
//     SurfaceLanes, LightLanes -> ShadowLanes    reflect_light(): shadow rays, and the radiance reflected if unoccluded
//
// Every function gives results bit-identical to its scalar counterpart, so that an image does not depend on the
// grouping of its rays. Lanes excluded by a mask have unspecified values afterwards. All functions are thread-safe and
// keep no references to their arguments.

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rs::capture {

inline constexpr std::size_t kLanes = 16;
inline constexpr int kAlbedoNumbers = 64;  // size of an AlbedoTable

template <class Number>
struct alignas(64) LanesOf {
    std::array<Number, kLanes> of{};
    Number& operator[](std::size_t lane) { return of[lane]; }
    const Number& operator[](std::size_t lane) const { return of[lane]; }
};
using Lanes = LanesOf<float>;
using MaskLanes = LanesOf<std::int32_t>;  // -1: active; 0: inactive
struct Lanes2 {
    Lanes x, y;
    void set(std::size_t lane, const glm::vec2& v) {
        x[lane] = v.x;
        y[lane] = v.y;
    }
    [[nodiscard]] glm::vec2 at(std::size_t lane) const { return {x[lane], y[lane]}; }
};
struct Lanes3 {
    Lanes x, y, z;
    void set(std::size_t lane, const glm::vec3& v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
    [[nodiscard]] glm::vec3 at(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

// Memory layout of Embree's RTCRay16.
struct RayLanes {
    Lanes3 origin;
    Lanes nearest;     // 0
    Lanes3 direction;  // unit length
    Lanes time;
    Lanes reach;  // maximum distance; after an occlusion test, below 0 if occluded
    LanesOf<std::uint32_t> mask, id, flags;
};
struct HitLanes {
    Lanes3 normal;
    Lanes u, v;
    LanesOf<std::uint32_t> triangle, mesh, instance;  // mesh ~0: no hit; instance ~0: static mesh
};
// Memory layout of Embree's RTCRayHit16.
struct RayHitLanes {
    RayLanes ray;  // `reach` becomes the distance of the hit
    HitLanes hit;

    // Sets a lane to a ray without a hit.
    void begin(std::size_t lane, const glm::vec3& origin, const glm::vec3& direction, float time) {
        ray.origin.set(lane, origin);
        ray.direction.set(lane, direction);
        ray.nearest[lane] = 0.0F;
        ray.time[lane] = time;
        ray.reach[lane] = std::numeric_limits<float>::infinity();
        ray.mask[lane] = ~0U;
        hit.mesh[lane] = hit.instance[lane] = ~0U;
    }
    [[nodiscard]] bool has_hit(std::size_t lane) const { return hit.mesh[lane] != ~0U; }
};

// The triangles hit by the rays, in world coordinates.
struct TriangleLanes {
    std::array<Lanes3, 3> corner;
    std::array<Lanes3, 3> normal;  // of the vertices; 0 if the mesh has none
    std::array<Lanes2, 3> uv;
    Lanes u, v;     // barycentric coordinates of the hit
    Lanes winding;  // -1 for instances with a mirroring matrix, else 1
};

}  // namespace rs::capture
