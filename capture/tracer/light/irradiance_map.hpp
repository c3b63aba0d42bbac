#pragma once
// Irradiance of an environment on a surface of any direction: its cosine-convolution, over a coarse grid of normals.

#include "capture/tracer/light/environment_map.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

class IrradianceMap {
public:
    // Takes some milliseconds. The environment's turn counts as it is then.
    explicit IrradianceMap(const EnvironmentMap& environment);

    // On a surface whose unit normal this is. Within 1 % of the exact integral where the environment's means over
    // 3 degrees are known. Thread-safe.
    [[nodiscard]] glm::vec3 at(const glm::vec3& normal) const;

    [[nodiscard]] bool is_black() const { return grid_.width() == 0; }

private:
    Image<RgbaF> grid_;  // empty: no light
};

}  // namespace rs::capture
