#pragma once
// Diffuse irradiance of an environment as a polynomial of the surface normal: the projection onto spherical harmonics
// of order 2, convolved with the cosine (R. Ramamoorthi and P. Hanrahan, An Efficient Representation for Irradiance
// Environment Maps, 2001, equations 7 to 12). For smooth skies it is within 3 % of the exact integral. Occlusion is
// ignored.

#include "compositor/scene/surroundings.hpp"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <optional>

namespace rs::compositor {

struct IrradianceHarmonics {
    /// Factors (w unused) of 1, y, x, z, 3 y^2 - 1, x y, y z, x z, z^2 - x^2 of the unit normal; in the layout of
    /// geometry_shaders.hpp.
    std::array<glm::vec4, 9> factors{};

    /// Irradiance / pi, the radiance of a white diffuse surface; not negative.
    [[nodiscard]] glm::vec3 at(const glm::vec3& normal) const;
};

/// Projects the map with its scale and rotation. A pixel has the same radiance over its solid angle. Some tenths of a
/// second for the largest maps. Thread-safe.
IrradianceHarmonics project_irradiance(const EnvironmentLight& environment);

/// Projection that is kept while the map stays the same; changes of scale and rotation are cheap.
class EnvironmentIrradiance {
public:
    /// nullopt without environment.
    std::optional<IrradianceHarmonics> of(const std::optional<EnvironmentLight>& environment);

private:
    std::shared_ptr<const Image<RgbaF>> pixels_;
    IrradianceHarmonics unscaled_;  // of pixels_, not rotated
};

}  // namespace rs::compositor
