#pragma once
// Edge detection for toon shading: samples the depth of the surface on a disc centred at the hit and perpendicular to
// the ray, with parallel rays along four diameters of nine points each. Source: N. Burnett and T. Piazza, "Toon Shading
// Using Distributed Raytracing", section 3.
//
// With N diameters, an edge halfway between two of them is reached at radius * cos(pi / 2N) only: four diameters make
// lines narrower by up to 8 %. If that exceeds 0.4 px, 8, 16, ... diameters are used.
//
//        ray ──────────────►│· · · · (4) · · · ·│   depths t[0..8] of one diameter, spacing h = radius / 4
//
// The line lies on the nearer of two surfaces. Stepping outwards from the centre, a depth edge is where the next ray
// misses or hits a point farther than extrapolation with the slopes before and after it predicts. A nearer hit hides
// the rest of the diameter. On the remaining extent, a crease is where both the slope and the surface normal turn by
// more than the style's angle: facets of a smooth mesh at a grazing angle change the slope only. Slopes are those of
// chords, except between the last two depths, where the crease may lie anywhere: there those of the facets.
// A threshold on depth alone reports edges all over steep planes (ToonStyle::EdgeTest::depth, for comparison).

#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/scene/toon_style.hpp"

#include <array>

namespace rs::capture {

// Thread-safe.
class ToonEdges {
public:
    /// Keeps a reference to `rays`.
    /// \param pixel_rad angle between adjacent pixels' rays, > 0
    ToonEdges(const RayScene& rays, const ToonStyle& style, float pixel_rad);

    /// Returns true if an edge lies within the line radius of a hit.
    /// \param direction of the ray, unit length
    /// \param previous_distance path length from the camera to the ray's origin (over mirrors and through glass)
    [[nodiscard]] bool is_near_edge(const SurfacePoint& point, const glm::vec3& direction,
                                    float previous_distance) const;

private:
    static constexpr int kSteps = 4;  // from the disc's centre to its rim
    struct Ray {
        glm::vec3 direction;
        float time;
        float radius_px;  // of the disc at the hit
    };
    struct Diameter {
        std::array<glm::vec3, 2 * kSteps + 1> origins;
        std::array<float, 2 * kSteps + 1> depths;
        glm::vec3 direction;  // unit length, from the first to the last
        float slope;          // of the facet at the centre, along `direction`
    };
    // Part of a diameter that belongs to the surface at its centre.
    struct Extent {
        int first = kSteps, last = kSteps;
        bool has_edge = false;  // ends at a depth edge before the rim
    };
    [[nodiscard]] Extent find_extent(const Diameter& diameter) const;
    // Number of steps of the extent to one side, -1 or 1.
    [[nodiscard]] int count_steps(const Diameter& diameter, int side, bool& has_edge) const;
    [[nodiscard]] bool has_crease(const Diameter& diameter, const Extent& extent, const Ray& ray) const;
    // Tests the last chord at one end of the extent, from `outer` to the adjacent `inner`.
    [[nodiscard]] bool has_crease_at_end(const Diameter& diameter, const Extent& extent, int outer, int inner,
                                         const Ray& ray) const;
    // Returns true if the angle between (run, a) and (run, b) exceeds the style's angle.
    [[nodiscard]] bool slope_angle_exceeds(float run, float a, float b) const;
    // Returns true if the angle between the normals at two rays, and optionally between the slopes of their facets,
    // exceeds the style's angle.
    [[nodiscard]] bool normal_angle_exceeds(const Diameter& diameter, int first, int last, const Ray& ray,
                                            bool and_facets = false) const;

    const RayScene& rays_;
    bool depth_alone_;
    float radius_, spacing_, jump_, pixel_rad_;
    float cos_angle_, sin_angle_;
    float min_bend_px_;  // times the disc's radius: smallest slope change at the rim that may be a crease
};

}  // namespace rs::capture
