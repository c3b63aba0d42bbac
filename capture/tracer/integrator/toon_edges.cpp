#include "capture/tracer/integrator/toon_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {

namespace {

constexpr int kDiameters = 4;
constexpr float kFlattest = 0.01F;  // cosine of a ray and a surface's normal, that is told from a flatter one

// How many radii before the disc its rays start: before the facet that is met, if that goes on.
float start_of(float cos_ray) {
    return 4.0F + 1.25F * std::sqrt(std::max(1.0F - cos_ray * cos_ray, 0.0F)) / cos_ray;
}

// Two perpendicular directions in the disc, the first of them level: views beside each other have about the same.
void span_disc(const glm::vec3& direction, glm::vec3& u, glm::vec3& v) {
    const glm::vec3 level = glm::cross(direction, glm::vec3(0, 1, 0));
    const float length = glm::length(level);
    u = length > 1e-3F ? level / length : glm::normalize(glm::cross(direction, glm::vec3(1, 0, 0)));
    v = glm::cross(u, direction);
}

}  // namespace

ToonEdges::ToonEdges(const RayScene& rays, const ToonStyle& style)
    : rays_(rays),
      radius_(style.edge_radius),
      spacing_(style.edge_radius / kSteps),
      jump_(style.edge_depth > 0.0F ? style.edge_depth : 2.0F * style.edge_radius),
      cos_angle_(std::cos(style.edge_angle_rad)),
      sin_angle_(std::sin(style.edge_angle_rad)) {}

bool ToonEdges::near_edge(const SurfacePoint& point, const glm::vec3& direction) const {
    if (!(radius_ > 0.0F)) return false;
    const float cos_ray = std::max(-glm::dot(point.geometric_normal, direction), kFlattest);
    const float before = std::min(radius_ * start_of(cos_ray), 0.999F * point.distance);
    const glm::vec3 middle = point.position - direction * before;
    glm::vec3 u, v;
    span_disc(direction, u, v);
    for (int d = 0; d < kDiameters; ++d) {
        constexpr float kDiagonal = 0.70710678F;
        const std::array<glm::vec3, kDiameters> ways{u, v, (u + v) * kDiagonal, (u - v) * kDiagonal};
        const glm::vec3 way = ways[static_cast<std::size_t>(d)];
        Diameter diameter;
        std::array<glm::vec3, RayScene::kBundle> origins;
        for (int i = -kSteps; i <= kSteps; ++i) {
            const glm::vec3 origin = middle + way * (static_cast<float>(i) * spacing_);
            diameter.origins[static_cast<std::size_t>(i + kSteps)] = origin;
            if (i != 0) origins[static_cast<std::size_t>(i + kSteps - (i > 0 ? 1 : 0))] = origin;
        }
        const RayScene::Bundle depths = rays_.distances(origins, direction, point.time);
        std::copy_n(depths.begin(), kSteps, diameter.depths.begin());
        std::copy_n(depths.begin() + kSteps, kSteps, diameter.depths.begin() + kSteps + 1);
        diameter.depths[kSteps] = before;
        diameter.slope = glm::dot(point.geometric_normal, way) / cos_ray;
        const Extent extent = extent_of(diameter);
        if (extent.ends || has_crease(diameter, extent, {direction, point.time})) return true;
    }
    return false;
}

ToonEdges::Extent ToonEdges::extent_of(const Diameter& diameter) const {
    Extent extent;
    extent.first -= reach_of(diameter, -1, extent.ends);
    extent.last += reach_of(diameter, 1, extent.ends);
    return extent;
}

int ToonEdges::reach_of(const Diameter& diameter, int side, bool& ends) const {
    const auto depth = [&](int step) { return diameter.depths[static_cast<std::size_t>(kSteps + side * step)]; };
    const auto departs = [&](float step, float expected) {
        return std::abs(step - expected) > jump_ + std::abs(expected);
    };
    float before = static_cast<float>(side) * diameter.slope * spacing_;
    for (int i = 1; i <= kSteps; ++i) {
        const float step = depth(i) - depth(i - 1);
        const bool misses = std::isinf(step);
        const bool is_last = i == kSteps || std::isinf(depth(i + 1));
        if (misses || (departs(step, before) && (is_last || departs(step, depth(i + 1) - depth(i))))) {
            ends = ends || misses || step > before;
            return i - 1;
        }
        before = step;
    }
    return kSteps;
}

bool ToonEdges::has_crease(const Diameter& diameter, const Extent& extent, const Ray& ray) const {
    const auto rise = [&](int i) {
        return diameter.depths[static_cast<std::size_t>(i + 1)] - diameter.depths[static_cast<std::size_t>(i)];
    };
    // Of two chords beside each other, and of two with one between, which may lie across the edge.
    for (int gap = 1; gap <= 2; ++gap) {
        for (int i = extent.first; i + gap + 1 <= extent.last; ++i) {
            const float a = rise(i), b = rise(i + gap);
            // The angle between (h, a) and (h, b), without its tangent.
            const float sine = spacing_ * std::abs(b - a), cosine = spacing_ * spacing_ + a * b;
            if (sine * cos_angle_ > cosine * sin_angle_ && normals_turn(diameter, i, i + gap + 1, ray)) return true;
        }
    }
    return false;
}

bool ToonEdges::normals_turn(const Diameter& diameter, int first, int last, const Ray& ray) const {
    SurfacePoint here, there;
    if (!rays_.intersect(diameter.origins[static_cast<std::size_t>(first)], ray.direction, ray.time, here) ||
        !rays_.intersect(diameter.origins[static_cast<std::size_t>(last)], ray.direction, ray.time, there)) {
        return false;
    }
    return glm::dot(here.shading_normal, there.shading_normal) < cos_angle_;
}

}  // namespace rs::capture
