#pragma once
// Irradiance of an environment as a function of the surface normal: its cosine convolution on a coarse grid of normals.

#include "capture/tracer/light/environment_map.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

class IrradianceMap {
public:
    // Uses the environment's current rotation. Takes a few milliseconds.
    explicit IrradianceMap(const EnvironmentMap& environment);

    // Irradiance for a unit normal, within 1 % of the exact integral of the environment averaged over 3 degree patches.
    // Thread-safe.
    [[nodiscard]] glm::vec3 at(const glm::vec3& normal) const;

    [[nodiscard]] bool is_black() const { return grid_.width() == 0; }

private:
    Image<RgbaF> grid_;  // empty if black
};

}  // namespace rs::capture
