#pragma once
// One ray of one view against the outlines of all other views: the point of it that lies deepest within all of them.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace rs::capture {

// What one view sees of the points centre + depth * direction of one other view's rays.
struct Sight {
    std::size_t view = 0;
    glm::dvec3 centre{0};            // of the ray's view, in this view's camera axes
    glm::dmat3 camera_from_table{};  // rotation from the ray's table frame to this view's camera axes
};

// Of all views but `view` and those left out (empty: none). Views near a right angle to the ray's contradict it soonest
// and so come first.
std::vector<Sight> sights_of(const TurntableModel& model, std::size_t view, const std::vector<char>& left_out);

// For one thread.
class RayProbe {
public:
    // `sights` and `turn` are kept by reference; `lens` is in px of `turn`.
    RayProbe(const SilhouetteTurn& turn, const Lens& lens, const std::vector<Sight>& sights);

    // From now on only these views are heeded.
    void heed_only(const std::vector<std::size_t>& views);

    // The largest over depths within `reach` of the axis of the least over views of the distance, px; any value of 0
    // and above where there is one, for then nothing contradicts the ray. `known_depth`: where; above 0 if it is
    // roughly known, and then only depths near it are tried. What is found does not depend on the rays probed before
    // but for rounding of equal distances.
    double best(const glm::dvec3& direction, double reach, double& known_depth);

    // The same where the depth is known closely, of the heeded views; falls back to best() where it was not.
    double best_beside(const glm::dvec3& direction, double reach, double known_depth);

    // The views whose outlines the ray's point at `depth` is farthest outside of: within margin_px of the farthest, at
    // most `most`, the farthest first.
    std::vector<std::size_t> strongest(const glm::dvec3& direction, double depth, double margin_px, std::size_t most);

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
    // Inline: what follows does not wait for one view's memory before it reads the next one.
    [[nodiscard]] Seen seen(std::size_t j, double depth) const {
        const glm::vec3 p(sights_[j].centre + depth * directions_[j]);
        if (!(p.z < -1e-6F)) return {};
        const float x = p.x / -p.z;
        const float y = -p.y / -p.z;
        const float r2 = x * x + y * y;
        const float scale = lens_.f * (1 + r2 * (lens_.k1 + r2 * lens_.k2));
        return {lens_.cx + scale * x, lens_.cy + scale * y, true};
    }
    // Of the ray's point at `depth` from the outline in a view, positive inside.
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
    std::vector<std::size_t> sight_of_;            // [view]; sights_.size(): none
    std::vector<glm::dvec3> directions_;           // [sight], of those that are heeded
    std::vector<std::size_t> heeded_;              // sights, those that contradicted last first
    std::size_t deciding_ = 0;                     // the first so many of heeded_ are compared
    std::vector<std::pair<float, float>> bounds_;  // [place in heeded_]: what keep_deciding works with
};

}  // namespace rs::capture
