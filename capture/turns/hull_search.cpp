#include "capture/turns/hull_search.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace rs::capture {
namespace {

constexpr double kAzimuthStep_rad = radians(6);
constexpr double kTiltStep_rad = radians(7.5);
constexpr double kLeastTilt_rad = radians(-7.5);
constexpr double kMostTilt_rad = radians(82.5);
constexpr std::size_t kSurfacePoints = 2500;
constexpr std::size_t kCoarseViews = 6;
constexpr int kSizeRounds = 3;
constexpr std::size_t kCandidates = 6;  // that are refined
constexpr double kOtherAzimuth_rad = radians(20);

// Camera position of a turn that is fitted: azimuth, tilt, distance along the viewing direction, and shift along the
// image's up direction. Well conditioned at all tilts.
struct Aim {
    double azimuth_rad = 0, tilt_rad = 0, slant = 1, shift = 0;
    double overlap = 0;
    double score = -1;  // overlap less a penalty
};

// Projected hull of a view, closed by a dilation of one px.
cv::Mat1b splat(std::span<const glm::dvec3> surface, const Camera& camera) {
    cv::Mat1b seen(camera.height, camera.width, uchar{0});
    for (const glm::dvec3& p : surface) {
        const glm::dvec3 at = camera.project(p);
        if (!(at.z > 0 && at.x >= 0 && at.y >= 0 && at.x < seen.cols && at.y < seen.rows)) continue;
        seen(static_cast<int>(at.y), static_cast<int>(at.x)) = 255;
    }
    cv::morphologyEx(seen, seen, cv::MORPH_CLOSE, cv::Mat(), cv::Point(-1, -1), 2);
    return seen;
}

// Sums over views of the areas and rows of masks and projections.
struct OverlapSums {
    double overlap = 0, mask_area = 0, hull_area = 0, mask_row = 0, hull_row = 0;
    int views = 0;
};

class AimScorer {
public:
    explicit AimScorer(const HullSearch& search) : search_(search) {
        const std::size_t every = search.surface.size() / kSurfacePoints + 1;
        for (std::size_t i = 0; i < search.surface.size(); i += every) points_.push_back(search.surface[i]);
        for (const glm::dvec3& p : points_) middle_ += p / static_cast<double>(points_.size());
        for (const cv::Mat1b& mask : search.masks.masks) {
            const cv::Moments moments = cv::moments(mask, true);
            areas_.push_back(moments.m00);
            rows_.push_back(moments.m01 / std::max(moments.m00, 1.0));
        }
        axis_column_px_ =
            axis_column(search.model.lens, search.model.pose, search.model.lens.cy).value_or(search.model.lens.cx);
    }

    // The axis keeps its column where the optical axis is.
    [[nodiscard]] PlacedTurn placed(const Aim& aim) const {
        PlacedTurn turn{search_.model, {}};
        CameraPose& pose = turn.model.pose;
        if (search_.is_tilt_free) {
            pose.tilt_rad = aim.tilt_rad;
            pose.pan_rad =
                std::atan((turn.model.lens.cx - axis_column_px_) / turn.model.lens.f_px * std::cos(aim.tilt_rad));
        }
        turn.placement = aimed_placement(aim.azimuth_rad, {pose.tilt_rad, aim.slant, aim.shift}, middle_.y);
        return turn;
    }

    [[nodiscard]] OverlapSums compare(const Aim& aim, std::size_t every) const {
        OverlapSums sums;
        const std::vector<HullView> views = hull_views(placed(aim), search_.masks);
        for (std::size_t i = 0; i < views.size(); i += every) {
            const cv::Mat1b hull = splat(points_, views[i].camera);
            cv::Mat1b both;
            cv::bitwise_and(hull, views[i].mask, both);
            const cv::Moments moments = cv::moments(hull, true);
            const double common = cv::countNonZero(both);
            sums.overlap += common / std::max(1.0, areas_[i] + moments.m00 - common);
            sums.mask_area += areas_[i];
            sums.hull_area += moments.m00;
            sums.mask_row += rows_[i];
            sums.hull_row += moments.m01 / std::max(moments.m00, 1.0);
            ++sums.views;
        }
        return sums;
    }

    // Fits distance and height for the azimuth and tilt of `aim`.
    [[nodiscard]] Aim sized(Aim aim, std::size_t every) const {
        const double f_px = search_.model.lens.f_px / search_.masks.reduction;
        for (int round = 0; round < kSizeRounds; ++round) {
            const OverlapSums sums = compare(aim, every);
            if (!(sums.hull_area > 0)) return aim;
            aim.shift += (sums.mask_row - sums.hull_row) / sums.views * aim.slant / f_px;
            aim.slant *= std::clamp(std::sqrt(sums.hull_area / sums.mask_area), 0.5, 2.0);
        }
        return scored(aim, every);
    }

