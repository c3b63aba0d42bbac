#include "capture/tracer/integrator/toon_edges.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {

namespace {

constexpr int kMinDiameters = 4, kMaxDiameters = 64;
constexpr float kNarrower_px = 0.4F;   // tolerated narrowing of a line between two diameters
constexpr float kHidden_px = 0.3F;     // tolerated narrowing of a line whose crease lies within the last chord
constexpr float kMaxAngle_rad = 3.1F;  // of a crease; keeps the tangent of its half finite
constexpr float kMinRayCos = 0.01F;    // lower bound for the cosine between a ray and a normal

// Distance from the ray origins to the disc, in radii: in front of the facet's plane over the whole disc.
float ray_offset(float cos_ray) {
    return 4.0F + 1.25F * std::sqrt(std::max(1.0F - cos_ray * cos_ray, 0.0F)) / cos_ray;
}

// Two perpendicular directions in the disc, the first one horizontal, so that they vary little between adjacent views.
void span_disc(const glm::vec3& direction, glm::vec3& u, glm::vec3& v) {
    const glm::vec3 level = glm::cross(direction, glm::vec3(0, 1, 0));
    const float length = glm::length(level);
    u = length > 1e-3F ? level / length : glm::normalize(glm::cross(direction, glm::vec3(1, 0, 0)));
    v = glm::cross(u, direction);
}

// Number of diameters that keeps the narrowing of lines below kNarrower_px.
std::size_t diameter_count(float radius_px) {
    std::size_t count = kMinDiameters;
    // 1 - cos(x) is x * x / 2 here.
    for (float narrower_px = radius_px * kPiF * kPiF / (8.0F * kMinDiameters * kMinDiameters);
         narrower_px > kNarrower_px && count < kMaxDiameters; narrower_px /= 4.0F) {
        count *= 2;
    }
    return count;
}

// Cosine and sine of the angle to the first diameter, for each diameter after the first kMinDiameters. The first N of
// all diameters, N = 8, 16, ..., are evenly spaced.
std::array<glm::vec2, kMaxDiameters - kMinDiameters> make_turns() {
    std::array<glm::vec2, kMaxDiameters - kMinDiameters> turns;
    std::size_t count = 0;
    for (int all = 2 * kMinDiameters; all <= kMaxDiameters; all *= 2) {
        for (int odd = 1; odd < all; odd += 2) {
            const double turn_rad = kPi * odd / all;
            turns[count++] = glm::vec2(glm::dvec2(std::cos(turn_rad), std::sin(turn_rad)));
        }
    }
    return turns;
}

const std::array<glm::vec2, kMaxDiameters - kMinDiameters> kTurns = make_turns();

// Direction of a diameter of the disc spanned by u and v.
glm::vec3 diameter_direction(std::size_t diameter, const glm::vec3& u, const glm::vec3& v) {
    constexpr float kDiagonal = 0.70710678F;
    switch (diameter) {
        case 0:
            return u;
        case 1:
            return v;
        case 2:
            return (u + v) * kDiagonal;
        case 3:
            return (u - v) * kDiagonal;
        default:
            return u * kTurns[diameter - kMinDiameters].x + v * kTurns[diameter - kMinDiameters].y;
    }
}

}  // namespace

ToonEdges::ToonEdges(const RayScene& rays, const ToonStyle& style, float pixel_rad)
    : rays_(rays),
      depth_alone_(style.edge_test == ToonStyle::EdgeTest::depth),
      radius_(style.edge_radius),
      spacing_(style.edge_radius / kSteps),
      jump_(style.edge_depth > 0.0F ? style.edge_depth : 2.0F * style.edge_radius),
      pixel_rad_(pixel_rad),
      cos_angle_(std::cos(style.edge_angle_rad)),
      sin_angle_(std::sin(style.edge_angle_rad)),
      // The slopes beside a crease differ by at least 2 tan(angle / 2); the slope of a chord changes in proportion to
      // its part behind the crease.
      min_bend_px_(kHidden_px * kSteps * 2.0F * std::tan(0.5F * std::min(style.edge_angle_rad, kMaxAngle_rad))) {}

