#include "capture/calibration/silhouettes/consistency_residuals.hpp"

#include "capture/calibration/silhouettes/ray_probe.hpp"
#include "rayspace/base/parallel_loop.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace rs::capture {
namespace {

constexpr double kNoRay_px = 100;

bool counts(const RaySelection& rays, std::size_t view) {
    return rays.left_out.empty() || rays.left_out[view] == 0;
}

double residual_px(double best_px) {
    return std::clamp(-best_px, 0.0, kNoRay_px);
}

// Rays of all selected views, in the table frame of a model.
class SelectedRays {
public:
    SelectedRays(const SilhouetteTurn& turn, const TurntableModel& model, const RaySelection& rays)
        : turn_(turn), model_(model), left_out_(rays.left_out), views_(turn.views()) {
        RS_CHECK(model.angles_rad.size() == turn.views() && rays.every > 0);
        const TableRays rays_of(model.lens, model.pose);
        for (std::size_t i = 0; i < turn.views(); ++i) {
            views_[i].first = count_;
            if (!counts(rays, i)) continue;
            for (std::size_t e = 0; e < turn.edges(i).size(); e += rays.every, ++count_) {
                auto direction = rays_of.through(turn.edges(i)[e]);
                const double flat = direction ? std::hypot(direction->x, direction->z) : 0;
                if (flat < 1e-3) direction.reset();
                if (direction) reach_ = std::max(reach_, std::abs(direction->x) / flat);
                views_[i].directions.push_back(direction);
            }
        }
        reach_ = std::min(1.02 * reach_, 0.99);
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    // Upper bound of the object's radius: the distance of the farthest ray from the axis.
    [[nodiscard]] double reach() const { return reach_; }

    // Calls visit(probe of the ray's view, direction or nullopt, ray number) for all rays, on several threads.
    template <typename Visit>
    void visit(const Visit& visit) const {
        for_each_index(views_.size(), [&](std::size_t i) {
            if (views_[i].directions.empty()) return;
            const std::vector<Sight> sights = sights_of(model_, i, left_out_);
            RayProbe probe(turn_, model_.lens, sights);
            for (std::size_t e = 0; e < views_[i].directions.size(); ++e) {
                visit(probe, views_[i].directions[e], views_[i].first + e);
            }
        });
    }

private:
    struct View {
        std::size_t first = 0;  // number of its first ray
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

double rms_px(const std::vector<double>& residuals) {
    double sum = 0;
    for (const double r : residuals) sum += r * r;
    return residuals.empty() ? 0 : std::sqrt(sum / static_cast<double>(residuals.size()));
}

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

std::vector<RayContradictions> find_contradictions(const SilhouetteTurn& turn, const TurntableModel& model,
                                                   const RaySelection& rays, const RayDepths& depths, double margin_px,
                                                   std::size_t most) {
    const SelectedRays selected(turn, model, rays);
    RS_CHECK(depths.size() == selected.count());
    std::vector<RayContradictions> verdicts(selected.count());
    selected.visit([&](RayProbe& probe, const std::optional<glm::dvec3>& direction, std::size_t ray) {
        if (!direction) return;
        RayContradictions& verdict = verdicts[ray];
        verdict.depth = depths[ray];
        probe.best(*direction, selected.reach(), verdict.depth);
        verdict.views = probe.strongest_contradictions(*direction, verdict.depth, margin_px, most);
    });
    return verdicts;
}

std::vector<double> residuals_from_contradictions(const SilhouetteTurn& turn, const TurntableModel& model,
                                                  const RaySelection& rays,
                                                  const std::vector<RayContradictions>& verdicts) {
    const SelectedRays selected(turn, model, rays);
    RS_CHECK(verdicts.size() == selected.count());
    std::vector<double> residuals(selected.count());
    selected.visit([&](RayProbe& probe, const std::optional<glm::dvec3>& direction, std::size_t ray) {
        probe.set_active_views(verdicts[ray].views);
        const double depth = verdicts[ray].depth;
        residuals[ray] =
            residual_px(direction && depth > 0 ? probe.best_near(*direction, selected.reach(), depth) : -kNoRay_px);
    });
    return residuals;
}

}  // namespace rs::capture
