#pragma once
// Edges of a drawing, found by rays around a ray: a disc of some radius stands at the hit, perpendicular to the ray;
// rays parallel to it, along four diameters of nine points each, sample the depth of the surface there. Source: N.
// Burnett and T. Piazza, "Toon Shading Using Distributed Raytracing", section 3.
//
// N diameters reach an edge halfway between two of them at radius * cos(pi / 2N) only: four make lines narrower by up
// to 8 %. Where that is more than 0.4 px there are 8, 16, ... of them, and narrow lines have four.
//
//        ray ──────────────►│· · · · (4) · · · ·│   depths t[0..8] of one diameter, spacing h = radius / 4
//
// Out from the middle, the nearer surface has the line, on its own side: where the next ray misses, or meets something
// farther than the slope until there, and the slope after it, would have it. Where it meets something nearer, that
// hides the rest of the diameter. On what is left, an edge is where the slope turns by more than the style's angle and
// the surface's normals turn by as much: facets of a smooth mesh that are seen at a flat angle bend the slope alone.
// Slopes are those of chords; between the last two depths, which an edge may divide as it likes, those of the facets.
// A threshold on the depth alone would find edges all over steep planes.

#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/scene/toon_style.hpp"

#include <array>

namespace rs::capture {

// Thread-safe.
class ToonEdges {
public:
    // Refers to `rays`. `pixel_rad`: between the rays of neighbouring pixels, > 0.
    ToonEdges(const RayScene& rays, const ToonStyle& style, float pixel_rad);

    // Whether an edge passes within the radius of a hit. `direction`, of unit length, is that of the ray which met it,
    // and `behind` how far it had come, by mirrors and through glass, before it began.
    [[nodiscard]] bool near_edge(const SurfacePoint& point, const glm::vec3& direction, float behind) const;

private:
    static constexpr int kSteps = 4;  // from the middle to the disc's rim
    struct Ray {
        glm::vec3 direction;
        float time;
        float radius_px;  // of the disc where the ray meets the surface
    };
    struct Diameter {
        std::array<glm::vec3, 2 * kSteps + 1> origins;
        std::array<float, 2 * kSteps + 1> depths;
        glm::vec3 way;  // of unit length, from the first to the last
        float slope;    // of the surface's facet at the middle, along the way
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
    // In the last chord at an end of the extent, from `outer` to `inner`, beside it.
    [[nodiscard]] bool has_crease_at_end(const Diameter& diameter, const Extent& extent, int outer, int inner,
                                         const Ray& ray) const;
    // Whether (run, a) and (run, b) have more than the angle between them.
    [[nodiscard]] bool slopes_turn(float run, float a, float b) const;
    // Whether the normals at two rays do, and if requested the slopes of the facets there.
    [[nodiscard]] bool normals_turn(const Diameter& diameter, int first, int last, const Ray& ray,
                                    bool and_facets = false) const;

    const RayScene& rays_;
    float radius_, spacing_, jump_, pixel_rad_;
    float cos_angle_, sin_angle_;
    float least_bend_px_;  // by a disc's radius: of slopes beside its rim, that may be the beginning of a crease
};

}  // namespace rs::capture
