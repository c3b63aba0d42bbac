#include "capture/photos/turntable_disc.hpp"

#include "capture/photos/disc_plane.hpp"

#include <tbb/parallel_for.h>
#include <opencv2/core.hpp>
#include <opencv2/core/optim.hpp>

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

class RimSearch {
public:
    RimSearch(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known)
        : colour_(plate.height(), plate.width()), known_(plate.height(), plate.width()) {
        for (int y = 0; y < plate.height(); ++y) {
            for (int x = 0; x < plate.width(); ++x) {
                const Rgba8& p = plate(x, y);
                colour_(y, x) = {static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b)};
                known_(y, x) = known(x, y);
            }
        }
    }

    // Of colours so far apart on either side; what differs by `clear_codes` stands out entirely.
    [[nodiscard]] Rim rim_of(const TurntableDisc& disc, int samples, double apart_px, double clear_codes) const {
        const DiscPlane plane(disc, colour_.cols, colour_.rows);
        if (!plane.below_horizon({disc.centre_x, disc.centre_y}) || !plane.visible(disc.radius)) return {};
        double sum = 0;
        int known = 0;
        std::array<double, 8> octant_sum{};
        std::array<int, 8> octant_known{};
        glm::dvec2 before = plane.on_circle(disc.radius, -2 * std::numbers::pi / samples);
        glm::dvec2 here = plane.on_circle(disc.radius, 0);
        for (int i = 0; i < samples; ++i) {
            const glm::dvec2 after = plane.on_circle(disc.radius, 2 * std::numbers::pi * (i + 1) / samples);
            const glm::dvec2 tangent = after - before;
            const double length = glm::length(tangent);
            if (length > 1e-9) {
                const glm::dvec2 normal = glm::dvec2(tangent.y, -tangent.x) * (apart_px / length);
                cv::Vec3f inner;
                cv::Vec3f outer;
                if (sample(here - normal, inner) && sample(here + normal, outer)) {
                    const double contrast = std::min(1.0, cv::norm(inner - outer) / clear_codes);
                    const auto octant = static_cast<std::size_t>(i * 8 / samples);
                    ++known;
                    sum += contrast;
                    ++octant_known[octant];
                    octant_sum[octant] += contrast;
                }
            }
            before = here;
            here = after;
        }
        if (known == 0) return {};
        constexpr double kClearOctant = 0.5;
        int clear_octants = 0;
        for (std::size_t i = 0; i < octant_sum.size(); ++i) {
            const bool enough = octant_known[i] * 24 >= samples;  // a third of the eighth
            clear_octants += enough && octant_sum[i] >= kClearOctant * octant_known[i] ? 1 : 0;
        }
        return {sum / known, static_cast<double>(known) / samples, clear_octants};
    }

    // The width of a pixel at the disc's centre, in units of the plane.
    [[nodiscard]] double unit(const TurntableDisc& disc) const {
        return DiscPlane(disc, colour_.cols, colour_.rows).unit_per_px();
    }

private:
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

// For cv::DownhillSolver: what is to become small.
class RimDescent : public cv::MinProblemSolver::Function {
public:
    RimDescent(const RimSearch& search, double f_px, double apart_px)
        : search_(search), f_px_(f_px), apart_px_(apart_px) {}
    [[nodiscard]] int getDims() const override { return 5; }
    [[nodiscard]] double calc(const double* x) const override {
        constexpr int kSamples = 240;
        constexpr double kNeverEnough_codes = 120;  // a plateau has no slope
        return -search_.rim_of(disc_of(x), kSamples, apart_px_, kNeverEnough_codes).score();
    }
    [[nodiscard]] TurntableDisc disc_of(const double* x) const { return {f_px_, x[0], x[1], x[2], x[3], x[4]}; }

private:
    const RimSearch& search_;
    double f_px_, apart_px_;
};

TurntableDisc descended(const RimSearch& search, const TurntableDisc& start, double apart_px) {
    const cv::Ptr<RimDescent> descent = cv::makePtr<RimDescent>(search, start.f_px, apart_px);
    const cv::Mat1d first_step =
        (cv::Mat1d(1, 5) << 0.01 * apart_px, 0.01, 2 * apart_px, 2 * apart_px, 0.02 * start.radius);
    const cv::Ptr<cv::DownhillSolver> solver = cv::DownhillSolver::create(
        descent, first_step, cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 600, 1e-6));
    cv::Mat1d x = (cv::Mat1d(1, 5) << start.tilt_rad, start.roll_rad, start.centre_x, start.centre_y, start.radius);
    solver->minimize(x);
    return descent->disc_of(x.ptr<double>());
}

// The best circle of a finer grid around one of the coarse grid.
TurntableDisc best_beside(const RimSearch& search, const TurntableDisc& start, double step_px) {
    constexpr int kSamples = 96;
    constexpr double kApart_px = 2;
    constexpr double kNeverEnough_codes = 120;
    TurntableDisc best = start;
    double best_score = 0;
    TurntableDisc disc = start;
    for (int tilt = -8; tilt <= 8; ++tilt) {
        disc.tilt_rad = start.tilt_rad + tilt * std::numbers::pi / 360;
        for (int row = -4; row <= 4; ++row) {
            disc.centre_y = start.centre_y + row * step_px;
            // As wide as it was: the nearer the horizon the farther away is what looks as large.
            const double wide = start.radius / search.unit(start) * search.unit(disc);
            for (int column = -3; column <= 3; ++column) {
                disc.centre_x = start.centre_x + column * step_px;
                for (int a = -4; a <= 4; ++a) {
                    disc.radius = wide + a * step_px * search.unit(disc);
                    const double score = search.rim_of(disc, kSamples, kApart_px, kNeverEnough_codes).score();
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

cv::Rect box_of(ConstImageView<std::uint8_t> object) {
    int left = object.width(), top = object.height(), right = 0, bottom = 0;
    for (int y = 0; y < object.height(); ++y) {
        for (int x = 0; x < object.width(); ++x) {
            if (object(x, y) == 0) continue;
            left = std::min(left, x);
            right = std::max(right, x + 1);
            top = std::min(top, y);
            bottom = std::max(bottom, y + 1);
        }
    }
    return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

}  // namespace

std::optional<TurntableDisc> find_turntable_disc(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> known,
                                                 ConstImageView<std::uint8_t> object) {
    constexpr int kCoarseSamples = 48;
    constexpr double kCoarseApart_px = 4;  // wide, for the steps are
    constexpr double kClear_codes = 24;
    constexpr double kLeastDepth = 0.05;  // of the picture's width is the circle's smaller radius: no mere line
    constexpr double kLeastContrast = 0.7;
    constexpr double kLeastKnown = 0.4;
    constexpr int kLeastOctants = 4;
    const cv::Rect box = box_of(object);
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
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
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
                    const double score = search.rim_of(disc, kCoarseSamples, kCoarseApart_px, kClear_codes).score();
                    if (score > best[i].score) best[i] = {disc, score};
                }
            }
        }
    });
    const Found start =
        *std::max_element(best.begin(), best.end(), [](const Found& a, const Found& b) { return a.score < b.score; });
    if (start.score <= 0) return std::nullopt;

    TurntableDisc disc = start.disc;
    disc = descended(search, best_beside(search, disc, step_px), 1.5);
    const Rim rim = search.rim_of(disc, 360, 2, kClear_codes);
    if (rim.contrast < kLeastContrast || rim.known < kLeastKnown || rim.clear_octants < kLeastOctants)
        return std::nullopt;
    return disc;
}

}  // namespace rs::capture
