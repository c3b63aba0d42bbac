#pragma once
// Which glass a ray runs in.

#include "capture/tracer/scene/scene.hpp"

#include <array>
#include <cstddef>

namespace rs::capture {

// The glass that a path is inside of, the innermost last. Glass may overlap: what is left is the last entry of its
// kind.
class MediumStack {
public:
    // What is left of light that has come `distance` through what the path runs in now.
    [[nodiscard]] glm::vec3 passed(float distance) const {
        return size_ > 0 ? glm::pow(media_[size_ - 1]->colour, glm::vec3(distance)) : glm::vec3(1.0F);
    }

    // Where `glass` is met from its front or its back side, and passed.
    void cross(const Material& glass, bool front_side) {
        if (front_side) {
            enter(glass);
        } else {
            leave(glass);
        }
    }

private:
    // Where all places are taken, the outermost glass is forgotten.
    void enter(const Material& glass) {
        if (size_ == kMost) drop(0);
        media_[size_++] = &glass;
    }
    // Leaving what was never entered (the camera stood inside, or the surface is open) changes nothing.
    void leave(const Material& glass) {
        for (std::size_t i = size_; i-- > 0;) {
            if (media_[i] == &glass) return drop(i);
        }
    }

    static constexpr std::size_t kMost = 4;

    void drop(std::size_t index) {
        for (--size_; index < size_; ++index) media_[index] = media_[index + 1];
    }

    std::array<const Material*, kMost> media_{};
    std::size_t size_ = 0;
};

}  // namespace rs::capture