    [[nodiscard]] Aim scored(Aim aim, std::size_t every) const {
        const OverlapSums sums = compare(aim, every);
        aim.overlap = sums.overlap / std::max(1, sums.views);
        if (search_.expected_slant > 0) {
            const double off = std::log(aim.slant / search_.expected_slant);
            aim.score = aim.overlap - off * off;
        } else {
            aim.score = aim.overlap;
        }
        return aim;
    }

    // Pattern search with halved steps.
    [[nodiscard]] Aim refined(Aim aim) const {
        aim = scored(aim, 1);
        double angle = 0.5 * kAzimuthStep_rad, length = 0.03 * aim.slant;
        while (angle > radians(0.1)) {
            Aim best = aim;
            const auto attempt = [&](double azimuth, double tilt, double slant, double shift) {
                const Aim moved = scored(
                    {aim.azimuth_rad + azimuth, aim.tilt_rad + tilt, aim.slant + slant, aim.shift + shift, 0, 0}, 1);
                if (moved.score > best.score) best = moved;
            };
            for (const double sign : {-1.0, 1.0}) {
                attempt(sign * angle, 0, 0, 0);
                attempt(0, 0, sign * length, 0);
                attempt(0, 0, 0, sign * length);
                if (search_.is_tilt_free) attempt(0, sign * angle, 0, 0);
            }
            if (best.score > aim.score) {
                aim = best;
            } else {
                angle *= 0.5;
                length *= 0.5;
            }
        }
        return aim;
    }

    [[nodiscard]] double first_slant() const {
        double radius = 0;
        for (const glm::dvec3& p : points_) radius = std::max(radius, glm::length(p - middle_));
        double area = 0;
        for (const double of_view : areas_) area += of_view / static_cast<double>(areas_.size());
        return radius * search_.model.lens.f_px / search_.masks.reduction / std::sqrt(std::max(area, 1.0));
    }

private:
    const HullSearch& search_;
    std::vector<glm::dvec3> points_;
    glm::dvec3 middle_{0};
    std::vector<double> areas_, rows_;  // [view] of the masks
    double axis_column_px_ = 0;
};

double azimuth_apart(const Aim& a, const Aim& b) {
    return std::abs(std::remainder(a.azimuth_rad - b.azimuth_rad, 2 * kPi));
}

// Coarse search: the best tilt of each azimuth, in descending order of overlap.
std::vector<Aim> coarse_aims(const HullSearch& search, const AimScorer& scorer) {
    const std::size_t every = std::max<std::size_t>(1, search.masks.masks.size() / kCoarseViews);
    std::vector<double> tilts{search.model.pose.tilt_rad};
    if (search.is_tilt_free) {
        tilts.clear();
        for (double tilt = kLeastTilt_rad; tilt <= kMostTilt_rad + 1e-9; tilt += kTiltStep_rad) tilts.push_back(tilt);
    }
    std::vector<Aim> best(static_cast<std::size_t>(std::lround(2 * kPi / kAzimuthStep_rad)));
    const double slant = scorer.first_slant();
    for_each_index(best.size(), [&](std::size_t i) {
        for (const double tilt : tilts) {
            const Aim aim = scorer.sized({static_cast<double>(i) * kAzimuthStep_rad, tilt, slant, 0, 0, 0}, every);
            if (aim.score > best[i].score) best[i] = aim;
        }
    });
    std::ranges::stable_sort(best, [](const Aim& a, const Aim& b) { return a.score > b.score; });
    return best;
}

}  // namespace

TurnMasks turn_masks(const TurnImages& turn, int side_px) {
    TurnMasks found;
    const cv::Mat1b first = mat_view(turn.images.front().alpha);
    const double reduction = std::max(1.0, static_cast<double>(std::max(first.cols, first.rows)) / side_px);
    found.reduction = reduction * turn.reduction;
    const cv::Size size(std::max(1, static_cast<int>(std::lround(first.cols / reduction))),
                        std::max(1, static_cast<int>(std::lround(first.rows / reduction))));
    for (const CalibrationImage& image : turn.images) {
        cv::Mat1b reduced;
        cv::resize(mat_view(image.alpha), reduced, size, 0, 0, cv::INTER_AREA);
        cv::Mat1b mask;
        cv::threshold(reduced, mask, 127, 255, cv::THRESH_BINARY);
        std::vector<std::vector<cv::Point>> contours;
        cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
        cv::drawContours(mask, contours, -1, cv::Scalar(255), cv::FILLED);
        found.masks.push_back(mask);
    }
    return found;
}

