#pragma once
// Sixteen rays at a time, number by number, so that vectors take them as they lie: lane i of every array is of ray i.
//
//     RayLanes -> HitLanes -> TriangleLanes   Embree; gathered lane by lane (rays/ray_scene.hpp)
//     TriangleLanes -> SurfaceLanes           place_surfaces(), texture_surfaces(), face_viewers()
//     SurfaceLanes, a light -> LightLanes     light_from_afar(), _point(), _area(), _virtual(); or lane by lane
//     (LightSet) SurfaceLanes, LightLanes -> RayLanes    send_light(): the rays to the light, and what it makes the
//     surfaces send
//
// Every function gives the bits of its plain twin, which takes one ray at a time and which it names; so an image is
// the same whether its rays go together or alone. Lanes that a mask leaves out may hold anything afterwards. No
// function refers to what it was given after it returns; all are thread-safe.

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace rs::capture {

inline constexpr std::size_t kLanes = 16;
inline constexpr int kAlbedoNumbers = 64;  // in the table of a coat's or a metal's albedo

template <class Number>
struct alignas(64) LanesOf {
    std::array<Number, kLanes> of{};
    Number& operator[](std::size_t lane) { return of[lane]; }
    const Number& operator[](std::size_t lane) const { return of[lane]; }
};
using Lanes = LanesOf<float>;
using MaskLanes = LanesOf<std::int32_t>;  // -1: the lane counts; 0: it does not
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

// As Embree has them in memory (RTCRayHit16).
struct RayLanes {
    Lanes3 origin;
    Lanes nearest;     // 0
    Lanes3 direction;  // unit length
    Lanes time;
    Lanes reach;  // what is farther away counts nothing; after a look for something in the way, below 0 where it is
    LanesOf<std::uint32_t> mask, id, flags;
};
struct HitLanes {
    Lanes3 normal;
    Lanes u, v;
    LanesOf<std::uint32_t> triangle, mesh, instance;  // mesh ~0: nothing was met; instance ~0: what stands still
};
struct MetLanes {
    RayLanes ray;  // `reach` becomes the distance of what is met
    HitLanes hit;

    // A ray that has met nothing yet.
    void begin(std::size_t lane, const glm::vec3& origin, const glm::vec3& direction, float time) {
        ray.origin.set(lane, origin);
        ray.direction.set(lane, direction);
        ray.nearest[lane] = 0.0F;
        ray.time[lane] = time;
        ray.reach[lane] = std::numeric_limits<float>::infinity();
        ray.mask[lane] = ~0U;
        hit.mesh[lane] = hit.instance[lane] = ~0U;
    }
    [[nodiscard]] bool has_met(std::size_t lane) const { return hit.mesh[lane] != ~0U; }
};

// The triangles that rays have met, in the world.
struct TriangleLanes {
    std::array<Lanes3, 3> corner;
    std::array<Lanes3, 3> normal;  // of the vertices; 0 where the mesh has none
    std::array<Lanes2, 3> uv;
    Lanes u, v;     // where
    Lanes winding;  // -1 where an instance mirrors, else 1
};

}  // namespace rs::capture
