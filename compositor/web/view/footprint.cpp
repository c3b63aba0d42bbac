#include "compositor/web/view/footprint.hpp"

#include "rayspace/base/conventions.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::web {
namespace {

constexpr int kSide = Footprint::kSide;
constexpr double kHalfSide = kSide / 2.0;
constexpr int kHeights = 128;           // bins of Y
constexpr double kHeightRange = 4;      // object radii, of Y in [-2, 2)
constexpr std::size_t kCells = 300000;  // of a shape map, about; of larger ones every n-th line is used
constexpr std::size_t kWitnesses = 16;  // lines whose silhouettes confirm a surface
constexpr int kMaxMisses = 1;           // of the witnesses
constexpr std::uint32_t kMinHits = 3;   // cells of the shape maps that agree on a surface
constexpr double kLowestPart = 0.002;   // of all hits; lower ones are taken for errors of the depth
constexpr double kDiscRadius = 0.6;

// Surface points counted by X, Z and Y.
struct PointHistogram {
    std::vector<std::uint32_t> counts = std::vector<std::uint32_t>(std::size_t{kSide} * kSide * kHeights);

    void add(const glm::dvec3& p) {
        const auto i = static_cast<int>(std::floor((p.x + 1) * kHalfSide));
        const auto j = static_cast<int>(std::floor((p.z + 1) * kHalfSide));
        const auto k = static_cast<int>(std::floor((p.y + kHeightRange / 2) * (kHeights / kHeightRange)));
        if (i < 0 || j < 0 || k < 0 || i >= kSide || j >= kSide || k >= kHeights) return;
        ++counts[(static_cast<std::size_t>(j) * kSide + static_cast<std::size_t>(i)) * kHeights +
                 static_cast<std::size_t>(k)];
    }

    [[nodiscard]] double lowest_surface() const {
        std::vector<std::uint64_t> by_height(kHeights);
        std::uint64_t all = 0;
        for (std::size_t n = 0; n < counts.size(); ++n) {
            by_height[n % kHeights] += counts[n];
            all += counts[n];
        }
        std::uint64_t below = 0;
        std::size_t k = 0;
        while (k + 1 < kHeights && static_cast<double>(below += by_height[k]) <= kLowestPart * static_cast<double>(all))
            ++k;
        return static_cast<double>(k) * (kHeightRange / kHeights) - kHeightRange / 2;
    }
};

// Lines of a shape map as views from the reference viewpoints (rayspace/api/types/shape_map.hpp).
class LineViews {
public:
    explicit LineViews(const Ring& ring) : shape_(ring.shape) {
        for (std::size_t n = 0; n < shape_.gaps.size(); ++n) {
            const double first = azimuth_of(ring, n);
            const double turn = std::remainder(azimuth_of(ring, (n + 1) % shape_.gaps.size()) - first, 2 * kPi);
            const int lines = shape_.gaps[n].lines;
            for (int line = 0; line < lines; ++line) {
                const double azimuth = first + turn * (line + 0.5) / lines;
                normals_.emplace_back(std::sin(azimuth), std::cos(azimuth));
            }
        }
    }

    void add_points(PointHistogram& points) const {
        const std::size_t step = 1 + shape_.cells.size() / kCells;
        for (std::size_t line = 0; line < normals_.size(); line += step) {
            for (int pi = 0; pi < shape_.p_cells; ++pi) add_column(line, pi, points);
        }
    }

private:
    // From the vectors of the first plane: a along (1, 0, 0), c along (0, 0, 1).
    static double azimuth_of(const Ring& ring, std::size_t n) {
        const NormalLine& line = ring.shape.normal_lines[n * static_cast<std::size_t>(ring.planes)];
        return std::atan2(static_cast<double>(line.a_q20), static_cast<double>(line.c_q20));
    }

    [[nodiscard]] const ShapeCell* column(std::size_t line, int pi) const {
        return &shape_.cells[(line * static_cast<std::size_t>(shape_.p_cells) + static_cast<std::size_t>(pi)) *
                             static_cast<std::size_t>(shape_.bands)];
    }

    void add_column(std::size_t line, int pi, PointHistogram& points) const {
        const double p = (pi + 0.5) / p_cells_per_unit_ - p_half_;
        const double sine = p / distance_;
        if (!(std::abs(sine) < 1)) return;
        const double cosine = std::sqrt(1 - sine * sine);
        const glm::dvec2 normal = normals_[line];  // (X, Z)
        const glm::dvec2 tangent(normal.y, -normal.x);
        const glm::dvec2 foot = p * (cosine * tangent + sine * normal);
        const glm::dvec2 along = sine * tangent - cosine * normal;
        const ShapeCell* cells = column(line, pi);
        for (int band = 0; band < shape_.bands; ++band) {
            if (!cells[band].has_surface()) continue;
            const double depth = depth_low_ + cells[band].depth * depth_step_;
            const double h = h_low_ + (band + 0.5) / bands_per_unit_;
            const glm::dvec2 at = foot + depth * along;
            const glm::dvec3 point(at.x, h + depth * (h - height_) / (distance_ * cosine), at.y);
            if (is_in_silhouettes(point)) points.add(point);
        }
    }

    [[nodiscard]] bool is_in_silhouettes(const glm::dvec3& point) const {
        int misses = 0;
        for (std::size_t n = 0; n < kWitnesses && misses <= kMaxMisses; ++n) {
            if (!is_in_silhouette(n * normals_.size() / kWitnesses, point)) ++misses;
        }
        return misses <= kMaxMisses;
    }

