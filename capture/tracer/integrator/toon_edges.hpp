#pragma once
// Edges of a drawing, found by rays around a ray: a disc of some radius stands at the hit, perpendicular to the ray;
// rays parallel to it, along four diameters of nine points each, sample the depth of the surface there. Source: N.
// Burnett and T. Piazza, "Toon Shading Using Distributed Raytracing", section 3.
//
//        ray ──────────────►│· · · · (4) · · · ·│   depths t[0..8] of one diameter, spacing h = radius / 4
//
// Out from the middle, the nearer surface has the line, on its own side: where the next ray misses, or meets something
// farther than the slope until there, and the slope after it, would have it. Where it meets something nearer, that
// hides the rest of the diameter. On what is left, an edge is where the slope turns by more than the style's angle and
// the surface's normals turn by as much: facets of a smooth mesh that are seen at a flat angle bend the slope alone.
// A threshold on the depth alone would find edges all over steep planes.

#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/scene/toon_style.hpp"

#include <array>

namespace rs::capture {

// Thread-safe.
class ToonEdges {
public:
    // Refers to `rays`.
    ToonEdges(const RayScene& rays, const ToonStyle& style);

    // Whether an edge passes within the radius of a hit. `direction`, of unit length, is that of the ray which met it.
    [[nodiscard]] bool near_edge(const SurfacePoint& point, const glm::vec3& direction) const;

private:
    static constexpr int kSteps = 4;  // from the middle to the disc's rim
    struct Ray {
        glm::vec3 direction;
        float time;
    };
    struct Diameter {
        std::array<glm::vec3, 2 * kSteps + 1> origins;
        std::array<float, 2 * kSteps + 1> depths;
        float slope;  // of the surface's facet at the middle, towards the end
    };
    // What of a diameter shows the surface that is at its middle.
    struct Extent {
        int first = kSteps, last = kSteps;
        bool ends = false;  // before the rim, where there is an edge
    };
    [[nodiscard]] Extent extent_of(const Diameter& diameter) const;
    // How many steps it goes on to one side, -1 or 1.
    [[nodiscard]] int reach_of(const Diameter& diameter, int side, bool& ends) const;
    [[nodiscard]] bool has_crease(const Diameter& diameter, const Extent& extent, const Ray& ray) const;
    [[nodiscard]] bool normals_turn(const Diameter& diameter, int first, int last, const Ray& ray) const;

    const RayScene& rays_;
    float radius_, spacing_, jump_;
    float cos_angle_, sin_angle_;
};

}  // namespace rs::capture
