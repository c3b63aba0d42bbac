#pragma once
// Nested glass media along a ray.

#include "capture/tracer/scene/scene.hpp"

#include <array>
#include <cstddef>

namespace rs::capture {

// Media that contain the current path segment, the innermost last. Glass may overlap: leaving one removes its last
// entry.
class MediumStack {
public:
    // Transmittance of the innermost medium over `distance`.
    [[nodiscard]] glm::vec3 transmittance(float distance) const {
        return size_ > 0 ? glm::pow(media_[size_ - 1]->colour, glm::vec3(distance)) : glm::vec3(1.0F);
    }

    // Updates the stack after a refraction through the front or the back side of `glass`.
    void cross(const Material& glass, bool front_side) {
        if (front_side) {
            enter(glass);
        } else {
            leave(glass);
        }
    }

private:
    // Drops the outermost medium if the stack is full.
    void enter(const Material& glass) {
        if (size_ == kMaxDepth) drop(0);
        media_[size_++] = &glass;
    }
    // Leaving a medium that was never entered (the camera is inside it, or its surface is open) has no effect.
    void leave(const Material& glass) {
        for (std::size_t i = size_; i-- > 0;) {
            if (media_[i] == &glass) return drop(i);
        }
    }

    static constexpr std::size_t kMaxDepth = 4;

    void drop(std::size_t index) {
        for (--size_; index < size_; ++index) media_[index] = media_[index + 1];
    }

    std::array<const Material*, kMaxDepth> media_{};
    std::size_t size_ = 0;
};

}  // namespace rs::capture
