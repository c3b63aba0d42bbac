#pragma once
// Parametric surfaces as triangles: grids of points, and the surfaces of revolution, tubes, hairs and ellipsoids that
// are made of them. Each is in a file of its own.

#include "capture/tracer/scene/scene.hpp"
#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <span>
#include <vector>

namespace rs::synthetic {

// A rectangular grid of points. Vertex (column i, row j), 0 <= i <= columns, 0 <= j <= rows, has index j * (columns +
// 1) + i. Seen from the front (the side of the normals) columns run to the right and rows upwards.
struct Grid {
    Grid(int columns_, int rows_, bool wrap_columns_ = false, bool wrap_rows_ = false);

    int columns;        // >= 1, faces across
    int rows;           // >= 1, faces up
    bool wrap_columns;  // the last column of points repeats the first, with its own texture coordinates
    bool wrap_rows;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> normals;  // empty = computed from the faces, smooth across the wraps and at poles

    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(column);
    }
};

// Appends the triangles except those with two identical corners (at poles), so that a closed grid stays closed. Linear
// time.
void append_grid(capture::Mesh& mesh, Grid grid);

// Surface of revolution about the Y axis.
struct LatheStyle {
    int segments = 160;             // around
    float crease_rad = 0.6F;        // bends of the profile above this angle are creases
    glm::vec2 v_range{0.0F, 1.0F};  // texture v at the profile's ends; by arc length between
    glm::vec2 offset{0.0F, 0.0F};   // (x, z) of the axis
};

// Rotates `profile` (at least 2 points of (radius >= 0, height), neighbours differ) about the axis. The outside is to
// the right of the profile's direction if the axis is to the left and Y is up: a solid's profile starts on the axis at
// its bottom and ends on the axis at its top. Points with radius 0 are poles. Texture u runs once around, to the right
// as seen from outside, from 0 at +Z.
void append_lathe(capture::Mesh& mesh, std::span<const glm::vec2> profile, const LatheStyle& style = {});

// Tube or band: a circle or an ellipse swept along a path in space, for stems, wires, stitches, ribbons.
struct SweepStyle {
    int sides = 12;                      // >= 3
    bool closed = false;                 // the path's end joins its start (which is not repeated)
    glm::vec3 facing{0.0F, 0.0F, 0.0F};  // the ellipse's short axis at the start, as near as the path allows; 0 = any
    float thickness = 1.0F;              // short axis / long axis of the cross-section
    float v_per_length = 1.0F;           // texture repeats along the path; rounded to an integer if closed
    bool rounded_ends = true;            // closes an open tube with half-ellipsoids
};

// `path`: at least 2 points (3 if closed), neighbours differ; `radii`: one per point, or a single one for all, > 0. The
// cross-section moves without twist (parallel transport; the remaining twist of a closed path is distributed evenly).
// Texture u runs once around.
void append_tube(capture::Mesh& mesh, std::span<const glm::vec3> path, std::span<const float> radii,
                 const SweepStyle& style = {});

// A hair: a thin bent ribbon that tapers to a point.
struct Strand {
    glm::vec3 root{0.0F};
    glm::vec3 direction{0, 1, 0};  // unit length, at the root
    glm::vec3 bend{0.0F};          // the tip is at root + length * (direction + bend)
    glm::vec3 side{1, 0, 0};       // across the ribbon, roughly; not parallel to `direction`
    float length = 0.1F;
    float width = 0.005F;  // at the root
    float u = 0.5F;        // texture u of the whole strand; v runs from 0 at the root to 1 at the tip
};

// Appends 2 * segments - 1 triangles (segments >= 2). The normals fan out across the ribbon to shade like a round hair.
void append_strand(capture::Mesh& mesh, const Strand& strand, int segments);

struct Ellipsoid {
    Frame frame;            // centre and axes
    glm::vec3 radii{1.0F};  // along the frame's x, y, z, > 0

    // Distance from the centre relative to the surface's distance in the same direction: 1 on the surface, less inside.
    [[nodiscard]] float level(glm::vec3 p) const { return glm::length(frame.point_in_part(p) / radii); }
};

// Appends an ellipsoid with poles on the frame's Y axis. Texture u runs once around from the frame's +Z, v from the
// lower to the upper pole. `columns` >= 3, `rows` >= 2.
void append_ellipsoid(capture::Mesh& mesh, const Ellipsoid& ellipsoid, int columns, int rows);

struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;  // outward, unit length
};

// Result of one step of rejection sampling. Kept points are uniform by area.
struct RejectionSample {
    SurfacePoint point;
    bool keep = false;
};
RejectionSample sample_surface(const Ellipsoid& ellipsoid, Random& random);

// Selection weight of an ellipsoid that makes the density of kept points the same for all ellipsoids.
float sampling_weight(const Ellipsoid& ellipsoid);

}  // namespace rs::synthetic
