#pragma once
// Tests one ray of one view against the silhouettes of all other views: finds its point deepest inside all of them.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace rs::capture {

/// Transform from points centre + depth * direction on the rays of one view to the camera of another view.
struct Sight {
    std::size_t view = 0;
    glm::dvec3 centre{0};            // centre of the ray's view, in this view's camera axes
    glm::dmat3 camera_from_table{};  // rotation from the ray's table frame to this view's camera axes
};

/// Sights of all views except `view` and those left out (empty: none). Views near a right angle to the ray contradict
/// it earliest and are first.
std::vector<Sight> sights_of(const TurntableModel& model, std::size_t view, const std::vector<char>& left_out);

/// Not thread-safe; use one per thread.
class RayProbe {
public:
    /// `sights` and `turn` are kept by reference; `lens` is in px of `turn`.
    RayProbe(const SilhouetteTurn& turn, const Lens& lens, const std::vector<Sight>& sights);

    /// Restricts all further calls to these views.
    void set_active_views(const std::vector<std::size_t>& views);

    /// Maximum over depths within `reach` of the axis of the minimum over views of the signed distance, px; any value
    /// >= 0 if there is one, because then no view contradicts the ray. `known_depth` receives the depth; if it is above
    /// 0, only depths near it are searched. The result does not depend on earlier calls, except for rounding of equal
    /// distances.
    double best(const glm::dvec3& direction, double reach, double& known_depth);

    /// The same for an accurately known depth, with the active views; falls back to best() if the maximum is not near
    /// it.
    double best_near(const glm::dvec3& direction, double reach, double known_depth);

    /// The views whose silhouettes are farthest from the ray's point at `depth`, in descending order of distance
    /// outside: within margin_px of the farthest, at most `most`.
    std::vector<std::size_t> strongest_contradictions(const glm::dvec3& direction, double depth, double margin_px,
                                                      std::size_t most);

private:
    static constexpr float kBehind = std::numeric_limits<float>::lowest();

    struct FloatLens {
        float f, cx, cy, k1, k2;
    };
    struct Seen {
        float x = 0, y = 0;
        bool before_camera = false;
    };
    static float apart_px(const Seen& a, const Seen& b);
    void aim(const glm::dvec3& direction);
    // Inline, so that the memory access of one view does not delay the next.
    [[nodiscard]] Seen seen(std::size_t j, double depth) const {
        const glm::vec3 p(sights_[j].centre + depth * directions_[j]);
        if (!(p.z < -1e-6F)) return {};
        const float x = p.x / -p.z;
        const float y = -p.y / -p.z;
        const float r2 = x * x + y * y;
        const float scale = lens_.f * (1 + r2 * (lens_.k1 + r2 * lens_.k2));
        return {lens_.cx + scale * x, lens_.cy + scale * y, true};
    }
    // Signed distance of the ray's point at `depth` from the silhouette in a view, positive inside.
    [[nodiscard]] float distance(std::size_t j, double depth) const {
        const Seen p = seen(j, depth);
        return p.before_camera ? turn_.distance(sights_[j].view, p.x, p.y) : kBehind;
    }
    float least_over_views(double depth, float floor);
    void keep_deciding(double low, double high);
    std::pair<float, double> refined(double low, double high, int rounds);

    const SilhouetteTurn& turn_;
    FloatLens lens_;
    const std::vector<Sight>& sights_;
    std::vector<std::size_t> sight_of_;            // [view]; sights_.size() if none
    std::vector<glm::dvec3> directions_;           // [sight], valid for the active ones
    std::vector<std::size_t> active_;              // sights, those that contradicted recently first
    std::size_t compared_ = 0;                     // number of leading active sights that are compared
    std::vector<std::pair<float, float>> bounds_;  // [index in active_], scratch of keep_deciding()
};

}  // namespace rs::capture
