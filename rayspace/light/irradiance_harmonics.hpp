#pragma once
// Diffuse irradiance as a polynomial of the surface normal: the projection of the incident light onto spherical
// harmonics of order 2, convolved with the cosine (R. Ramamoorthi and P. Hanrahan, An Efficient Representation for
// Irradiance Environment Maps, 2001, equations 7 to 12). For smooth skies it is within 3 % of the exact integral.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <array>
#include <functional>

namespace rs {

struct IrradianceHarmonics {
    /// Factors (w unused) of 1, y, x, z, 3 y^2 - 1, x y, y z, x z, z^2 - x^2 of the unit normal.
    std::array<glm::vec4, 9> factors{};

    /// Irradiance / pi, the radiance of a white diffuse surface; not negative.
    [[nodiscard]] glm::vec3 at(const glm::vec3& normal) const;

    /// Adds light from one direction (unit length, towards the light), by the irradiance of a surface that faces it.
    void add_direction(const glm::vec3& direction, const glm::vec3& irradiance);
    /// Adds light that is the same from all directions, by its radiance.
    void add_ambient(const glm::vec3& radiance) { factors[0] += glm::vec4(radiance, 0); }

    IrradianceHarmonics& operator+=(const IrradianceHarmonics& other);
    IrradianceHarmonics& operator*=(float scale);
};

/// Projects a latitude-longitude map of incident radiance: row 0 is +Y, the central column is -Z, u grows towards +X
/// from there. A pixel has the same radiance over its solid angle; alpha is ignored. Some tenths of a second for the
/// largest maps. Thread-safe.
IrradianceHarmonics project_irradiance(const Image<RgbaF>& map);

/// Least-squares fit of a function of the unit normal, so that at() approximates it; exact for constants.
IrradianceHarmonics fit_harmonics(const std::function<glm::vec3(const glm::vec3& normal)>& function);

}  // namespace rs
