#include "capture/calibration/silhouettes/silhouette_tangency.hpp"

#include "capture/calibration/silhouettes/free_parameters.hpp"
#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace rs::capture {
namespace {

constexpr double kHalf_code = 127.5;  // the contour is at this alpha value
constexpr double kNearestPair_rad = 0.15;
constexpr double kFarthestPair_rad = 2.6;
constexpr std::size_t kFewestResiduals = 60;
constexpr double kOutlierDeviations = 4;
constexpr int kTangencyRounds = 4;
constexpr int kStepsPerRound = 2;
constexpr double kEnoughOfPlanes = 1e-3;  // function tolerance
constexpr double kPlaneWidth = 0.3;  // of differences, in deviations; large, because vertices of hulls change little
constexpr double kFinestPlanes_px = 0.005;
// Views take part in many pairs with nearly the same vertex of their hull, so each counts less than independent points.
constexpr double kWorthOfHull = 0.13;
// Factor of common silhouette errors that no residual shows, largest for bodies of revolution; determined from the true
// errors on photos with ground truth.
constexpr double kPairErrorFactor = 3;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

struct HullPoint {
    glm::dvec2 plane{0.0};  // undistorted direction
    glm::dvec2 p{0.0};      // px
};

// Positions where alpha crosses one half along every row and column, from the image borders inwards, px of the reduced
// image. Nothing if the object touches the border.
std::vector<glm::dvec2> outermost(const Image<std::uint8_t>& alpha) {
    std::vector<glm::dvec2> points;
    bool cut_off = false;
    const auto scan = [&](int count, auto at, auto place) {
        int first = -1, last = -1;
        for (int i = 0; i < count; ++i) {
            if (at(i) <= kHalf_code) continue;
            if (first < 0) first = i;
            last = i;
        }
        if (first < 0) return;
        if (first == 0 || last == count - 1) {
            cut_off = true;
            return;
        }
        points.push_back(place(first + 0.5 - (at(first) - kHalf_code) / (at(first) - at(first - 1))));
        points.push_back(place(last + 0.5 + (at(last) - kHalf_code) / (at(last) - at(last + 1))));
    };
    for (int y = 0; y < alpha.height(); ++y) {
        scan(
            alpha.width(), [&](int x) { return static_cast<double>(alpha(x, y)); },
            [&](double x) { return glm::dvec2(x, y + 0.5); });
    }
    for (int x = 0; x < alpha.width(); ++x) {
        scan(
            alpha.height(), [&](int y) { return static_cast<double>(alpha(x, y)); },
            [&](double y) { return glm::dvec2(x + 0.5, y); });
    }
    if (cut_off) points.clear();
    return points;
}

// Andrew's monotone chain.
SilhouetteHull convex_hull(std::vector<HullPoint> points) {
    std::sort(points.begin(), points.end(), [](const HullPoint& a, const HullPoint& b) {
        return a.plane.x < b.plane.x || (a.plane.x == b.plane.x && a.plane.y < b.plane.y);
    });
    const auto turns_right = [](const HullPoint& o, const HullPoint& a, const HullPoint& b) {
        const glm::dvec2 u = a.plane - o.plane, v = b.plane - o.plane;
        return u.x * v.y - u.y * v.x <= 0;
    };
    std::vector<HullPoint> hull;
    const auto add = [&](const HullPoint& point, std::size_t fewest) {
        while (hull.size() >= fewest && turns_right(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
        hull.push_back(point);
    };
    for (const HullPoint& point : points) add(point, 2);
    const std::size_t lower = hull.size() + 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
    SilhouetteHull corners;
    for (std::size_t i = 0; i + 1 < hull.size(); ++i) corners.push_back(hull[i].p);
    return corners;
}

// The outermost plane of a pencil that touches a hull on one side, and the sine of the angle between the line of sight
// to its point of contact and the pencil's axis.
struct Tangent {
    double slope = 0;  // tangent of the plane's angle to the pencil's middle
    double sine = 1;
};

struct Pencil {
    glm::dvec3 axis{0.0};    // from one camera centre to the other
    glm::dvec3 middle{0.0};  // perpendicular to it, towards the object
    glm::dvec3 across{0.0};  // perpendicular to both
};

std::optional<Tangent> tangent(const std::vector<glm::dvec3>& rays, const Pencil& pencil, double side) {
    Tangent best;
    const glm::dvec3* touching = nullptr;
    for (const glm::dvec3& ray : rays) {
        const double forward = glm::dot(ray, pencil.middle);
        if (forward < 1e-3) return std::nullopt;
        const double slope = glm::dot(ray, pencil.across) / forward;
        if (touching != nullptr && side * slope <= side * best.slope) continue;
        best.slope = slope;
        touching = &ray;
    }
    if (touching == nullptr) return std::nullopt;
    const double along = glm::dot(*touching, pencil.axis);
    best.sine = std::sqrt(std::max(0.0, 1 - along * along));
    return best;
}

// Robust standard deviation: 1.4826 times the median absolute residual.
double deviation_of(std::vector<double> residuals) {
    for (double& residual : residuals) residual = std::abs(residual);
    return 1.4826 * median(std::move(residuals));
}

// Half the horizontal extent of all hulls, px.
double half_width_px(std::span<const SilhouetteHull> hulls) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const SilhouetteHull& hull : hulls) {
        for (const glm::dvec2& p : hull) {
            low = std::min(low, p.x);
            high = std::max(high, p.x);
        }
    }
    return 0.5 * (high - low);
}

// Mean square of the camera numbers' `step` in deviations of their covariance, at least 1. The pan is ignored, because
// the axis' position was already estimated from silhouettes.
double excess_variance(const ParameterIndices& places, const Eigen::MatrixXd& covariance, const Eigen::VectorXd& step) {
    std::vector<int> chosen;
    for (std::size_t k = 0; k < kCameraParameters; ++k) {
        if (k != CameraParameter::kPan && places.camera[k] >= 0) chosen.push_back(places.camera[k]);
    }
    if (chosen.empty()) return 1;
    const Eigen::MatrixXd among = covariance(chosen, chosen);
    const Eigen::VectorXd went = step(chosen);
    return std::max(1.0, went.dot(among.ldlt().solve(went)) / static_cast<double>(chosen.size()));
}

}  // namespace

