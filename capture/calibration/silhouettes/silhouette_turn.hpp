#pragma once
// The silhouettes of a turn prepared for comparison: the signed distance field of every view and points along its
// silhouette, at a common reduced scale.

#include "capture/calibration/silhouettes/distance_field.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rs::capture {

struct SilhouetteDetail {
    int box_px = 300;                 // approximate side of the box of the whole turn
    std::size_t edges_per_view = 48;  // at most
};

class SilhouetteTurn {
public:
    /// Coverage 0..255, all views of one size. They are reduced by the integer factor that `detail` requires, and
    /// cropped to the turn's box. Errors: fewer than 6 views, different sizes, a view that is empty or full.
    static Result<SilhouetteTurn> create(std::span<const Image<std::uint8_t>> masks,
                                         const SilhouetteDetail& detail = {});

    [[nodiscard]] std::size_t views() const { return distances_.size(); }
    [[nodiscard]] int reduction() const { return reduction_; }                  // mask px per px of the positions below
    [[nodiscard]] double width_px() const { return box_high_.x - box_low_.x; }  // of the turn's box
    [[nodiscard]] bool touches_border() const { return open_[0] || open_[1] || open_[2] || open_[3]; }

    /// Points of the silhouette of a view with subpixel accuracy, evenly spaced around it, none on the image border.
    [[nodiscard]] std::span<const glm::dvec2> edges(std::size_t view) const { return edges_[view]; }

    /// Signed distance in px from the silhouette of `view`, positive inside. Beyond a border that the object touches
    /// the image is extended by its edge values: regions outside the image contradict nothing.
    [[nodiscard]] float distance(std::size_t view, float x, float y) const {
        float outside = 0;
        x -= origin_.x + 0.5F;
        y -= origin_.y + 0.5F;
        const DistanceField& field = distances_[view];
        x = clamp_position(x, static_cast<float>(field.width() - 1), open_[0], open_[1], outside);
        y = clamp_position(y, static_cast<float>(field.height() - 1), open_[2], open_[3], outside);
        return field.at(x, y) - outside;
    }

private:
    // Clamps to 0 .. `last`; the distance beyond is added to `outside` if that side is closed. NaN becomes 0.
    static float clamp_position(float position, float last, bool open_before, bool open_behind, float& outside) {
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
    bool open_[4] = {};  // left, right, top, bottom: the object touches the image border there
    std::vector<DistanceField> distances_;
    std::vector<std::vector<glm::dvec2>> edges_;
};

}  // namespace rs::capture