bool ToonEdges::is_near_edge(const SurfacePoint& point, const glm::vec3& direction, float previous_distance) const {
    if (!(radius_ > 0.0F)) return false;
    const float cos_ray = std::max(-glm::dot(point.geometric_normal, direction), kMinRayCos);
    const float before = std::min(radius_ * ray_offset(cos_ray), 0.999F * point.distance);
    const glm::vec3 centre = point.position - direction * before;
    glm::vec3 u, v;
    span_disc(direction, u, v);
    const Ray ray{direction, point.time, radius_ / ((previous_distance + point.distance) * pixel_rad_)};
    const std::size_t count = diameter_count(ray.radius_px);
    for (std::size_t d = 0; d < count; ++d) {
        const glm::vec3 axis = diameter_direction(d, u, v);
        Diameter diameter;
        diameter.direction = axis;
        std::array<glm::vec3, RayScene::kBundle> origins;
        for (int i = -kSteps; i <= kSteps; ++i) {
            diameter.origins[static_cast<std::size_t>(i + kSteps)] = centre + axis * (static_cast<float>(i) * spacing_);
        }
        std::copy_n(diameter.origins.begin(), kSteps, origins.begin());
        std::copy_n(diameter.origins.begin() + kSteps + 1, kSteps, origins.begin() + kSteps);
        const RayScene::Bundle depths = rays_.distances(origins, direction, point.time);
        std::copy_n(depths.begin(), kSteps, diameter.depths.begin());
        std::copy_n(depths.begin() + kSteps, kSteps, diameter.depths.begin() + kSteps + 1);
        diameter.depths[kSteps] = before;
        if (depth_alone_) {
            if (std::ranges::any_of(depths, [&](float depth) { return depth - before > jump_; })) return true;
            continue;
        }
        diameter.slope = glm::dot(point.geometric_normal, axis) / cos_ray;
        const Extent extent = find_extent(diameter);
        if (extent.has_edge || has_crease(diameter, extent, ray)) return true;
    }
    return false;
}

ToonEdges::Extent ToonEdges::find_extent(const Diameter& diameter) const {
    Extent extent;
    extent.first -= count_steps(diameter, -1, extent.has_edge);
    extent.last += count_steps(diameter, 1, extent.has_edge);
    return extent;
}

int ToonEdges::count_steps(const Diameter& diameter, int side, bool& has_edge) const {
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
            has_edge = has_edge || misses || step > before;
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
    // Compares adjacent chords, and chords with one between them, which may lie across the edge.
    for (int gap = 1; gap <= 2; ++gap) {
        for (int i = extent.first; i + gap + 1 <= extent.last; ++i) {
            if (slope_angle_exceeds(spacing_, rise(i), rise(i + gap)) &&
                normal_angle_exceeds(diameter, i, i + gap + 1, ray)) {
                return true;
            }
        }
    }
    return has_crease_at_end(diameter, extent, extent.first, extent.first + 1, ray) ||
           has_crease_at_end(diameter, extent, extent.last, extent.last - 1, ray);
}

bool ToonEdges::has_crease_at_end(const Diameter& diameter, const Extent& extent, int outer, int inner,
                                  const Ray& ray) const {
    if (inner < extent.first || inner > extent.last || ray.radius_px < kHidden_px * kSteps) return false;
    const auto depth = [&](int i) { return diameter.depths[static_cast<std::size_t>(i)]; };
    const int before = inner + (inner - outer);
    if (before >= extent.first && before <= extent.last) {
        const float bend = (depth(outer) - depth(inner)) - (depth(inner) - depth(before));
        if (std::abs(bend) * ray.radius_px < min_bend_px_ * spacing_) return false;
    }
    return normal_angle_exceeds(diameter, outer, inner, ray, true);
}

bool ToonEdges::slope_angle_exceeds(float run, float a, float b) const {
    // Compares tangents without division.
    const float sine = run * std::abs(b - a), cosine = run * run + a * b;
    return sine * cos_angle_ > cosine * sin_angle_;
}

bool ToonEdges::normal_angle_exceeds(const Diameter& diameter, int first, int last, const Ray& ray,
                                     bool and_facets) const {
    SurfacePoint here, there;
    if (!rays_.intersect(diameter.origins[static_cast<std::size_t>(first)], ray.direction, ray.time, here) ||
        !rays_.intersect(diameter.origins[static_cast<std::size_t>(last)], ray.direction, ray.time, there)) {
        return false;
    }
    const auto slope = [&](const SurfacePoint& point) {
        return glm::dot(point.geometric_normal, diameter.direction) /
               std::max(-glm::dot(point.geometric_normal, ray.direction), kMinRayCos);
    };
    if (and_facets && !slope_angle_exceeds(1.0F, slope(here), slope(there))) return false;
    return glm::dot(here.shading_normal, there.shading_normal) < cos_angle_;
}

}  // namespace rs::capture
