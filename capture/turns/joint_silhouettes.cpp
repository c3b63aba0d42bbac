#include "capture/turns/joint_silhouettes.hpp"

#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"
#include "capture/opencv/opencv_image.hpp"
#include "capture/turns/hull_search.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rs::capture {
namespace {

constexpr SilhouetteDetail kDetail{300, 24};
constexpr int kHullMask2_px = 128;
constexpr int kDepthSamples = 48;
constexpr int kNearSamples = 2;  // on either side of a known depth
constexpr int kGoldenSteps = 6;
constexpr float kMostResidual_px = 20;
constexpr float kNotSeen = -1000;
constexpr int kMostIterations = 8;
constexpr double kEnoughGain = 0.1;

// Prior deviations of the numbers.
constexpr double kCommonLogFocal = 0.25;
constexpr double kOwnLogFocal = 0.02;
constexpr double kTilt_rad = radians(6);
constexpr double kRoll_rad = radians(0.7);
constexpr double kPan_rad = radians(0.7);
constexpr double kAzimuth_rad = radians(6);
constexpr double kLogSlant = 0.05;
constexpr double kLensShift = 0.03;

bool has_free_camera(const SilhouettesToFit& turn) {
    return turn.freedom == SilhouetteFreedom::kCamera || turn.freedom == SilhouetteFreedom::kAll;
}

bool has_free_placement(const SilhouettesToFit& turn) {
    return turn.freedom == SilhouetteFreedom::kPlacement || turn.freedom == SilhouetteFreedom::kAll;
}

// Coverage with holes filled: a hole may be a reflection of the background.
Image<std::uint8_t> filled_coverage(const Image<std::uint8_t>& alpha) {
    Image<std::uint8_t> filled = alpha;
    cv::Mat1b result(filled.height(), filled.width(), filled.pixels().data());
    cv::Mat1b solid;
    cv::threshold(mat_view(alpha), solid, 127, 255, cv::THRESH_BINARY);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(solid, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(solid, contours, -1, cv::Scalar(255), cv::FILLED);
    cv::erode(solid, solid, cv::Mat(), cv::Point(-1, -1), 2);
    result.setTo(255, solid);
    return filled;
}

// View of a turn in the common frame: a point p is at matrix * p + offset in the camera's axes.
struct JointView {
    const SilhouetteTurn* silhouettes = nullptr;
    std::size_t turn = 0, view = 0;
    glm::mat3 matrix{1.0F};
    glm::vec3 offset{0};
    float f = 0, cx = 0, cy = 0, k1 = 0, k2 = 0;  // px of the silhouettes

    // Signed distance of a point of the common frame from the silhouette, positive inside.
    [[nodiscard]] float distance(const glm::vec3& p) const {
        const glm::vec3 at = matrix * p + offset;
        if (!(at.z < -1e-6F)) return kNotSeen;
        const float x = at.x / -at.z, y = -at.y / -at.z;
        const float r2 = x * x + y * y;
        const float scale = f * (1 + r2 * (k1 + r2 * k2));
        return silhouettes->distance(view, cx + scale * x, cy + scale * y);
    }
};

struct JointRay {
    glm::vec3 origin{0}, direction{0};
    bool exists = false;
};

// Rays through the silhouettes' points of all turns, and the views that they are compared with.
class JointRays {
public:
    JointRays(std::span<const PlacedTurn> turns, std::span<const SilhouetteTurn> silhouettes,
              std::span<const double> reductions) {
        for (std::size_t t = 0; t < turns.size(); ++t) {
            TurntableModel model = turns[t].model;
            for (double* const px : {&model.lens.f_px, &model.lens.cx, &model.lens.cy}) *px /= reductions[t];
            const TurnPlacement& placement = turns[t].placement;
            const glm::dmat3 common_from_turn = glm::transpose(placement.rotation);
            for (std::size_t i = 0; i < silhouettes[t].views(); ++i) {
                add_view(model, placement, silhouettes[t], {t, i});
                const TableRays rays(model.lens, model.pose, -model.angles_rad[i]);
                const glm::dvec3 origin = placement.common_from_turn(turned(glm::dvec3(0, 0, 1), -model.angles_rad[i]));
                for (const glm::dvec2& p : silhouettes[t].edges(i)) {
                    JointRay ray{glm::vec3(origin), {}, false};
                    if (const auto direction = rays.through(p)) {
                        ray.direction = glm::vec3(common_from_turn * *direction);
                        ray.exists = true;
                    }
                    rays_.push_back(ray);
                    view_of_.push_back(views_.size() - 1);
                }
            }
        }
    }

    [[nodiscard]] std::size_t count() const { return rays_.size(); }
    [[nodiscard]] std::size_t turn_of(std::size_t ray) const { return views_[view_of_[ray]].turn; }

    // Residuals, px of the ray's silhouettes: 0 if some point of the ray within the sphere is inside all silhouettes.
    // Searches near `depths` if these are known, and updates them.
    [[nodiscard]] std::vector<double> residuals(const glm::vec4& sphere, std::vector<float>& depths) const {
        const bool is_known = !depths.empty();
        depths.resize(rays_.size(), 0);
        std::vector<double> found(rays_.size());
        for_each_range(rays_.size(), std::size_t{64}, [&](std::size_t begin, std::size_t end) {
            std::vector<std::size_t> order(views_.size());
            std::iota(order.begin(), order.end(), std::size_t{0});
            for (std::size_t i = begin; i < end; ++i) {
                const float best = rays_[i].exists ? best_px(i, sphere, is_known, depths[i], order) : 0;
                found[i] = std::clamp(-best, 0.0F, kMostResidual_px);
            }
        });
        return found;
    }

private:
    void add_view(const TurntableModel& model, const TurnPlacement& placement, const SilhouetteTurn& silhouettes,
                  const std::pair<std::size_t, std::size_t>& turn_and_view) {
        const glm::dmat3 camera = camera_rotation(model.pose);
        const double angle = model.angles_rad[turn_and_view.second];
        glm::dmat3 matrix;
        for (int k = 0; k < 3; ++k) matrix[k] = camera * turned(placement.rotation[k] / placement.distance, angle);
        const glm::dvec3 offset = camera * (turned(placement.offset / placement.distance, angle) - glm::dvec3(0, 0, 1));
        const Lens& lens = model.lens;
        views_.push_back({&silhouettes, turn_and_view.first, turn_and_view.second, glm::mat3(matrix), glm::vec3(offset),
                          static_cast<float>(lens.f_px), static_cast<float>(lens.cx), static_cast<float>(lens.cy),
                          static_cast<float>(lens.k1), static_cast<float>(lens.k2)});
    }

    // Least signed distance over the other views; stops below `floor`. Deciding views move to the front of `order`.
    [[nodiscard]] float least_px(std::size_t ray, float depth, float floor, std::vector<std::size_t>& order) const {
        const glm::vec3 p = rays_[ray].origin + depth * rays_[ray].direction;
        float least = std::numeric_limits<float>::max();
        for (std::size_t k = 0; k < order.size(); ++k) {
            if (order[k] == view_of_[ray]) continue;
            least = std::min(least, views_[order[k]].distance(p));
            if (least < floor) {
                std::swap(order[k], order[k / 2]);
                return least;
            }
        }
        return least;
    }

    // Maximum over depths of the least distance; any value from 0 on ends the search.
    [[nodiscard]] float best_px(std::size_t ray, const glm::vec4& sphere, bool is_known, float& depth,
                                std::vector<std::size_t>& order) const {
        const glm::vec3 to_centre = glm::vec3(sphere) - rays_[ray].origin;
        const float middle = glm::dot(to_centre, rays_[ray].direction);
        const float half = std::sqrt(std::max(sphere.w * sphere.w - (glm::dot(to_centre, to_centre) - middle * middle),
                                              0.01F * sphere.w * sphere.w));
        const float step = 2 * half / kDepthSamples;
        const float from = is_known ? depth : middle;
        const int samples = is_known ? 2 * kNearSamples + 1 : kDepthSamples;
        float best = std::numeric_limits<float>::lowest();
        for (int k = 0; k < samples; ++k) {
            const float at = from + step * static_cast<float>(k % 2 == 0 ? -(k / 2) : k / 2 + 1);
            const float least = least_px(ray, at, best, order);
            if (least > best) {
                best = least;
                depth = at;
            }
            if (best >= 0) return best;
        }
        return refined_px(ray, depth - step, depth + step, best, depth, order);
    }

    // Golden-section search.
    [[nodiscard]] float refined_px(std::size_t ray, float low, float high, float best, float& depth,
                                   std::vector<std::size_t>& order) const {
        constexpr float kGolden = 0.618034F;
        constexpr float kNoFloor = std::numeric_limits<float>::lowest();
        float a = high - kGolden * (high - low), b = low + kGolden * (high - low);
        float at_a = least_px(ray, a, kNoFloor, order), at_b = least_px(ray, b, at_a, order);
        for (int k = 0; k < kGoldenSteps; ++k) {
            if (at_a > at_b) {
                high = b;
                b = a;
                at_b = at_a;
                a = high - kGolden * (high - low);
                at_a = least_px(ray, a, at_b, order);
            } else {
                low = a;
                a = b;
                at_a = at_b;
                b = low + kGolden * (high - low);
                at_b = least_px(ray, b, at_a, order);
            }
        }
        const float found = std::max(at_a, at_b);
        if (found <= best) return best;
        depth = at_a > at_b ? a : b;
        return found;
    }

    std::vector<JointView> views_;
    std::vector<JointRay> rays_;
    std::vector<std::size_t> view_of_;  // [ray]
};

// The free numbers of all turns, each in units of its prior deviation.
class JointNumbers {
public:
    JointNumbers(const std::vector<SilhouettesToFit>& turns, double middle) : turns_(turns), middle_(middle) {
        Eigen::Index count = 0;
        shares_focal_ = std::ranges::any_of(turns, has_free_camera);
        if (shares_focal_) ++count;
        for (const SilhouettesToFit& turn : turns) {
            if (has_free_camera(turn)) count += 4;
            if (has_free_placement(turn)) count += 3;
        }
        count_ = count;
    }

    [[nodiscard]] Eigen::Index count() const { return count_; }

    [[nodiscard]] std::vector<PlacedTurn> at(const Eigen::VectorXd& z) const {
        std::vector<PlacedTurn> placed;
        Eigen::Index next = shares_focal_ ? 1 : 0;
        for (const SilhouettesToFit& of : turns_) {
            PlacedTurn turn = of.turn;
            if (has_free_camera(of)) {
                turn.model.lens.f_px *= std::exp(kCommonLogFocal * z(0) + kOwnLogFocal * z(next));
                turn.model.pose.tilt_rad += kTilt_rad * z(next + 1);
                turn.model.pose.roll_rad += kRoll_rad * z(next + 2);
                turn.model.pose.pan_rad += kPan_rad * z(next + 3);
                next += 4;
            }
            if (has_free_placement(of)) {
                CameraAim aim = aim_of(of.turn, middle_);
                aim.tilt_rad = turn.model.pose.tilt_rad;
                aim.slant *= std::exp(kLogSlant * z(next + 1));
                aim.shift += kLensShift * z(next + 2);
                turn.placement = aimed_placement(azimuth_rad(of.turn.placement) + kAzimuth_rad * z(next), aim, middle_);
                next += 3;
            }
            placed.push_back(std::move(turn));
        }
        return placed;
    }

private:
    const std::vector<SilhouettesToFit>& turns_;
    double middle_;  // height of the object's middle
    bool shares_focal_ = false;
    Eigen::Index count_ = 0;
};

// Sphere around the visual hull.
Result<glm::vec4> object_sphere(const std::vector<SilhouettesToFit>& turns) {
    std::vector<HullView> views;
    for (const SilhouettesToFit& turn : turns) {
        for (HullView& view : hull_views(turn.turn, turn_masks(*turn.images, kHullMask2_px))) {
            views.push_back(std::move(view));
        }
    }
    RS_ASSIGN_OR_RETURN(const std::vector<glm::dvec3> surface, hull_surface(views));
    glm::dvec3 low = surface.front(), high = low;
    for (const glm::dvec3& p : surface) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::vec4(glm::vec3(0.5 * (low + high)), static_cast<float>(0.55 * glm::length(high - low)));
}

void write_fit(const std::vector<PlacedTurn>& placed, const JointRays& rays, const std::vector<double>& residuals,
               std::span<const double> reductions, std::vector<SilhouettesToFit>& turns) {
    std::vector<double> squares(turns.size(), 0), counts(turns.size(), 0);
    for (std::size_t i = 0; i < rays.count(); ++i) {
        squares[rays.turn_of(i)] += residuals[i] * residuals[i];
        counts[rays.turn_of(i)] += 1;
    }
    for (std::size_t t = 0; t < turns.size(); ++t) {
        turns[t].turn = placed[t];
        turns[t].rms_px = reductions[t] * std::sqrt(squares[t] / std::max(1.0, counts[t]));
    }
}

}  // namespace

Status fit_jointly(std::vector<SilhouettesToFit>& turns) {
    std::vector<SilhouetteTurn> silhouettes;
    std::vector<double> reductions;
    double views = 0;
    for (const SilhouettesToFit& turn : turns) {
        std::vector<Image<std::uint8_t>> masks;
        for (const CalibrationImage& image : turn.images->images) masks.push_back(filled_coverage(image.alpha));
        RS_ASSIGN_OR_RETURN(SilhouetteTurn of_turn, SilhouetteTurn::create(masks, kDetail));
        reductions.push_back(of_turn.reduction() * turn.images->reduction);
        views += static_cast<double>(of_turn.views());
        silhouettes.push_back(std::move(of_turn));
    }
    RS_ASSIGN_OR_RETURN(const glm::vec4 sphere, object_sphere(turns));
    const JointNumbers numbers(turns, static_cast<double>(sphere.y));
    if (numbers.count() == 0) return {};
    const auto residuals_at = [&](const Eigen::VectorXd& z, std::vector<float>& depths) {
        return JointRays(numbers.at(z), silhouettes, reductions).residuals(sphere, depths);
    };
    const auto residuals = [&](const Eigen::VectorXd& z) {
        std::vector<float> depths;
        return residuals_at(z, depths);
    };
    const auto beside = [&](const Eigen::VectorXd& z) -> SilhouetteResiduals {
        std::vector<float> known;
        static_cast<void>(residuals_at(z, known));
        return [&residuals_at, known = std::move(known)](const Eigen::VectorXd& there) {
            std::vector<float> depths = known;
            return residuals_at(there, depths);
        };
    };
    Eigen::VectorXd z = Eigen::VectorXd::Zero(numbers.count());
    const SilhouetteComparison comparison{residuals, Eigen::VectorXd::Constant(numbers.count(), 0.1), beside};
    for (const double outlier_px : {4.0, 1.5}) {
        const SilhouetteErrors errors{kIndependentPerView * views, outlier_px, 0.12, true};
        if (!SilhouetteAdjustment(comparison, errors).improve(z, kMostIterations, kEnoughGain)) {
            return Error{"the silhouettes of the turns cannot be adjusted together; check the masks"};
        }
    }
    const std::vector<PlacedTurn> placed = numbers.at(z);
    const JointRays rays(placed, silhouettes, reductions);
    std::vector<float> depths;
    write_fit(placed, rays, rays.residuals(sphere, depths), reductions, turns);
    return {};
}

}  // namespace rs::capture
