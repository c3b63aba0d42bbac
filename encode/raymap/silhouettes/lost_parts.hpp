#pragma once
// Large parts that a cut-out lacks, given back to its picture. A black back plate before black, or one that has turned
// as white as the backdrop, is cut off in the pictures where it does and whole in those beside them: there it would
// vanish, and come back. What pictures agree about (silhouette_repair.hpp) shows which part it is and how deep; the
// colours are those of the nearest pictures that show it.

#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/image/image.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace rs::encode {

// What of `missing` (silhouette_repair.hpp) is a part: dense, with a square of 11 x 11 pixels that is lost, at least
// half of it, or object, and with half of its border at the object; its gaps, and those between it and the object, are
// closed. kNoDepth elsewhere. Narrow strips along a rim are a rig that is not exact, and what floats is none of the
// object.
Image<float> lost_part(const WorkView& view, const Image<float>& missing);

// How large it is beside what the view has of the object.
double share_of(const Image<float>& part, const WorkView& view);

class LostPartPainter {
public:
    // `view` and `part` are `scale` times as small as `picture` on each side.
    LostPartPainter(const WorkView& view, const Image<float>& part, int scale, Image<Rgba8> picture);

    // Another picture: as large as the one that is painted, and as small as `view` with what it was found to show.
    struct Painter {
        const DepthView* seen = nullptr;
        const Image<Rgba8>* picture = nullptr;
    };
    // How many pixels of what is left it shows; of `hidden`, also where it seems to be hidden there.
    [[nodiscard]] std::size_t shown_by(const Painter& from, bool hidden = false) const;
    // Paints what another picture shows of what is left. Where most of it is not hidden, all counts as shown: a few
    // wrong depths would leave specks to other pictures.
    void paint_from(const Painter& from);

    // Whether all of it is painted; whether half is.
    [[nodiscard]] bool done() const { return left_.empty(); }
    [[nodiscard]] bool half_done() const { return 2 * left_.size() <= all_; }
    // What no picture has shown is as it was.
    [[nodiscard]] Image<Rgba8> picture() && { return std::move(picture_); }

private:
    // A pixel to paint, and the point there: x and z, then y.
    struct Spot {
        int x = 0, y = 0;
        double cover = 0;  // of the pixel
        glm::dvec2 place{0, 0};
        double height = 0;
    };

    [[nodiscard]] std::optional<glm::dvec3> seen_by(const Painter& from, const Spot& spot, bool hidden) const;

    Image<Rgba8> picture_;
    int scale_;
    std::vector<Spot> left_;
    std::size_t all_ = 0;  // at first
};

}  // namespace rs::encode
