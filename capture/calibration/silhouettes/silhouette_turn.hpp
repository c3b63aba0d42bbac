#pragma once
// The outlines of a turn, made ready to be compared with each other: of every view the signed distance to its outline
// and points along it, at a common small scale.

#include "capture/calibration/silhouettes/distance_field.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

struct SilhouetteDetail {
    int box_px = 300;                 // about: side of the box of the whole turn
    std::size_t edges_per_view = 48;  // at most
};

class SilhouetteTurn {
public:
    // Coverage 0..255, all views of one size. They are reduced by the whole factor that `detail` requires, and cut to
    // the turn's box. Errors: fewer than 6 views, sizes that differ, a view that is empty or full.
    static Result<SilhouetteTurn> of(std::span<const Image<std::uint8_t>> masks, const SilhouetteDetail& detail = {});

    [[nodiscard]] std::size_t views() const { return distances_.size(); }
    [[nodiscard]] int reduction() const { return reduction_; }                  // mask px per px of the positions below
    [[nodiscard]] double width_px() const { return box_high_.x - box_low_.x; }  // of the turn's box
    [[nodiscard]] bool touches_border() const { return open_[0] || open_[1] || open_[2] || open_[3]; }

    // Points of view i's outline to a fraction of a px, evenly around it, none on the border of the image.
    [[nodiscard]] std::span<const glm::dvec2> edges(std::size_t view) const { return edges_[view]; }

    // Signed distance in px from the outline of `view`, positive inside. Beyond a border that the object touches the
    // image is taken to go on as it ends there: what it does not show contradicts nothing.
    [[nodiscard]] float distance(std::size_t view, float x, float y) const {
        float outside = 0;
        x -= origin_.x + 0.5F;
        y -= origin_.y + 0.5F;
        const DistanceField& field = distances_[view];
        x = held(x, static_cast<float>(field.width() - 1), open_[0], open_[1], outside);
        y = held(y, static_cast<float>(field.height() - 1), open_[2], open_[3], outside);
        return field.at(x, y) - outside;
    }

private:
    // Between 0 and `last`; how far it was beyond is added to `outside` where that side is closed. NaN becomes 0.
    static float held(float position, float last, bool open_before, bool open_behind, float& outside) {
        if (position >= 0 && position <= last) return position;
        if (position > last) {
            if (!open_behind) outside += position - last;
            return last;
        }
        if (!open_before) outside -= position;
        return 0;
    }

    int reduction_ = 1;
    glm::vec2 origin_{0};  // of the fields within the reduced image
    glm::dvec2 box_low_{0}, box_high_{0};
    bool open_[4] = {};  // left, right, top, bottom: the object reaches the image's border there
    std::vector<DistanceField> distances_;
    std::vector<std::vector<glm::dvec2>> edges_;
};

}  // namespace rs::capture
