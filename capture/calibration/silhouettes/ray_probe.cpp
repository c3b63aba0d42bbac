#include "capture/calibration/silhouettes/ray_probe.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rs::capture {
namespace {

constexpr int kDepths = 96;            // samples along a ray
constexpr int kRefinements = 12;       // golden-section iterations around the best sample
constexpr int kPruneEvery = 4;         // of these iterations: fewer views are relevant as the interval shrinks
constexpr std::size_t kFewViews = 10;  // with fewer views, pruning costs more than it saves
constexpr int kFewRefinements = 9;     // iterations around an accurately known depth
constexpr int kNearDepths = 2;         // samples on either side of an approximately known depth
// Lipschitz constant of the distance fields: chamfer distances are a little longer than Euclidean ones, and edge pixels
// add up to half a pixel of their own.
constexpr float kSteepest = 1.06F;
constexpr float kEdgeJump_px = 1;

}  // namespace

std::vector<Sight> sights_of(const TurntableModel& model, std::size_t view, const std::vector<char>& left_out) {
    const glm::dmat3 rotation = camera_rotation(model.pose);
    std::vector<Sight> sights;
    for (std::size_t j = 0; j < model.angles_rad.size(); ++j) {
        if (j == view || (!left_out.empty() && left_out[j] != 0)) continue;
        const double turn_rad = model.angles_rad[j] - model.angles_rad[view];
        glm::dmat3 other_from_table;
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 unit(0);
            unit[k] = 1;
            other_from_table[k] = turned(unit, turn_rad);
        }
        const glm::dvec3 camera(0, 0, 1);
        sights.push_back({j, rotation * (other_from_table * camera - camera), rotation * other_from_table});
    }
    std::stable_sort(sights.begin(), sights.end(), [&](const Sight& a, const Sight& b) {
        const auto across = [&](const Sight& s) {
            return std::abs(std::sin(model.angles_rad[s.view] - model.angles_rad[view]));
        };
        return across(a) > across(b) + 1e-9;
    });
    return sights;
}

RayProbe::RayProbe(const SilhouetteTurn& turn, const Lens& lens, const std::vector<Sight>& sights)
    : turn_(turn),
      lens_{static_cast<float>(lens.f_px), static_cast<float>(lens.cx), static_cast<float>(lens.cy),
            static_cast<float>(lens.k1), static_cast<float>(lens.k2)},
      sights_(sights),
      directions_(sights.size()),
      active_(sights.size()),
      compared_(sights.size()),
      bounds_(sights.size()) {
    std::iota(active_.begin(), active_.end(), std::size_t{0});
    sight_of_.assign(turn.views(), sights.size());
    for (std::size_t j = 0; j < sights.size(); ++j) sight_of_[sights[j].view] = j;
}

void RayProbe::set_active_views(const std::vector<std::size_t>& views) {
    active_.clear();
    for (const std::size_t view : views) {
        if (sight_of_[view] < sights_.size()) active_.push_back(sight_of_[view]);
    }
}

void RayProbe::aim(const glm::dvec3& direction) {
    for (const std::size_t j : active_) directions_[j] = sights_[j].camera_from_table * direction;
    compared_ = active_.size();
}

double RayProbe::best(const glm::dvec3& direction, double reach, double& known_depth) {
    aim(direction);
    // The ray starts at (0, 0, 1) and is nearest to the axis at depth `middle`.
    const double flat2 = direction.x * direction.x + direction.z * direction.z;
    const double middle = -direction.z / flat2;
    const double miss2 = direction.x * direction.x / flat2;
    const double half = std::sqrt(std::max(1e-6, reach * reach - miss2) / flat2);
    const double step = 2 * half / kDepths;
    float most = kBehind;
    const bool is_known = known_depth > 0;
    // Outwards from the middle, or from the known depth, so that a good value is found early and prunes the rest.
    const double from = is_known ? known_depth : middle - 0.5 * step;
    const int tried = is_known ? 2 * kNearDepths + 1 : kDepths;
    double at = from;
    for (int k = 0; k < tried; ++k) {
        const double depth = from + step * (k % 2 == 0 ? -(k / 2) : k / 2 + 1);
        const float least = least_over_views(depth, most);
        if (least > most) {
            most = least;
            at = depth;
        }
        if (most >= 0) {
            known_depth = at;
            return most;
        }
    }
    const auto [found, found_at] = refined(at - step, at + step, kRefinements);
    known_depth = found > most ? found_at : at;
    return std::max(most, found);
}

