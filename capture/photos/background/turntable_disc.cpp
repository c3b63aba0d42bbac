#include "capture/photos/background/turntable_disc.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace rs::capture {
namespace {

using DiscParameters = BackgroundParameters::Disc;

// Visibility of a circle as an edge.
struct RimContrast {
    double contrast = 0;    // mean over the known part, 0..1
    double known = 0;       // share of the circle
    int clear_octants = 0;  // of 8
    [[nodiscard]] double score() const { return contrast * std::min(1.0, known / 0.5); }
};

// Point of a circle in the image with the outward normal.
struct RimPoint {
    glm::dvec2 px{};
    glm::dvec2 normal{};  // of length 1; 0 where the circle is seen edge-on
};

// Cosines and sines of equally spaced angles and of their neighbours for the tangents, computed once: tens of thousands
// of circles are tried at the same angles.
class CircleSampling {
public:
    explicit CircleSampling(int count) : count_(count) {
        constexpr double kTangentStep_rad = 0.02;
        const auto direction = [](double angle) { return glm::dvec2(std::cos(angle), std::sin(angle)); };
        for (int i = 0; i < count; ++i) {
            const double angle = angle_rad(i);
            directions_.push_back(
                {direction(angle), direction(angle - kTangentStep_rad), direction(angle + kTangentStep_rad)});
        }
    }
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] double angle_rad(int i) const { return 2 * std::numbers::pi * i / count_; }
    [[nodiscard]] RimPoint rim_point(const DiscPlane& plane, double radius, int i) const {
        const Directions& d = directions_[static_cast<std::size_t>(i)];
        const glm::dvec2 tangent = plane.px_on_circle(radius, d.after) - plane.px_on_circle(radius, d.before);
        const double length = glm::length(tangent);
        const glm::dvec2 normal = length > 1e-9 ? glm::dvec2(tangent.y, -tangent.x) / length : glm::dvec2(0);
        return {plane.px_on_circle(radius, d.at), normal};
    }

private:
    struct Directions {
        glm::dvec2 at, before, after;
    };
    int count_;
    std::vector<Directions> directions_;
};

// Measures rims in the known part of the plate.
class RimDetector {
public:
    RimDetector(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known, const DiscParameters& parameters)
        : parameters_(parameters), colour_(plate.height(), plate.width()), known_(mat_view(known)) {
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                const Rgba8& p = plate(x, y);
                colour_(y, x) = {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b)};
            }
        }
    }

    // From colours `distance_px` inside and outside of the rim; `full_contrast_codes` apart counts as 1.
    [[nodiscard]] RimContrast contrast_of(const TurntableDisc& disc, const CircleSampling& sampling, double distance_px,
                                          double full_contrast_codes) const {
        const int count = sampling.count();
        const DiscPlane plane = plane_of(disc);
        if (!is_in_front(disc, plane)) return {};
        double sum = 0;
        int known = 0;
        std::array<double, 8> octant_sum{};
        std::array<int, 8> octant_known{};
        for_known(disc, plane, sampling, distance_px, [&](int i, double codes) {
            const double contrast = std::min(1.0, codes / full_contrast_codes);
            const auto octant = static_cast<std::size_t>(i * 8 / count);
            ++known;
            sum += contrast;
            ++octant_known[octant];
            octant_sum[octant] += contrast;
        });
        if (known == 0) return {};
        int clear_octants = 0;
        for (std::size_t i = 0; i < octant_sum.size(); ++i) {
            const bool is_known = octant_known[i] * 8 >= parameters_.min_octant_share * count;
            const bool is_clear = octant_sum[i] >= parameters_.min_octant_contrast * octant_known[i];
            clear_octants += is_known && is_clear ? 1 : 0;
        }
        return {sum / known, static_cast<double>(known) / count, clear_octants};
    }

    // Share of the known rim whose contrast is at least a third of the median. A disc has one colour before one table;
    // a circle through the foot of the object and something else has not.
    [[nodiscard]] double evenness_of(const TurntableDisc& disc, const CircleSampling& sampling,
                                     double distance_px) const {
        std::vector<double> contrasts;  // codes
        for_known(disc, plane_of(disc), sampling, distance_px, [&](int, double codes) { contrasts.push_back(codes); });
        if (contrasts.empty()) return 0;
        const double third = median(contrasts) / 3;
        const auto even = std::count_if(contrasts.begin(), contrasts.end(), [&](double c) { return c >= third; });
        return static_cast<double>(even) / static_cast<double>(contrasts.size());
    }

    // Signed distance along the normal to the strongest edge within `reach_px`, in px.
    [[nodiscard]] std::optional<double> distance_to_edge(const RimPoint& point, double reach_px) const {
        constexpr double kStep_px = 0.5;
        constexpr double kHalfEdge_px = 1;
        double strongest_codes = parameters_.min_edge_codes;
        std::optional<double> distance_px;
        for (double offset_px = -reach_px; offset_px <= reach_px; offset_px += kStep_px) {
            const std::optional<double> codes =
                contrast_at(point.px + offset_px * point.normal, point.normal * kHalfEdge_px);
            if (!codes || *codes <= strongest_codes) continue;
            strongest_codes = *codes;
            distance_px = offset_px;
        }
        return distance_px;
    }

    // True if the camera can see the whole circle.
    [[nodiscard]] static bool is_in_front(const TurntableDisc& disc, const DiscPlane& plane) {
        if (!(disc.radius > 0) || !std::isfinite(disc.centre_x) || !std::isfinite(disc.centre_y)) return false;
        return plane.is_below_horizon({disc.centre_x, disc.centre_y}) && plane.is_in_front(disc.radius);
    }

    [[nodiscard]] DiscPlane plane_of(const TurntableDisc& disc) const { return {disc, colour_.cols, colour_.rows}; }
    [[nodiscard]] const DiscParameters& parameters() const { return parameters_; }

