#include "capture/photos/background/turntable_disc.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/background/disc_plane.hpp"
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

constexpr double kNominalFocal_widths = 1.4;

// How well a circle stands out.
struct Rim {
    double contrast = 0;    // mean over what is known, 0..1
    double known = 0;       // share of the circle
    int clear_octants = 0;  // eighths of the circle that stand out
    [[nodiscard]] double score() const { return contrast * std::min(1.0, known / 0.5); }
};

// A point of a circle in the picture, and which way is out of it.
struct RimPlace {
    glm::dvec2 px{};
    glm::dvec2 normal{};  // of length 1; 0 where the circle is seen from its edge
};

// Cosines and sines of angles all around, and of what lies a little before and behind each. Tens of thousands of
// circles are tried at the same angles.
class AroundCircle {
public:
    explicit AroundCircle(int places) : places_(places) {
        constexpr double kApart_rad = 0.02;
        const auto direction = [](double angle_rad) { return glm::dvec2(std::cos(angle_rad), std::sin(angle_rad)); };
        for (int i = 0; i < places; ++i) {
            const double angle = angle_rad(i);
            directions_.push_back({direction(angle), direction(angle - kApart_rad), direction(angle + kApart_rad)});
        }
    }
    [[nodiscard]] int places() const { return places_; }
    [[nodiscard]] double angle_rad(int i) const { return 2 * std::numbers::pi * i / places_; }
    [[nodiscard]] RimPlace rim_place(const DiscPlane& plane, double radius, int i) const {
        const Directions& d = directions_[static_cast<std::size_t>(i)];
        const glm::dvec2 tangent = plane.on_circle(radius, d.behind) - plane.on_circle(radius, d.before);
        const double length = glm::length(tangent);
        const glm::dvec2 normal = length > 1e-9 ? glm::dvec2(tangent.y, -tangent.x) / length : glm::dvec2(0);
        return {plane.on_circle(radius, d.at), normal};
    }

private:
    struct Directions {
        glm::dvec2 at, before, behind;
    };
    int places_;
    std::vector<Directions> directions_;
};

class RimSearch {
public:
    RimSearch(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known)
        : colour_(plate.height(), plate.width()), known_(mat_over(known)) {
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                const Rgba8& p = plate(x, y);
                colour_(y, x) = {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b)};
            }
        }
    }

    // Of colours so far apart on either side; what differs by `clear_codes` stands out entirely.
    [[nodiscard]] Rim rim_of(const TurntableDisc& disc, const AroundCircle& around, double apart_px,
                             double clear_codes) const {
        const int samples = around.places();
        const DiscPlane plane = this->plane(disc);
        if (!stands_before_camera(disc, plane)) return {};
        double sum = 0;
        int known = 0;
        std::array<double, 8> octant_sum{};
        std::array<int, 8> octant_known{};
        visit_known(disc, plane, around, apart_px, [&](int i, double codes) {
            const double contrast = std::min(1.0, codes / clear_codes);
            const auto octant = static_cast<std::size_t>(i * 8 / samples);
            ++known;
            sum += contrast;
            ++octant_known[octant];
            octant_sum[octant] += contrast;
        });
        if (known == 0) return {};
        constexpr double kClearOctant = 0.5;
        int clear_octants = 0;
        for (std::size_t i = 0; i < octant_sum.size(); ++i) {
            const bool enough = octant_known[i] * 24 >= samples;  // a third of the eighth
            clear_octants += enough && octant_sum[i] >= kClearOctant * octant_known[i] ? 1 : 0;
        }
        return {sum / known, static_cast<double>(known) / samples, clear_octants};
    }

    // Of what is known of a circle, the share that stands out by at least a third of what the median of it does. A
    // disc has one colour against one table; a circle through the foot of the object and something else has not.
    [[nodiscard]] double evenness(const TurntableDisc& disc, const AroundCircle& around, double apart_px) const {
        std::vector<double> known_codes;
        visit_known(disc, plane(disc), around, apart_px, [&](int, double codes) { known_codes.push_back(codes); });
        if (known_codes.empty()) return 0;
        const double third = median(known_codes) / 3;
        const auto even = std::count_if(known_codes.begin(), known_codes.end(), [&](double c) { return c >= third; });
        return static_cast<double>(even) / static_cast<double>(known_codes.size());
    }

    // How far along its normal the strongest edge near a place is.
    [[nodiscard]] std::optional<double> edge_beside(const RimPlace& place, double reach_px) const {
        constexpr double kStep_px = 0.5;
        constexpr double kApart_px = 1;
        double strongest_codes = 12;
        std::optional<double> found;
        for (double offset_px = -reach_px; offset_px <= reach_px; offset_px += kStep_px) {
            const std::optional<double> codes =
                contrast_at(place.px + offset_px * place.normal, place.normal * kApart_px);
            if (!codes || *codes <= strongest_codes) continue;
            strongest_codes = *codes;
            found = offset_px;
        }
        return found;
    }

    // Whether there is a picture of all of the circle.
    [[nodiscard]] static bool stands_before_camera(const TurntableDisc& disc, const DiscPlane& plane) {
        if (!(disc.radius > 0) || !std::isfinite(disc.centre_x) || !std::isfinite(disc.centre_y)) return false;
        return plane.below_horizon({disc.centre_x, disc.centre_y}) && plane.visible(disc.radius);
    }

    [[nodiscard]] DiscPlane plane(const TurntableDisc& disc) const { return {disc, colour_.cols, colour_.rows}; }

