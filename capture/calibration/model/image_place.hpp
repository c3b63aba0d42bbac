#pragma once
// Where an image of a turn was put: shops crop and scale the images of a spin one by one, so that the object fills
// each and is in its middle.

#include <glm/glm.hpp>

namespace rs::capture {

// The point p (px) of the still camera's image is seen at middle + scale * (p - middle) + shift_px, where middle is
// that of the frame, which both images share.
struct ImagePlace {
    glm::dvec2 shift_px{0.0};
    double scale = 1;

    [[nodiscard]] glm::dvec2 seen(const glm::dvec2& p, const glm::dvec2& middle) const {
        return middle + scale * (p - middle) + shift_px;
    }
    [[nodiscard]] glm::dvec2 undone(const glm::dvec2& p, const glm::dvec2& middle) const {
        return middle + (p - middle - shift_px) / scale;
    }
    // Of an image that stands at `inner` and is then put here.
    [[nodiscard]] ImagePlace of(const ImagePlace& inner) const {
        return {shift_px + scale * inner.shift_px, scale * inner.scale};
    }
};

}  // namespace rs::capture
