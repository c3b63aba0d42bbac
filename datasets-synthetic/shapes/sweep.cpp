#include "datasets-synthetic/shapes/surfaces.hpp"

#include "datasets-synthetic/shapes/frame.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using glm::vec3;

// One ring of the tube. x: the ellipse's long axis, z: its short axis, y: along the path.
struct Ring {
    Frame frame;
    float radius = 0.0F;
    float length_so_far = 0.0F;
};

vec3 tangent_at(std::span<const vec3> path, int i, bool closed) {
    const int count = static_cast<int>(path.size());
    const int before = closed ? (i + count - 1) % count : std::max(0, i - 1);
    const int after = closed ? (i + 1) % count : std::min(count - 1, i + 1);
    return glm::normalize(path[static_cast<std::size_t>(after)] - path[static_cast<std::size_t>(before)]);
}

// Rotation angle about `axis` from `from` to `to`, both perpendicular to the axis.
float angle_between(vec3 from, vec3 to, vec3 axis) {
    return portable::atan2(glm::dot(glm::cross(from, to), axis), glm::dot(from, to));
}

std::vector<Ring> transported_rings(std::span<const vec3> path, std::span<const float> radii, const SweepStyle& style) {
    std::vector<Ring> rings;
    const int count = static_cast<int>(path.size());
    vec3 facing = style.facing;
    if (glm::dot(facing, facing) == 0.0F) facing = any_perpendicular(tangent_at(path, 0, style.closed));
    float length = 0.0F;
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::size_t>(i);
        if (i > 0) length += glm::length(path[index] - path[index - 1]);
        const Frame frame = frame_facing(path[index], tangent_at(path, i, style.closed), facing);
        facing = frame.axes[2];
        rings.push_back({frame, radii.size() == 1 ? radii[0] : radii[index], length});
    }
    if (style.closed) {
        const Frame& first = rings.front().frame;
        const Frame returned = frame_facing(first.origin, first.axes[1], facing);
        const float twist_rad = angle_between(returned.axes[2], first.axes[2], first.axes[1]);
        for (int i = 0; i < count; ++i) {
            Frame& frame = rings[static_cast<std::size_t>(i)].frame;
            const float share = static_cast<float>(i) / static_cast<float>(count);
            frame.axes = rotation(frame.axes[1], twist_rad * share) * frame.axes;
        }
        rings.push_back(rings.front());
        rings.back().length_so_far = length + glm::length(path.front() - path.back());
    }
    return rings;
}

// Rings of shrinking radius beyond one end, the pole first; `side` is -1 at the start of the path and +1 at its end.
std::vector<Ring> end_cap(const Ring& end, float thickness, float side) {
    constexpr int kSteps = 4;
    std::vector<Ring> cap;
    for (int step = 0; step < kSteps; ++step) {
        const double elevation_rad = kPi / 2 * (1.0 - static_cast<double>(step) / kSteps);
        Ring ring = end;
        const float rise = end.radius * thickness * static_cast<float>(portable::sin(elevation_rad));
        ring.frame.origin += end.frame.axes[1] * (side * rise);
        ring.radius = step == 0 ? 0.0F : end.radius * static_cast<float>(portable::cos(elevation_rad));
        ring.length_so_far += side * rise;
        cap.push_back(ring);
    }
    return cap;
}

}  // namespace

void append_tube(capture::Mesh& mesh, std::span<const vec3> path, std::span<const float> radii,
                 const SweepStyle& style) {
    RS_CHECK(path.size() >= (style.closed ? 3U : 2U) && style.sides >= 3);
    RS_CHECK(radii.size() == 1 || radii.size() == path.size());
    std::vector<Ring> rings = transported_rings(path, radii, style);
    const float total_length = rings.back().length_so_far;
    float v_per_length = style.v_per_length;
    if (style.closed) v_per_length = std::max(1.0F, std::floor(v_per_length * total_length + 0.5F)) / total_length;
    if (!style.closed && style.rounded_ends) {
        const std::vector<Ring> start = end_cap(rings.front(), style.thickness, -1.0F);
        const std::vector<Ring> end = end_cap(rings.back(), style.thickness, 1.0F);
        rings.insert(rings.begin(), start.begin(), start.end());
        rings.insert(rings.end(), end.rbegin(), end.rend());
    }

    Grid grid(style.sides, static_cast<int>(rings.size()) - 1, true, style.closed);
    for (int j = 0; j <= grid.rows; ++j) {
        const Ring& ring = rings[static_cast<std::size_t>(j)];
        for (int i = 0; i <= grid.columns; ++i) {
            const double angle_rad = 2.0 * kPi * i / style.sides;
            const vec3 on_ring{ring.radius * static_cast<float>(portable::sin(angle_rad)), 0.0F,
                               ring.radius * style.thickness * static_cast<float>(portable::cos(angle_rad))};
            grid.positions[grid.index(i, j)] = ring.frame.point(on_ring);
            grid.uvs[grid.index(i, j)] = {static_cast<float>(i) / static_cast<float>(style.sides),
                                          ring.length_so_far * v_per_length};
        }
    }
    append_grid(mesh, std::move(grid));
}

using glm::vec3;

void append_strand(capture::Mesh& mesh, const Strand& strand, int segments) {
    // Tangent of the normals' sideways tilt at the ribbon's edges: 27 degrees.
    constexpr float kFan = 0.5F;
    const auto base = static_cast<unsigned>(mesh.positions.size());
    for (int j = 0; j <= segments; ++j) {
        const float t = static_cast<float>(j) / static_cast<float>(segments);
        const vec3 centre = strand.root + strand.length * (strand.direction * t + strand.bend * (t * t));
        const vec3 along = glm::normalize(strand.direction + strand.bend * (2.0F * t));
        const vec3 face = glm::normalize(glm::cross(strand.side, along));
        const vec3 across = glm::cross(along, face);
        const float half_width = 0.5F * strand.width * (1.0F - t * t);
        if (j == segments) {
            mesh.positions.push_back(centre);
            mesh.normals.push_back(face);
            mesh.uvs.emplace_back(strand.u, 1.0F);
            break;
        }
        for (const float edge : {-1.0F, 1.0F}) {
            mesh.positions.push_back(centre + across * (edge * half_width));
            mesh.normals.push_back(glm::normalize(face + across * (edge * kFan)));
            mesh.uvs.emplace_back(strand.u, t);
        }
    }
    for (unsigned j = 0; j + 1 < static_cast<unsigned>(segments); ++j) {
        const unsigned left = base + 2 * j;
        mesh.triangles.emplace_back(left, left + 1, left + 3);
        mesh.triangles.emplace_back(left, left + 3, left + 2);
    }
    const unsigned last = base + 2 * static_cast<unsigned>(segments - 1);
    mesh.triangles.emplace_back(last, last + 1, last + 2);
}

}  // namespace rs::synthetic
