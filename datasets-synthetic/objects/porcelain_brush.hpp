#pragma once
// The strokes and motifs of cobalt painting on porcelain: lines pressed and lifted, washed leaves and petals, tendrils,
// peonies. Used by vase.cpp.

#include "datasets-synthetic/shapes/paint.hpp"
#include "datasets-synthetic/shapes/random.hpp"

#include <span>

namespace rs::synthetic {

// Placement of a motif on the canvas. Motifs are drawn upright in a local frame of unit size.
struct Spot {
    glm::vec2 centre_px{0.0F};
    float size_px = 1.0F;   // canvas pixels per local unit, upright
    float turn_rad = 0.0F;  // counter-clockwise
    float stretch = 1.0F;   // widening along the canvas' x that compensates for the narrowing of the vase

    [[nodiscard]] glm::vec2 operator()(glm::vec2 p) const;
};

glm::vec3 glaze_white();

struct Blade {
    float length = 1.0F;  // local units
    float width = 0.5F;
    float sway = 0.0F;     // x of the tip
    float density = 0.5F;  // of the wash
    int veins = 3;
    float line_px = 3.0F;
};

class PorcelainBrush {
public:
    // Both must outlive the brush.
    PorcelainBrush(Canvas& canvas, Random& random) : canvas_(canvas), random_(random) {}

    // Inks with random variation per stroke.
    Ink outline();
    Ink wash(float density);

    // A smooth stroke through local control points, pressed in the middle and lifted at the ends.
    void stroke(const Spot& at, std::span<const glm::vec2> controls, float width_px);
    // A leaf or petal from (0, 0) to (sway, length).
    void blade(const Spot& at, const Blade& blade);
    // White ground under a petal, which covers earlier petals.
    void blade_ground(const Spot& at, float length, float width);
    // A tendril; `handedness` is +1 or -1.
    void curl(const Spot& at, float handedness, float width_px);
    // A flower of three rings of petals, radius about 1.
    void peony(const Spot& at);
    void dot(glm::vec2 centre_px, float radius_px, glm::vec3 colour);

private:
    Canvas& canvas_;
    Random& random_;
};

}  // namespace rs::synthetic
