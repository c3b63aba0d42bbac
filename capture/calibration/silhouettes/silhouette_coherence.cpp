#include "capture/calibration/silhouettes/silhouette_coherence.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kDepths = 96;       // tried along a ray
constexpr int kRefinements = 12;  // golden sections around the best of them
constexpr int kNearDepths = 2;    // tried on either side of a depth that is roughly known
constexpr double kNoRay_px = 100;

// What one view sees of the points centre + depth * direction of one other view's rays.
struct Sight {
    std::size_t view = 0;
    glm::dvec3 centre{0};            // of the ray's view, in this view's camera axes
    glm::dmat3 camera_from_table{};  // rotation from the ray's table frame to this view's camera axes
};

struct FloatLens {
    float f, cx, cy, k1, k2;
};

// Views near a right angle to the ray's contradict it soonest and so come first.
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

class RayProbe {
public:
    RayProbe(const SilhouetteTurn& turn, const FloatLens& lens, const std::vector<Sight>& sights)
        : turn_(turn), lens_(lens), sights_(sights), directions_(sights.size()) {}

    // The largest over depths within `reach` of the axis of the least over views of the distance; any value above 0
    // where there is one, for then the ray falls short of nothing. `known_depth`: where; above 0 if it is
    // roughly known.
    double best(const glm::dvec3& direction, double reach, double& known_depth) {
        for (std::size_t j = 0; j < sights_.size(); ++j) directions_[j] = sights_[j].camera_from_table * direction;
        // From (0, 0, 1): nearest to the axis at `middle`.
        const double flat2 = direction.x * direction.x + direction.z * direction.z;
        const double middle = -direction.z / flat2;
        const double miss2 = direction.x * direction.x / flat2;
        const double half = std::sqrt(std::max(1e-6, reach * reach - miss2) / flat2);
        const double step = 2 * half / kDepths;
        float most = std::numeric_limits<float>::lowest();
        const bool is_known = known_depth > 0;
        // Outwards from the middle, or from where it was, so that a good value comes early and prunes the rest.
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
        const auto [found, found_at] = refined(at - step, at + step);
        known_depth = found > most ? found_at : at;
        return std::max<double>(most, found);
    }

private:
    // May stop at the first value that is not above `floor`.
    [[nodiscard]] float least_over_views(double depth, float floor) const {
        float least = std::numeric_limits<float>::max();
        for (std::size_t j = 0; j < sights_.size(); ++j) {
            const glm::vec3 p(sights_[j].centre + depth * directions_[j]);
            if (!(p.z < -1e-6F)) return std::numeric_limits<float>::lowest();
            const float x = p.x / -p.z;
            const float y = -p.y / -p.z;
            const float r2 = x * x + y * y;
            const float scale = lens_.f * (1 + r2 * (lens_.k1 + r2 * lens_.k2));
            least = std::min(least, turn_.distance(sights_[j].view, lens_.cx + scale * x, lens_.cy + scale * y));
            if (least <= floor) return least;
        }
        return least;
    }

    // The largest value, and where.
    [[nodiscard]] std::pair<float, double> refined(double low, double high) const {
        constexpr double kGolden = 0.6180339887498949;
        constexpr float kNoFloor = std::numeric_limits<float>::lowest();
        double a = high - kGolden * (high - low);
        double b = low + kGolden * (high - low);
        float at_a = least_over_views(a, kNoFloor);
        float at_b = least_over_views(b, kNoFloor);
        for (int i = 0; i < kRefinements; ++i) {
            if (at_a > at_b) {
                high = b;
                b = a;
                at_b = at_a;
                a = high - kGolden * (high - low);
                at_a = least_over_views(a, kNoFloor);
            } else {
                low = a;
                a = b;
                at_a = at_b;
                b = low + kGolden * (high - low);
                at_b = least_over_views(b, kNoFloor);
            }
        }
        return at_a > at_b ? std::pair{at_a, a} : std::pair{at_b, b};
    }

    const SilhouetteTurn& turn_;
    FloatLens lens_;
    const std::vector<Sight>& sights_;
    std::vector<glm::dvec3> directions_;
};

bool counts(const RaySelection& rays, std::size_t view) {
    return rays.left_out.empty() || rays.left_out[view] == 0;
}

}  // namespace

std::vector<std::size_t> views_of_rays(const SilhouetteTurn& turn, const RaySelection& rays) {
    std::vector<std::size_t> views;
    for (std::size_t i = 0; i < turn.views(); ++i) {
        if (!counts(rays, i)) continue;
        for (std::size_t e = 0; e < turn.edges(i).size(); e += rays.every) views.push_back(i);
    }
    return views;
}

std::vector<double> consistency_residuals_px(const SilhouetteTurn& turn, const TurntableModel& model,
                                             const RaySelection& rays, RayDepths* depths) {
    RS_CHECK(model.angles_rad.size() == turn.views() && rays.every > 0);
    // The rays of all views first: the farthest from the axis says how far the object may reach.
    struct View {
        std::size_t first = 0;  // of its rays
        std::vector<std::optional<glm::dvec3>> directions;
    };
    std::vector<View> views(turn.views());
    std::size_t count = 0;
    double reach = 0;
    for (std::size_t i = 0; i < turn.views(); ++i) {
        views[i].first = count;
        if (!counts(rays, i)) continue;
        for (std::size_t e = 0; e < turn.edges(i).size(); e += rays.every, ++count) {
            auto direction = table_ray(model.lens, model.pose, turn.edges(i)[e]);
            const double flat = direction ? std::hypot(direction->x, direction->z) : 0;
            if (flat < 1e-3) direction.reset();
            if (direction) reach = std::max(reach, std::abs(direction->x) / flat);
            views[i].directions.push_back(direction);
        }
    }
    reach = std::min(1.02 * reach, 0.99);

    const FloatLens lens{static_cast<float>(model.lens.f_px), static_cast<float>(model.lens.cx),
                         static_cast<float>(model.lens.cy), static_cast<float>(model.lens.k1),
                         static_cast<float>(model.lens.k2)};
    std::vector<double> residuals(count);
    RayDepths near = depths != nullptr ? *depths : RayDepths{};
    RS_CHECK(near.empty() || near.size() == count);
    near.resize(count);
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
        if (views[i].directions.empty()) return;
        const std::vector<Sight> sights = sights_of(model, i, rays.left_out);
        RayProbe probe(turn, lens, sights);
        for (std::size_t e = 0; e < views[i].directions.size(); ++e) {
            const auto& direction = views[i].directions[e];
            const double best_px = direction ? probe.best(*direction, reach, near[views[i].first + e]) : -kNoRay_px;
            residuals[views[i].first + e] = std::clamp(-best_px, 0.0, kNoRay_px);
        }
    });
    if (depths != nullptr && depths->empty()) *depths = std::move(near);
    return residuals;
}

}  // namespace rs::capture
