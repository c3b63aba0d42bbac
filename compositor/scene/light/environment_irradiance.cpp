#include "compositor/scene/light/environment_irradiance.hpp"

#include <cmath>

namespace rs::compositor {
namespace {

// The sines and cosines of the azimuth become those of the azimuth plus `turn_rad`.
IrradianceHarmonics scale_and_turn(const IrradianceHarmonics& from, float scale, float turn_rad) {
    const float sine = std::sin(turn_rad), cosine = std::cos(turn_rad);
    const float sine2 = std::sin(2 * turn_rad), cosine2 = std::cos(2 * turn_rad);
    const auto& f = from.factors;
    IrradianceHarmonics turned = from;
    turned.factors[2] = f[2] * cosine + f[3] * sine;
    turned.factors[3] = f[3] * cosine - f[2] * sine;
    turned.factors[5] = f[5] * cosine + f[6] * sine;
    turned.factors[6] = f[6] * cosine - f[5] * sine;
    turned.factors[7] = f[7] * cosine2 + f[8] * (2 * sine2);
    turned.factors[8] = f[8] * cosine2 - f[7] * (0.5F * sine2);
    return turned *= scale;
}

}  // namespace

IrradianceHarmonics project_irradiance(const EnvironmentLight& environment) {
    return scale_and_turn(rs::project_irradiance(*environment.pixels), environment.scale, environment.turn_rad);
}

std::optional<IrradianceHarmonics> EnvironmentIrradiance::of(const std::optional<EnvironmentLight>& environment) {
    if (!environment) return std::nullopt;
    if (environment->pixels != pixels_) {
        unscaled_ = rs::project_irradiance(*environment->pixels);
        pixels_ = environment->pixels;
    }
    return scale_and_turn(unscaled_, environment->scale, environment->turn_rad);
}

}  // namespace rs::compositor