std::vector<SilhouetteHull> silhouette_hulls(std::span<const CalibrationImage> turn, int reduction,
                                             const TurntableModel& model) {
    std::vector<SilhouetteHull> hulls(turn.size());
    for_each_index(turn.size(), [&](std::size_t view) {
        std::vector<HullPoint> points;
        for (const glm::dvec2& p : outermost(turn[view].alpha)) {
            const glm::dvec2 in_photo = p * static_cast<double>(reduction);
            if (const auto plane = undistorted(model.lens, in_photo)) points.push_back({*plane, in_photo});
        }
        if (points.size() >= 3) hulls[view] = convex_hull(std::move(points));
    });
    return hulls;
}

std::vector<ViewPair> comparable_views(const TurntableModel& model, std::span<const SilhouetteHull> hulls) {
    std::vector<ViewPair> pairs;
    for (std::size_t i = 0; i < hulls.size(); ++i) {
        for (std::size_t j = i + 1; j < hulls.size() && !hulls[i].empty(); ++j) {
            const double apart = std::abs(std::remainder(model.angles_rad[j] - model.angles_rad[i], 2 * kPi));
            if (!hulls[j].empty() && apart >= kNearestPair_rad && apart <= kFarthestPair_rad) pairs.push_back({i, j});
        }
    }
    return pairs;
}

std::vector<double> tangency_residuals(const TurntableModel& model, std::span<const SilhouetteHull> hulls,
                                       std::span<const ViewPair> pairs) {
    const std::size_t views = hulls.size();
    std::vector<std::vector<glm::dvec3>> rays(views);
    std::vector<glm::dvec3> centres;
    const TableRays rays_of(model.lens, model.pose);
    for (std::size_t view = 0; view < views; ++view) {
        const double back = -model.angles_rad[view];
        centres.push_back(turned({0, 0, 1}, back));
        for (const glm::dvec2& p : hulls[view]) {
            if (const auto ray = rays_of.through(p)) rays[view].push_back(turned(*ray, back));
        }
    }
    std::vector<double> residuals(2 * pairs.size());
    constexpr std::size_t kGrain = 16;
    const auto compare = [&](std::size_t n) {
        const auto& [i, j] = pairs[n];
        Pencil pencil;
        pencil.axis = glm::normalize(centres[j] - centres[i]);
        const glm::dvec3 inwards = -(centres[i] + centres[j]);
        pencil.middle = glm::normalize(inwards - pencil.axis * glm::dot(inwards, pencil.axis));
        pencil.across = glm::cross(pencil.axis, pencil.middle);
        for (const std::size_t is_second : {0, 1}) {
            const double side = is_second != 0 ? 1 : -1;
            const auto a = tangent(rays[i], pencil, side), b = tangent(rays[j], pencil, side);
            const double px_per_rad = a && b ? model.lens.f_px * 0.5 * (a->sine + b->sine) : 0;
            residuals[2 * n + is_second] = a && b ? (std::atan(a->slope) - std::atan(b->slope)) * px_per_rad : 0;
        }
    };
    for_each_range(pairs.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) compare(n);
    });
    return residuals;
}

std::optional<TangencyFit> fit_tangency(const TurntableModel& model, const ParameterIndices& places,
                                        const Eigen::MatrixXd& covariance, std::span<const SilhouetteHull> hulls,
                                        double worst_px) {
    if (places.count == 0 || covariance.rows() != places.count || !covariance.allFinite()) return std::nullopt;
    const std::vector<ViewPair> pairs = comparable_views(model, hulls);
    if (2 * pairs.size() < kFewestResiduals) return std::nullopt;
    const FreeParameters numbers(model, places, covariance, half_width_px(hulls), places.count);
    SilhouetteErrors errors{kWorthOfHull * kIndependentPerView * static_cast<double>(hulls.size()), 0, kFinestPlanes_px,
                            true};
    SilhouetteAdjustment adjustment(
        {[&](const Eigen::VectorXd& z) { return tangency_residuals(numbers.at(z), hulls, pairs); },
         Eigen::VectorXd::Constant(numbers.count(), kPlaneWidth)},
        errors);
    Eigen::VectorXd z = Eigen::VectorXd::Zero(numbers.count());
    double prior_scale = 1;
    for (int round = 0; round < kTangencyRounds; ++round) {
        errors.outlier_px = kOutlierDeviations * deviation_of(adjustment.residuals(z));
        adjustment.expect(errors, prior_scale);
        if (!adjustment.improve(z, kStepsPerRound, kEnoughOfPlanes)) return std::nullopt;
        prior_scale = excess_variance(places, covariance, numbers.step(z));
    }
    TangencyFit fit{
        numbers.at(z),
        numbers.updated_covariance(covariance, adjustment.information(z), kPairErrorFactor, prior_scale, kNoLimit), 0};
    // Checked at the end: with a wrong start, consistent silhouettes would appear inconsistent.
    fit.deviation_px = deviation_of(adjustment.residuals(z));
    if (!(fit.deviation_px <= worst_px) || !(fit.model.lens.f_px > 0)) return std::nullopt;
    return fit;
}

}  // namespace rs::capture