    // True if the ray through the point meets a surface, or one of its neighbours does.
    [[nodiscard]] bool is_in_silhouette(std::size_t line, const glm::dvec3& point) const {
        const glm::dvec2 normal = normals_[line];
        const double right = point.x * normal.y - point.z * normal.x;
        const double ahead = distance_ - point.x * normal.x - point.z * normal.y;
        const double inverse = 1 / std::sqrt(right * right + ahead * ahead);
        const double h = height_ + (point.y - height_) * distance_ * ahead * inverse * inverse;
        const int pi = static_cast<int>(std::floor((distance_ * right * inverse + p_half_) * p_cells_per_unit_));
        const int hi = static_cast<int>(std::floor((h - h_low_) * bands_per_unit_));
        for (int p = std::max(pi - 1, 0); p <= std::min(pi + 1, shape_.p_cells - 1); ++p) {
            const ShapeCell* cells = column(line, p);
            for (int band = std::max(hi - 1, 0); band <= std::min(hi + 1, shape_.bands - 1); ++band) {
                if (cells[band].has_surface()) return true;
            }
        }
        return false;
    }

    const ShapeMap& shape_;
    std::vector<glm::dvec2> normals_;  // [line], from the axis to the viewpoint: (X, Z)
    double distance_ = std::ldexp(shape_.reference_distance_q20, -20);
    double height_ = std::ldexp(shape_.reference_height_q20, -20);
    double p_half_ = std::ldexp(shape_.p_half_q20, -20);
    double p_cells_per_unit_ = std::ldexp(shape_.p_cells_per_unit_q12, -12);
    double h_low_ = std::ldexp(shape_.h_low_q20, -20);
    double bands_per_unit_ = std::ldexp(shape_.bands_per_unit_q12, -12);
    double depth_low_ = std::ldexp(shape_.depth_low_q20, -20);
    double depth_step_ = std::ldexp(shape_.depth_step_q24, -24);
};

std::vector<std::uint8_t> clearances(const PointHistogram& points, double ground) {
    std::vector<std::uint8_t> clearance(std::size_t{kSide} * kSide, Footprint::kNone);
    for (std::size_t cell = 0; cell < clearance.size(); ++cell) {
        std::uint32_t hits = 0;
        for (std::size_t k = 0; k < kHeights; ++k) {
            hits += points.counts[cell * kHeights + k];
            if (hits < kMinHits) continue;
            const double y = (static_cast<double>(k) + 0.5) * (kHeightRange / kHeights) - kHeightRange / 2;
            const double steps = std::max(0.0, y - ground) * Footprint::kPerRadius;
            clearance[cell] = static_cast<std::uint8_t>(std::min<double>(steps, Footprint::kHighest));
            break;
        }
    }
    return clearance;
}

// Grayscale hole filling: the clearance of a cell becomes the highest of the barriers that enclose it, if that is less;
// that is, the maximum over the paths to the border of the least clearance on the path.
void fill_enclosed(std::vector<std::uint8_t>& clearance) {
    std::vector<std::uint8_t> filled(clearance.size());
    const auto at = [&](int i, int j) {
        return i < 0 || j < 0 || i >= kSide || j >= kSide ? Footprint::kNone
                                                          : filled[static_cast<std::size_t>(j * kSide + i)];
    };
    bool changed = true;
    const auto update = [&](int cell) {
        const int i = cell % kSide;
        const int j = cell / kSide;
        const auto n = static_cast<std::size_t>(cell);
        const std::uint8_t open =
            std::min(clearance[n], std::max({at(i - 1, j), at(i + 1, j), at(i, j - 1), at(i, j + 1)}));
        if (open <= filled[n]) return;
        filled[n] = open;
        changed = true;
    };
    while (changed) {
        changed = false;
        for (int cell = 0; cell < kSide * kSide; ++cell) update(cell);
        for (int cell = kSide * kSide - 1; cell >= 0; --cell) update(cell);
    }
    clearance = std::move(filled);
}

std::vector<std::uint8_t> disc() {
    std::vector<std::uint8_t> clearance(std::size_t{kSide} * kSide, Footprint::kNone);
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
            const double radius = std::hypot(i + 0.5 - kHalfSide, j + 0.5 - kHalfSide) / kHalfSide;
            if (radius < kDiscRadius) clearance[static_cast<std::size_t>(j * kSide + i)] = 0;
        }
    }
    return clearance;
}

}  // namespace

Footprint footprint(const RaySpaceObject& object) {
    PointHistogram points;
    bool has_shape = false;
    for (const Ring& ring : object.rings) {
        if (ring.shape.empty()) continue;
        LineViews(ring).add_points(points);
        has_shape = true;
    }
    Footprint made;
    if (object.foot_q20) {
        made.ground = std::ldexp(*object.foot_q20, -20);
    } else if (has_shape) {
        made.ground = points.lowest_surface();
    } else {
        // The lowest row of the first photo, at the axis.
        const CapturedView& view = object.views[object.rings.front().views.front()];
        const double rows = std::ldexp(view.cy_q16, -16) - object.height;
        made.ground = std::ldexp(view.height_q20, -20) +
                      rows * std::ldexp(view.lines.front().l0_q20, -20) / std::ldexp(view.fl_y_q16, -16);
    }
    made.clearance = has_shape ? clearances(points, made.ground) : disc();
    if (has_shape) fill_enclosed(made.clearance);
    return made;
}

}  // namespace rs::web
