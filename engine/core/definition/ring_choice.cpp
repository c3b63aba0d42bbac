#include "engine/core/definition/ring_choice.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ring_axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace rs::engine {
namespace {

double elevation_of(const Ring& ring) {
    return radians(ring.elevation_udeg * 1e-6);
}

// Azimuth of a viewpoint from +Z towards +X, in a ring's axes.
double azimuth_of(const Ring& ring, std::size_t view) {
    const NormalLine& line = ring.shape.normal_lines[view * static_cast<std::size_t>(ring.planes)];
    return std::atan2(line.a_q20, line.c_q20);
}

bool is_closed(const ShapeMap& shape) {
    return std::all_of(shape.gaps.begin(), shape.gaps.end(), [](const ShapeGap& gap) { return gap.lines > 0; });
}

// The angle from azimuth `from` to `to` in turning order, 0..2 pi.
double turn_to(double from, double to) {
    const double turn = std::fmod(to - from, 2 * kPi);
    return turn < 0 ? turn + 2 * kPi : turn;
}

struct Direction {
    double azimuth = 0, elevation = 0;
};

Direction direction_of(const glm::dvec3& v) {
    return {std::atan2(v.x, v.z), std::atan2(v.y, std::hypot(v.x, v.z))};
}

// Turn from an azimuth to the nearest end of the run of gaps that contains it; negative outside of all runs.
double turn_to_end(const Ring& ring, double azimuth) {
    const std::size_t count = ring.views.size();
    double outside = kPi;
    for (std::size_t n = 0; n < count; ++n) {
        const bool is_run = ring.shape.gaps[n].lines > 0;
        const bool was_run = ring.shape.gaps[(n + count - 1) % count].lines > 0;
        if (!is_run || was_run) continue;
        std::size_t length = 1;
        while (length < count && ring.shape.gaps[(n + length) % count].lines > 0) ++length;
        const double first = azimuth_of(ring, n);
        const double width = turn_to(first, azimuth_of(ring, (n + length) % count));
        const double after = turn_to(first, azimuth);
        if (after <= width) return std::min(after, width - after);
        outside = std::min({outside, after - width, 2 * kPi - after});
    }
    return -outside;
}

// Rays of a viewpoint at another distance than the ring's lie between views beside it: the largest turn to them.
double turn_of_rays(const Ring& ring, double distance) {
    const double of_ring = std::ldexp(ring.shape.reference_distance_q20, -20);
    const auto half_angle = [](double d) { return std::asin(std::min(1 / std::max(d, 1.0), 1.0)); };
    return std::abs(half_angle(of_ring) - half_angle(distance));
}

double distance_to(const Ring& ring, const glm::dvec3& viewpoint) {
    const glm::dvec3 v = ring_from_object(ring.rotation) * viewpoint;
    const Direction direction = direction_of(v);
    const double to_turn = std::abs(elevation_of(ring) - direction.elevation);
    if (ring.shape.empty() || is_closed(ring.shape)) return to_turn;
    const double missing = turn_of_rays(ring, std::hypot(v.x, v.z)) - turn_to_end(ring, direction.azimuth);
    return to_turn + std::max(missing, 0.0) * std::cos(direction.elevation);
}

// Smallest distance of another ring about the axis of ring `r`; 0 if there is none.
double spacing_of(const RaySpaceObject& object, const Ring& ring) {
    double spacing = 0;
    for (const Ring& other : object.rings) {
        const double apart = std::abs(elevation_of(other) - elevation_of(ring));
        if (other.rotation == ring.rotation && apart > 0) spacing = spacing > 0 ? std::min(spacing, apart) : apart;
    }
    return spacing;
}

// Arcs about other axes continue the rings about the object's axis beyond the outermost ones: the angle by which a
// viewpoint is nearer to these rings than their spacing beyond them. 0 outside, and without such rings.
double depth_within_rings(const RaySpaceObject& object, const glm::dvec3& viewpoint) {
    const Ring* lowest = nullptr;
    const Ring* highest = nullptr;
    for (const Ring& ring : object.rings) {
        if (!ring.rotation.is_identity()) continue;
        if (lowest == nullptr || ring.elevation_udeg < lowest->elevation_udeg) lowest = &ring;
        if (highest == nullptr || ring.elevation_udeg > highest->elevation_udeg) highest = &ring;
    }
    if (lowest == nullptr) return 0;
    const double elevation = direction_of(viewpoint).elevation;
    const double below_top = elevation_of(*highest) + spacing_of(object, *highest) - elevation;
    const double above_bottom = elevation - elevation_of(*lowest) + spacing_of(object, *lowest);
    return std::max(std::min(below_top, above_bottom), 0.0);
}

// Angle from the nearest ring at which it no longer contributes where `second` is the other one; 0: they are not mixed.
double mixing_range(const RaySpaceObject& object, const Ring& nearest, const Ring& second,
                    const glm::dvec3& viewpoint) {
    if (!(nearest.rotation == second.rotation)) return spacing_of(object, nearest);
    const double elevation = direction_of(ring_from_object(nearest.rotation) * viewpoint).elevation;
    const bool is_between = (elevation_of(nearest) < elevation) == (elevation < elevation_of(second));
    return is_between ? std::abs(elevation_of(second) - elevation_of(nearest)) : 0;
}

}  // namespace

RingChoice choose_rings(const RaySpaceObject& object, const glm::dvec3& viewpoint) {
    if (object.rings.size() == 1) return {};  // traced scenes choose for every ray
    std::vector<double> distances;
    const double within_rings = depth_within_rings(object, viewpoint);
    for (const Ring& ring : object.rings) {
        const double distance = distance_to(ring, viewpoint);
        distances.push_back(ring.rotation.is_identity() ? distance : std::max(distance, within_rings));
    }
    const auto nearest = std::min_element(distances.begin(), distances.end());
    RingChoice choice;
    choice.nearest = static_cast<int>(nearest - distances.begin());
    const Ring& nearest_ring = object.rings[static_cast<std::size_t>(choice.nearest)];
    double to_second = std::numeric_limits<double>::max();
    for (std::size_t r = 0; r < object.rings.size(); ++r) {
        if (static_cast<int>(r) == choice.nearest || distances[r] >= to_second) continue;
        const double range = mixing_range(object, nearest_ring, object.rings[r], viewpoint);
        const double of_second = range - distances[r];
        if (of_second <= 0) continue;
        const long weight_q8 = std::lround(256 * of_second / (range - *nearest + of_second));
        if (weight_q8 == 0) continue;
        to_second = distances[r];
        choice.second = static_cast<int>(r);
        choice.weight_q8 = static_cast<int>(weight_q8);
    }
    return choice;
}

}  // namespace rs::engine