private:
    // Calls visit(i, contrast in codes) for the known points of the circle.
    template <class Visit>
    void for_known(const TurntableDisc& disc, const DiscPlane& plane, const CircleSampling& sampling,
                   double distance_px, Visit visit) const {
        for (int i = 0; i < sampling.count(); ++i) {
            const RimPoint point = sampling.rim_point(plane, disc.radius, i);
            const std::optional<double> codes = contrast_at(point.px, point.normal * distance_px);
            if (codes) visit(i, *codes);
        }
    }

    // Colour distance between px - offset and px + offset; nullopt unless both are known.
    [[nodiscard]] std::optional<double> contrast_at(glm::dvec2 px, glm::dvec2 offset) const {
        cv::Vec3f inner;
        cv::Vec3f outer;
        if (!sample_bilinear(px - offset, inner) || !sample_bilinear(px + offset, outer)) return std::nullopt;
        return cv::norm(inner - outer);
    }

    bool sample_bilinear(glm::dvec2 px, cv::Vec3f& colour) const {
        const double x = px.x - 0.5;
        const double y = px.y - 0.5;
        const int u = static_cast<int>(std::floor(x));
        const int v = static_cast<int>(std::floor(y));
        if (u < 0 || v < 0 || u + 1 >= colour_.cols || v + 1 >= colour_.rows) return false;
        if (known_(v, u) == 0 || known_(v + 1, u + 1) == 0) return false;
        const auto s = static_cast<float>(x - u);
        const auto t = static_cast<float>(y - v);
        colour = (colour_(v, u) * (1 - s) + colour_(v, u + 1) * s) * (1 - t) +
                 (colour_(v + 1, u) * (1 - s) + colour_(v + 1, u + 1) * s) * t;
        return true;
    }

    const DiscParameters& parameters_;
    cv::Mat3f colour_;  // sRGB codes
    cv::Mat1b known_;
};

// Fits the circle to the strongest edges within `reach_px` of it: one damped Gauss-Newton step with
// Huber weights over tilt, roll, centre and radius, with numerical derivatives.
TurntableDisc fitted_to_edges(const RimDetector& detector, const TurntableDisc& start, double reach_px) {
    constexpr double kDamping = 1e-3;
    const DiscPlane plane = detector.plane_of(start);
    if (!RimDetector::is_in_front(start, plane)) return start;
    const CircleSampling sampling(240);
    const auto disc_of = [&](const std::array<double, 5>& x) {
        return TurntableDisc{start.f_px, x[0], x[1], x[2], x[3], x[4]};
    };
    const std::array<double, 5> from{start.tilt_rad, start.roll_rad, start.centre_x, start.centre_y, start.radius};
    const std::array<double, 5> delta{1e-4, 1e-4, 0.01, 0.01, 1e-4 * start.radius};
    std::vector<DiscPlane> moved;  // [unknown]
    for (std::size_t k = 0; k < from.size(); ++k) {
        std::array<double, 5> x = from;
        x[k] += delta[k];
        moved.push_back(detector.plane_of(disc_of(x)));
    }
    cv::Matx<double, 5, 5> normal = cv::Matx<double, 5, 5>::zeros();
    cv::Vec<double, 5> right_side;
    for (int i = 0; i < sampling.count(); ++i) {
        const RimPoint point = sampling.rim_point(plane, start.radius, i);
        const std::optional<double> distance_px = detector.distance_to_edge(point, reach_px);
        if (!distance_px) continue;
        const double weight = 1 / std::max(1.0, std::abs(*distance_px) / detector.parameters().huber_px);
        cv::Vec<double, 5> derivative;  // px along the normal per delta
        for (std::size_t k = 0; k < from.size(); ++k) {
            const double radius = k == 4 ? start.radius + delta[k] : start.radius;
            derivative[static_cast<int>(k)] =
                glm::dot(moved[k].px_on_circle(radius, sampling.angle_rad(i)) - point.px, point.normal);
        }
        normal += weight * (derivative * derivative.t());
        right_side += weight * *distance_px * derivative;
    }
    for (int k = 0; k < 5; ++k) normal(k, k) *= 1 + kDamping;
    cv::Vec<double, 5> step;  // in deltas
    if (!cv::solve(normal, right_side, step, cv::DECOMP_CHOLESKY)) return start;
    std::array<double, 5> x = from;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += delta[k] * step[static_cast<int>(k)];
    return disc_of(x);
}