double RayProbe::best_near(const glm::dvec3& direction, double reach, double known_depth) {
    aim(direction);
    const float here = least_over_views(known_depth, kBehind);
    if (here >= 0) return here;
    const double flat2 = direction.x * direction.x + direction.z * direction.z;
    const double half =
        std::sqrt(std::max(1e-6, reach * reach - direction.x * direction.x / flat2) / flat2) / (2 * kDepths);
    const auto [found, at] = refined(known_depth - half, known_depth + half, kFewRefinements);
    if (found < here || std::abs(at - known_depth) < 0.9 * half) return std::max(here, found);
    return best(direction, reach, known_depth);
}

std::vector<std::size_t> RayProbe::strongest_contradictions(const glm::dvec3& direction, double depth, double margin_px,
                                                            std::size_t most) {
    aim(direction);
    std::vector<std::pair<float, std::size_t>> views;
    for (const std::size_t j : active_) views.emplace_back(distance(j, depth), sights_[j].view);
    std::sort(views.begin(), views.end());
    std::vector<std::size_t> strong;
    for (const auto& [distance_px, view] : views) {
        if (strong.size() == most || distance_px > views.front().first + static_cast<float>(margin_px)) break;
        strong.push_back(view);
    }
    return strong;
}

// Minimum over the views; may stop at the first value below `floor`.
float RayProbe::least_over_views(double depth, float floor) {
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < compared_; ++i) {
        least = std::min(least, distance(active_[i], depth));
        if (least < floor || least == kBehind) {
            // A view that contradicts one point is likely to contradict the next ones; it is moved to the front.
            if (i > 0) std::swap(active_[i], active_[i / 2]);
            return least;
        }
    }
    return least;
}

float RayProbe::apart_px(const Seen& a, const Seen& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

// Drops views that can be neither the minimum nor negative anywhere in an interval of depths.
void RayProbe::keep_deciding(double low, double high) {
    const double middle = 0.5 * (low + high);
    float most = 0;  // upper bound of the minimum over views in the interval, at most 0
    for (std::size_t i = 0; i < compared_; ++i) {
        const std::size_t j = active_[i];
        const Seen a = seen(j, low), b = seen(j, middle), c = seen(j, high);
        if (!a.before_camera || !b.before_camera || !c.before_camera) return;
        const float way_px = std::max(apart_px(a, b), apart_px(b, c));
        const float here = turn_.distance(sights_[j].view, b.x, b.y);
        const float change = kSteepest * way_px + kEdgeJump_px;
        bounds_[i] = {here - change, here + change};
        most = std::min(most, bounds_[i].second);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < compared_; ++i) {
        if (bounds_[i].first > most) continue;
        std::swap(active_[i], active_[kept]);
        bounds_[kept++] = bounds_[i];
    }
    compared_ = kept;
}

// Golden-section search for the maximum and its depth; stops at any value above 0.
std::pair<float, double> RayProbe::refined(double low, double high, int rounds) {
    constexpr double kGolden = 0.6180339887498949;
    if (compared_ > kFewViews) keep_deciding(low, high);
    double a = high - kGolden * (high - low);
    double b = low + kGolden * (high - low);
    float at_a = least_over_views(a, kBehind);
    float at_b = least_over_views(b, at_a);
    for (int i = 0; i < rounds && at_a < 0 && at_b < 0; ++i) {
        // The smaller value may be only an upper bound, because its search stopped early; it is dropped.
        if (at_a > at_b) {
            high = b;
            b = a;
            at_b = at_a;
            a = high - kGolden * (high - low);
            if (i % kPruneEvery == kPruneEvery - 1 && compared_ > kFewViews) keep_deciding(low, high);
            at_a = least_over_views(a, at_b);
        } else {
            low = a;
            a = b;
            at_a = at_b;
            b = low + kGolden * (high - low);
            if (i % kPruneEvery == kPruneEvery - 1 && compared_ > kFewViews) keep_deciding(low, high);
            at_b = least_over_views(b, at_a);
        }
    }
    return at_a > at_b ? std::pair{at_a, a} : std::pair{at_b, b};
}

}  // namespace rs::capture