private:
    // Calls visit(i, contrast in codes) for those of a circle's samples that are known.
    template <class Visit>
    void visit_known(const TurntableDisc& disc, const DiscPlane& plane, const AroundCircle& around, double apart_px,
                     Visit visit) const {
        for (int i = 0; i < around.places(); ++i) {
            const RimPlace place = around.rim_place(plane, disc.radius, i);
            const std::optional<double> codes = contrast_at(place.px, place.normal * apart_px);
            if (codes) visit(i, *codes);
        }
    }

    // Of what stands on either side; nothing where either is not known.
    [[nodiscard]] std::optional<double> contrast_at(glm::dvec2 px, glm::dvec2 apart) const {
        cv::Vec3f inner;
        cv::Vec3f outer;
        if (!sample(px - apart, inner) || !sample(px + apart, outer)) return std::nullopt;
        return cv::norm(inner - outer);
    }

    bool sample(glm::dvec2 px, cv::Vec3f& colour) const {
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

    cv::Mat3f colour_;
    cv::Mat1b known_;
};

// Draws the circle to the strongest edges at most `reach_px` beside it: one Gauss-Newton step with Huber's weights.
TurntableDisc drawn_to_edges(const RimSearch& search, const TurntableDisc& start, double reach_px) {
    const DiscPlane plane = search.plane(start);
    if (!RimSearch::stands_before_camera(start, plane)) return start;
    const AroundCircle around(240);
    constexpr double kHuber_px = 1;
    constexpr double kDamping = 1e-3;
    const auto disc_of = [&](const std::array<double, 5>& x) {
        return TurntableDisc{start.f_px, x[0], x[1], x[2], x[3], x[4]};
    };
    const std::array<double, 5> from{start.tilt_rad, start.roll_rad, start.centre_x, start.centre_y, start.radius};
    const std::array<double, 5> nudge{1e-4, 1e-4, 0.01, 0.01, 1e-4 * start.radius};
    std::vector<DiscPlane> nudged;
    for (std::size_t k = 0; k < from.size(); ++k) {
        std::array<double, 5> x = from;
        x[k] += nudge[k];
        nudged.push_back(search.plane(disc_of(x)));
    }
    cv::Matx<double, 5, 5> information = cv::Matx<double, 5, 5>::zeros();
    cv::Vec<double, 5> pull;
    for (int i = 0; i < around.places(); ++i) {
        const RimPlace place = around.rim_place(plane, start.radius, i);
        const std::optional<double> offset_px = search.edge_beside(place, reach_px);
        if (!offset_px) continue;
        const double weight = 1 / std::max(1.0, std::abs(*offset_px) / kHuber_px);
        cv::Vec<double, 5> slope;  // px along the normal per nudge
        for (std::size_t k = 0; k < from.size(); ++k) {
            const double radius = k == 4 ? start.radius + nudge[k] : start.radius;
            slope[static_cast<int>(k)] =
                glm::dot(nudged[k].on_circle(radius, around.angle_rad(i)) - place.px, place.normal);
        }
        information += weight * (slope * slope.t());
        pull += weight * *offset_px * slope;
    }
    for (int k = 0; k < 5; ++k) information(k, k) *= 1 + kDamping;
    cv::Vec<double, 5> nudges;
    if (!cv::solve(information, pull, nudges, cv::DECOMP_CHOLESKY)) return start;
    std::array<double, 5> x = from;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += nudge[k] * nudges[static_cast<int>(k)];
    return disc_of(x);
}