std::vector<HullView> hull_views(const PlacedTurn& turn, const TurnMasks& masks) {
    std::vector<HullView> views;
    for (std::size_t i = 0; i < masks.masks.size(); ++i) {
        HullView view{common_camera(turn, i), masks.masks[i]};
        for (double* const px : {&view.camera.fl_x, &view.camera.fl_y, &view.camera.cx, &view.camera.cy}) {
            *px /= masks.reduction;
        }
        view.camera.width = view.mask.cols;
        view.camera.height = view.mask.rows;
        views.push_back(std::move(view));
    }
    return views;
}

Result<std::vector<glm::dvec3>> hull_surface(std::span<const HullView> views) {
    RS_ASSIGN_OR_RETURN(const glm::dvec3 target, common_target(views));
    RS_ASSIGN_OR_RETURN(const VisualHull hull, carve_visual_hull(views, target, {0, 1, 0}));
    const auto cell = [&](const glm::dvec3& p) {
        const glm::dvec3 at = (p - hull.voxels.front()) / hull.step;
        return std::tuple(std::lround(at.x), std::lround(at.y), std::lround(at.z));
    };
    std::map<std::tuple<long, long, long>, glm::dvec3> grid;
    for (const glm::dvec3& p : hull.voxels) grid.try_emplace(cell(p), p);
    std::vector<glm::dvec3> surface;
    for (const auto& [at, p] : grid) {
        const auto [x, y, z] = at;
        const bool is_inner = grid.contains({x - 1, y, z}) && grid.contains({x + 1, y, z}) &&
                              grid.contains({x, y - 1, z}) && grid.contains({x, y + 1, z}) &&
                              grid.contains({x, y, z - 1}) && grid.contains({x, y, z + 1});
        if (!is_inner) surface.push_back(p);
    }
    return surface;
}

double silhouette_overlap(std::span<const glm::dvec3> surface, const PlacedTurn& turn, const TurnMasks& masks) {
    double sum = 0;
    for (const HullView& view : hull_views(turn, masks)) {
        const cv::Mat1b hull = splat(surface, view.camera);
        cv::Mat1b both, either;
        cv::bitwise_and(hull, view.mask, both);
        cv::bitwise_or(hull, view.mask, either);
        sum += static_cast<double>(cv::countNonZero(both)) / std::max(1, cv::countNonZero(either));
    }
    return sum / static_cast<double>(masks.masks.size());
}

DoubtfulMasks find_doubtful_masks(std::span<const HullView> views) {
    constexpr double kDoubtfulFactor = 1.25;           // of areas
    constexpr HullCarving kCarving{64, 0.1, 1.0 / 3};  // few of the masks may be wrong
    const Result<glm::dvec3> target = common_target(views);
    if (!target) return {};
    const Result<VisualHull> hull = carve_visual_hull(views, *target, {0, 1, 0}, kCarving);
    if (!hull) return {};
    std::vector<double> ratios;
    for (const HullView& view : views) {
        const double expected = cv::countNonZero(project_hull(view.camera, *hull));
        ratios.push_back(cv::countNonZero(view.mask) / std::max(1.0, expected));
    }
    std::vector<double> sorted = ratios;
    std::ranges::nth_element(sorted, sorted.begin() + std::ssize(sorted) / 2);
    const double usual = sorted[sorted.size() / 2];
    DoubtfulMasks found;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        if (ratios[i] * kDoubtfulFactor < usual) found.small.push_back(i);
        if (ratios[i] > usual * kDoubtfulFactor) found.large.push_back(i);
    }
    return found;
}

HullMatch search_by_hull(const HullSearch& search) {
    const AimScorer scorer(search);
    const std::vector<Aim> coarse = coarse_aims(search, scorer);
    std::vector<Aim> fine(std::min(kCandidates, coarse.size()));
    for_each_index(fine.size(), [&](std::size_t i) { fine[i] = scorer.refined(coarse[i]); });
    std::ranges::stable_sort(fine, [](const Aim& a, const Aim& b) { return a.score > b.score; });
    const Aim& best = fine.front();
    HullMatch match{scorer.placed(best), best.overlap, best.score, 0};
    const auto consider = [&](const Aim& other) {
        if (azimuth_apart(best, other) <= kOtherAzimuth_rad || other.score <= match.runner_up) return;
        match.runner_up = other.score;
    };
    for (const Aim& other : fine) consider(other);
    for (const Aim& other : coarse) consider(other);
    return match;
}

}  // namespace rs::capture