struct ScoredDisc {
    TurntableDisc disc;
    double score = 0;
};

// Best circle of a coarse grid over tilt, centre and radius; score 0 if there is none.
ScoredDisc coarse_search(const RimDetector& detector, const cv::Rect& object, int width, int height, double step_px) {
    const DiscParameters& parameters = detector.parameters();
    const CircleSampling sampling(48);
    const double f_px = parameters.nominal_focal_widths * width;
    std::vector<double> rows;  // of the disc's centre; one task each
    for (double y = object.y + 0.5 * object.height; y < object.y + 1.15 * object.height; y += 4 * step_px) {
        rows.push_back(y);
    }
    std::vector<ScoredDisc> best(rows.size());
    for_each_index(rows.size(), [&](std::size_t i) {
        for (int column = -1; column <= 1; ++column) {
            for (double tilt_deg = 6; tilt_deg <= 48; tilt_deg += 3) {
                TurntableDisc disc{f_px,    tilt_deg * std::numbers::pi / 180,
                                   0,       object.x + 0.5 * object.width + 4 * column * step_px,
                                   rows[i], 0};
                const DiscPlane plane(disc, width, height);
                if (!plane.is_below_horizon({disc.centre_x, disc.centre_y})) continue;
                const double unit = plane.unit_per_px();
                for (double a = 0.3 * object.width; a <= 1.3 * object.width; a += 2 * step_px) {
                    if (a * std::sin(disc.tilt_rad) < parameters.min_depth_share * width) continue;  // almost a line
                    disc.radius = a * unit;
                    const double score =
                        detector
                            .contrast_of(disc, sampling, parameters.coarse_contrast_px, parameters.full_contrast_codes)
                            .score();
                    if (score > best[i].score) best[i] = {disc, score};
                }
            }
        }
    });
    return *std::max_element(best.begin(), best.end(),
                             [](const ScoredDisc& a, const ScoredDisc& b) { return a.score < b.score; });
}

// Best circle of a finer grid around `start`.
TurntableDisc fine_search(const RimDetector& detector, const TurntableDisc& start, double step_px) {
    const DiscParameters& parameters = detector.parameters();
    const CircleSampling sampling(96);
    TurntableDisc best = start;
    double best_score = 0;
    const double start_px = start.radius / detector.plane_of(start).unit_per_px();
    TurntableDisc disc = start;
    for (int tilt = -8; tilt <= 8; ++tilt) {
        disc.tilt_rad = start.tilt_rad + tilt * std::numbers::pi / 360;
        for (int row = -4; row <= 4; ++row) {
            disc.centre_y = start.centre_y + row * step_px;
            // Keeps the width in px: the same width nearer to the horizon is a larger radius.
            const double unit = detector.plane_of(disc).unit_per_px();
            for (int column = -3; column <= 3; ++column) {
                disc.centre_x = start.centre_x + column * step_px;
                for (int a = -4; a <= 4; ++a) {
                    disc.radius = (start_px + a * step_px) * unit;
                    const double score =
                        detector
                            .contrast_of(disc, sampling, parameters.contrast_px, parameters.refinement_contrast_codes)
                            .score();
                    if (score > best_score) {
                        best_score = score;
                        best = disc;
                    }
                }
            }
        }
    }
    return best;
}

bool is_clear_rim(const RimDetector& detector, const TurntableDisc& disc) {
    const DiscParameters& parameters = detector.parameters();
    const CircleSampling sampling(360);
    const RimContrast rim =
        detector.contrast_of(disc, sampling, parameters.contrast_px, parameters.full_contrast_codes);
    return rim.contrast >= parameters.min_contrast && rim.known >= parameters.min_known_share &&
           rim.clear_octants >= parameters.min_clear_octants &&
           detector.evenness_of(disc, sampling, parameters.contrast_px) >= parameters.min_evenness;
}

}  // namespace

std::optional<TurntableDisc> find_turntable_disc(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known,
                                                 ConstImageView<std::uint8_t> object,
                                                 const BackgroundParameters::Disc& parameters) {
    const cv::Rect object_box = bounding_box(mat_view(object));
    if (object_box.area() == 0) return std::nullopt;
    const RimDetector detector(plate, known, parameters);
    const double step_px = std::max(1.0, plate.width() / 360.0);
    const ScoredDisc start = coarse_search(detector, object_box, plate.width(), plate.height(), step_px);
    if (start.score <= 0) return std::nullopt;
    TurntableDisc disc = fine_search(detector, start.disc, step_px);
    for (const double reach_px : {6.0, 6.0, 4.0, 4.0, 3.0, 3.0, 3.0}) disc = fitted_to_edges(detector, disc, reach_px);
    if (!is_clear_rim(detector, disc)) return std::nullopt;
    return disc;
}

}  // namespace rs::capture
