#pragma once
// Shift and scale of one image of a turn: shops crop and scale the images of a spin individually, so that the object
// fills each and is centred.

#include <glm/glm.hpp>

namespace rs::capture {

/// A point p (px) in the image of the fixed camera appears at middle + scale * (p - middle) + shift_px, where middle is
/// the centre of the frame, which both images share.
struct ImagePlacement {
    glm::dvec2 shift_px{0.0};
    double scale = 1;

    [[nodiscard]] glm::dvec2 seen(const glm::dvec2& p, const glm::dvec2& middle) const {
        return middle + scale * (p - middle) + shift_px;
    }
    [[nodiscard]] glm::dvec2 undone(const glm::dvec2& p, const glm::dvec2& middle) const {
        return middle + (p - middle - shift_px) / scale;
    }
    /// Composition: the placement `inner` followed by this one.
    [[nodiscard]] ImagePlacement of(const ImagePlacement& inner) const {
        return {shift_px + scale * inner.shift_px, scale * inner.scale};
    }
};

}  // namespace rs::capture
