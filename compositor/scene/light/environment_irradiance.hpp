#pragma once
// Irradiance of a scene's environment as spherical harmonics. Occlusion is ignored.

#include "compositor/scene/surroundings.hpp"
#include "rayspace/light/irradiance_harmonics.hpp"

#include <memory>
#include <optional>

namespace rs::compositor {

/// Projects the map with its scale and rotation. Thread-safe.
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