// The best circle of a finer grid around one of the coarse grid.
TurntableDisc best_beside(const RimSearch& search, const TurntableDisc& start, double step_px) {
    const AroundCircle around(96);
    constexpr double kApart_px = 2;
    constexpr double kNeverEnough_codes = 120;
    TurntableDisc best = start;
    double best_score = 0;
    const double start_px = start.radius / search.plane(start).unit_per_px();
    TurntableDisc disc = start;
    for (int tilt = -8; tilt <= 8; ++tilt) {
        disc.tilt_rad = start.tilt_rad + tilt * std::numbers::pi / 360;
        for (int row = -4; row <= 4; ++row) {
            disc.centre_y = start.centre_y + row * step_px;
            // As wide as it was: the nearer the horizon the farther away is what looks as large.
            const double unit = search.plane(disc).unit_per_px();
            for (int column = -3; column <= 3; ++column) {
                disc.centre_x = start.centre_x + column * step_px;
                for (int a = -4; a <= 4; ++a) {
                    disc.radius = (start_px + a * step_px) * unit;
                    const double score = search.rim_of(disc, around, kApart_px, kNeverEnough_codes).score();
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

}  // namespace

std::optional<TurntableDisc> find_turntable_disc(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known,
                                                 ConstImageView<std::uint8_t> object) {
    const AroundCircle coarsely(48), finely(360);
    constexpr double kCoarseApart_px = 4;  // wide, for the steps are
    constexpr double kClear_codes = 24;
    constexpr double kLeastDepth = 0.05;  // of the picture's width is the circle's smaller radius: no mere line
    constexpr double kLeastContrast = 0.7;
    constexpr double kLeastKnown = 0.4;
    constexpr int kLeastOctants = 4;
    constexpr double kLeastEven = 0.86;  // measured: discs from 0.94 on, a white foot before blue without a disc 0.78
    const cv::Rect box = box_of(mat_over(object));
    if (box.area() == 0) return std::nullopt;
    const RimSearch search(plate, known);
    const double f_px = kNominalFocal_widths * plate.width();
    const double step_px = std::max(1.0, plate.width() / 360.0);
    struct Found {
        TurntableDisc disc;
        double score = 0;
    };
    // Rows of the axis' foot; one task each.
    std::vector<double> rows;
    for (double y = box.y + 0.5 * box.height; y < box.y + 1.15 * box.height; y += 4 * step_px) rows.push_back(y);
    std::vector<Found> best(rows.size());
    for_each_index(rows.size(), [&](std::size_t i) {
        for (int column = -1; column <= 1; ++column) {
            for (double tilt_deg = 6; tilt_deg <= 48; tilt_deg += 3) {
                TurntableDisc disc{f_px,    tilt_deg * std::numbers::pi / 180,
                                   0,       box.x + 0.5 * box.width + 4 * column * step_px,
                                   rows[i], 0};
                const DiscPlane plane(disc, plate.width(), plate.height());
                if (!plane.below_horizon({disc.centre_x, disc.centre_y})) continue;
                const double unit = plane.unit_per_px();
                for (double a = 0.3 * box.width; a <= 1.3 * box.width; a += 2 * step_px) {
                    if (a * std::sin(disc.tilt_rad) < kLeastDepth * plate.width()) continue;
                    disc.radius = a * unit;
                    const double score = search.rim_of(disc, coarsely, kCoarseApart_px, kClear_codes).score();
                    if (score > best[i].score) best[i] = {disc, score};
                }
            }
        }
    });
    const Found start =
        *std::max_element(best.begin(), best.end(), [](const Found& a, const Found& b) { return a.score < b.score; });
    if (start.score <= 0) return std::nullopt;

    TurntableDisc disc = best_beside(search, start.disc, step_px);
    for (const double reach_px : {6.0, 6.0, 4.0, 4.0, 3.0, 3.0, 3.0}) disc = drawn_to_edges(search, disc, reach_px);
    const Rim rim = search.rim_of(disc, finely, 2, kClear_codes);
    if (rim.contrast < kLeastContrast || rim.known < kLeastKnown || rim.clear_octants < kLeastOctants ||
        search.evenness(disc, finely, 2) < kLeastEven) {
        return std::nullopt;
    }
    return disc;
}

}  // namespace rs::capture
