#include "capture/calibration/silhouettes/silhouette_coherence.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
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
        : turn_(turn), lens_(lens), sights_(sights), directions_(sights.size()), asked_(sights.size()) {
        std::iota(asked_.begin(), asked_.end(), std::size_t{0});
    }

    // From now on only these views are asked, in this order.
    void ask_only(const std::vector<std::size_t>& views) {
        asked_.clear();
        for (const std::size_t view : views) {
            const auto same = [&](const Sight& sight) { return sight.view == view; };
            const auto found = std::find_if(sights_.begin(), sights_.end(), same);
            asked_.push_back(static_cast<std::size_t>(found - sights_.begin()));
        }
    }

    // The largest over depths within `reach` of the axis of the least over views of the distance; any value above 0
    // where there is one, for then the ray falls short of nothing. `known_depth`: where; above 0 if it is
    // roughly known.
    double best(const glm::dvec3& direction, double reach, double& known_depth) {
        aim(direction);
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

    // The views whose outlines the ray's point at `depth` is farthest outside of.
    std::vector<std::size_t> strongest(const glm::dvec3& direction, double depth, double margin_px, std::size_t most) {
        aim(direction);
        std::vector<std::pair<float, std::size_t>> views;
        for (const std::size_t j : asked_) views.emplace_back(distance(j, depth), sights_[j].view);
        std::stable_sort(views.begin(), views.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::size_t> strong;
        for (const auto& [distance_px, view] : views) {
            if (strong.size() == most || distance_px > views.front().first + margin_px) break;
            strong.push_back(view);
        }
        return strong;
    }

private:
    void aim(const glm::dvec3& direction) {
        for (const std::size_t j : asked_) directions_[j] = sights_[j].camera_from_table * direction;
    }

    // Of the ray's point at `depth` from the outline in view j, positive inside.
    [[nodiscard]] float distance(std::size_t j, double depth) const {
        const glm::vec3 p(sights_[j].centre + depth * directions_[j]);
        if (!(p.z < -1e-6F)) return std::numeric_limits<float>::lowest();
        const float x = p.x / -p.z;
        const float y = -p.y / -p.z;
        const float r2 = x * x + y * y;
        const float scale = lens_.f * (1 + r2 * (lens_.k1 + r2 * lens_.k2));
        return turn_.distance(sights_[j].view, lens_.cx + scale * x, lens_.cy + scale * y);
    }

    // May stop at the first value that is not above `floor`.
    [[nodiscard]] float least_over_views(double depth, float floor) const {
        float least = std::numeric_limits<float>::max();
        for (const std::size_t j : asked_) {
            least = std::min(least, distance(j, depth));
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
    std::vector<glm::dvec3> directions_;  // [sight], of those that are asked
    std::vector<std::size_t> asked_;
};

bool counts(const RaySelection& rays, std::size_t view) {
    return rays.left_out.empty() || rays.left_out[view] == 0;
}

double residual_px(double best_px) {
    return std::clamp(-best_px, 0.0, kNoRay_px);
}

// The rays of all views that count, in a model's table frame.
class SelectedRays {
public:
    SelectedRays(const SilhouetteTurn& turn, const TurntableModel& model, const RaySelection& rays)
        : turn_(turn), model_(model), left_out_(rays.left_out), views_(turn.views()) {
        RS_CHECK(model.angles_rad.size() == turn.views() && rays.every > 0);
        for (std::size_t i = 0; i < turn.views(); ++i) {
            views_[i].first = count_;
            if (!counts(rays, i)) continue;
            for (std::size_t e = 0; e < turn.edges(i).size(); e += rays.every, ++count_) {
                auto direction = table_ray(model.lens, model.pose, turn.edges(i)[e]);
                const double flat = direction ? std::hypot(direction->x, direction->z) : 0;
                if (flat < 1e-3) direction.reset();
                if (direction) reach_ = std::max(reach_, std::abs(direction->x) / flat);
                views_[i].directions.push_back(direction);
            }
        }
        reach_ = std::min(1.02 * reach_, 0.99);
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    // How far from the axis the object may reach: as far as the ray farthest from it.
    [[nodiscard]] double reach() const { return reach_; }

    // visit(probe, direction or nothing, number) for all rays, on several threads; the probe is the ray's view's.
    template <typename Visit>
    void visit(const Visit& visit) const {
        const FloatLens lens{static_cast<float>(model_.lens.f_px), static_cast<float>(model_.lens.cx),
                             static_cast<float>(model_.lens.cy), static_cast<float>(model_.lens.k1),
                             static_cast<float>(model_.lens.k2)};
        tbb::parallel_for(std::size_t{0}, views_.size(), [&](std::size_t i) {
            if (views_[i].directions.empty()) return;
            const std::vector<Sight> sights = sights_of(model_, i, left_out_);
            RayProbe probe(turn_, lens, sights);
            for (std::size_t e = 0; e < views_[i].directions.size(); ++e) {
                visit(probe, views_[i].directions[e], views_[i].first + e);
            }
        });
    }

private:
    struct View {
        std::size_t first = 0;  // of its rays
        std::vector<std::optional<glm::dvec3>> directions;
    };
    const SilhouetteTurn& turn_;
    const TurntableModel& model_;
    const std::vector<char>& left_out_;
    std::vector<View> views_;
    std::size_t count_ = 0;
    double reach_ = 0;
};

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
    const SelectedRays selected(turn, model, rays);
    std::vector<double> residuals(selected.count());
    RayDepths near = depths != nullptr ? *depths : RayDepths{};
    RS_CHECK(near.empty() || near.size() == residuals.size());
    near.resize(residuals.size());
    selected.visit([&](RayProbe& probe, const std::optional<glm::dvec3>& direction, std::size_t ray) {
        residuals[ray] = residual_px(direction ? probe.best(*direction, selected.reach(), near[ray]) : -kNoRay_px);
    });
    if (depths != nullptr && depths->empty()) *depths = std::move(near);
    return residuals;
}

std::vector<RayVerdict> ray_verdicts(const SilhouetteTurn& turn, const TurntableModel& model, const RaySelection& rays,
                                     const RayDepths& depths, double margin_px, std::size_t most) {
    const SelectedRays selected(turn, model, rays);
    RS_CHECK(depths.size() == selected.count());
    std::vector<RayVerdict> verdicts(selected.count());
    selected.visit([&](RayProbe& probe, const std::optional<glm::dvec3>& direction, std::size_t ray) {
        if (!direction) return;
        RayVerdict& verdict = verdicts[ray];
        verdict.depth = depths[ray];
        probe.best(*direction, selected.reach(), verdict.depth);
        verdict.views = probe.strongest(*direction, verdict.depth, margin_px, most);
    });
    return verdicts;
}

std::vector<double> residuals_by_verdicts(const SilhouetteTurn& turn, const TurntableModel& model,
                                          const RaySelection& rays, const std::vector<RayVerdict>& verdicts) {
    const SelectedRays selected(turn, model, rays);
    RS_CHECK(verdicts.size() == selected.count());
    std::vector<double> residuals(selected.count());
    selected.visit([&](RayProbe& probe, const std::optional<glm::dvec3>& direction, std::size_t ray) {
        probe.ask_only(verdicts[ray].views);
        double depth = verdicts[ray].depth;
        residuals[ray] = residual_px(direction ? probe.best(*direction, selected.reach(), depth) : -kNoRay_px);
    });
    return residuals;
}

}  // namespace rs::capture
