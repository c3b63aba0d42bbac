#pragma once
// Restores large parts that single masks lack, such as a black part before a black background that neighboring photos
// show. Points that photos agree about (silhouette_repair.hpp) give the part's contour and depth; colours come from the
// nearest photos that show it.

#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/image/image.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace rs::encode {

/// Selects the large part of `missing` (silhouette_repair.hpp): dense, containing a square of 11x11 pixels that are
/// missing (at least half of them) or object, with at least half of its border at the object, and with its gaps closed.
/// kNoDepth elsewhere. Narrow strips along an edge come from an inaccurate rig; separate components do not belong to
/// the object.
Image<float> select_lost_part(const WorkView& view, const Image<float>& missing);

/// The area of a part relative to the object's area in the view.
double share_of(const Image<float>& part, const WorkView& view);

class LostPartPainter {
public:
    /// `view` and `part` are `scale` times smaller than `image` on each side.
    LostPartPainter(const WorkView& view, const Image<float>& part, int scale, Image<Rgba8> image);

    /// Another photo, at full size and as a working view with its depths.
    struct Painter {
        const DepthView* seen = nullptr;
        const Image<Rgba8>* image = nullptr;
    };
    /// The number of unpainted pixels that another photo shows; with `hidden`, including those that seem occluded.
    [[nodiscard]] std::size_t shown_by(const Painter& from, bool hidden = false) const;
    /// Paints the unpainted pixels that another photo shows. Where most of them are not occluded, all count as shown,
    /// since a few wrong depths would leave specks.
    void paint_from(const Painter& from);

    /// True if all, or at least half, of the part is painted.
    [[nodiscard]] bool done() const { return left_.empty(); }
    [[nodiscard]] bool half_done() const { return 2 * left_.size() <= all_; }
    /// The photo; unpainted pixels are unchanged.
    [[nodiscard]] Image<Rgba8> image() && { return std::move(image_); }

private:
    // A pixel to paint, and its surface point.
    struct PaintPixel {
        int x = 0, y = 0;
        double cover = 0;  // alpha, 0..1
        glm::dvec2 place{0, 0};
        double height = 0;
    };

    [[nodiscard]] std::optional<glm::dvec3> seen_by(const Painter& from, const PaintPixel& spot, bool hidden) const;

    Image<Rgba8> image_;
    int scale_;
    std::vector<PaintPixel> left_;
    std::size_t all_ = 0;  // number of pixels to paint at the start
};

}  // namespace rs::encode
