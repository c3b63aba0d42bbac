#include "datasets-synthetic/street/sky.hpp"

#include "datasets-synthetic/shapes/curve.hpp"
#include "datasets-synthetic/shapes/noise.hpp"
#include "datasets-synthetic/shapes/portable_math.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec3;

constexpr double kTurbidity = 2.6;
constexpr double kExposure = 0.042;  // per kcd/m^2

double arc_cosine(double c) {
    return portable::atan2(std::sqrt(std::max(1 - c * c, 0.0)), c);
}

// Coefficients A to E of Perez et al. for a turbidity: slope and offset (Preetham et al., appendix A.2).
struct Perez {
    std::array<double, 5> slope;
    std::array<double, 5> offset;

    [[nodiscard]] double at(double cos_zenith, double to_sun_rad) const {
        const auto k = [&](std::size_t i) { return slope.at(i) * kTurbidity + offset.at(i); };
        const double c = portable::cos(to_sun_rad);
        return (1 + k(0) * portable::exp(k(1) / cos_zenith)) *
               (1 + k(2) * portable::exp(k(3) * to_sun_rad) + k(4) * c * c);
    }
};
constexpr Perez kLuminance{{0.1787, -0.3554, -0.0227, 0.1206, -0.0670}, {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}};
constexpr Perez kChromaX{{-0.0193, -0.0665, -0.0004, -0.0641, -0.0033}, {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452}};
constexpr Perez kChromaY{{-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}, {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};

struct Zenith {
    double luminance;  // kcd/m^2
    double x, y;
};

// Equations of appendix A.2; `s`: angle between sun and zenith, rad.
Zenith zenith_of(double s) {
    constexpr double t = kTurbidity;
    const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * s);
    const double luminance = (4.0453 * t - 4.9710) * portable::sin(chi) / portable::cos(chi) - 0.2155 * t + 2.4192;
    const auto cubic = [&](double a, double b, double c, double d) { return ((a * s + b) * s + c) * s + d; };
    return {luminance,
            t * t * cubic(0.00166, -0.00375, 0.00209, 0) + t * cubic(-0.02903, 0.06377, -0.03202, 0.00394) +
                cubic(0.11693, -0.21196, 0.06052, 0.25886),
            t * t * cubic(0.00275, -0.00610, 0.00317, 0) + t * cubic(-0.04214, 0.08970, -0.04153, 0.00516) +
                cubic(0.15346, -0.26756, 0.06670, 0.26688)};
}

vec3 rgb_of_chroma(double x, double y, double luminance) {
    const double big_x = luminance * x / y;
    const double big_z = luminance * (1 - x - y) / y;
    const glm::dvec3 rgb{3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z,
                         -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z,
                         0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z};
    return glm::max(vec3(rgb), vec3(0));
}

vec3 clear_sky(vec3 direction) {
    const vec3 sun = -glm::normalize(kSunAim);
    const double sun_zenith = arc_cosine(static_cast<double>(sun.y));
    const Zenith zenith = zenith_of(sun_zenith);
    const double up = std::max(static_cast<double>(direction.y), 0.03);
    const double to_sun = arc_cosine(std::clamp(static_cast<double>(glm::dot(direction, sun)), -1.0, 1.0));
    const auto relative = [&](const Perez& perez) { return perez.at(up, to_sun) / perez.at(1, sun_zenith); };
    const double luminance = zenith.luminance * relative(kLuminance);
    const vec3 sky = rgb_of_chroma(zenith.x * relative(kChromaX), zenith.y * relative(kChromaY), luminance * kExposure);
    // Haze of a town, which the model leaves mauve.
    return glm::mix(sky, kHaze, 0.9F * smooth_step(0.3F, 0, direction.y));
}

// Fair-weather clouds on a plane above: opacity, and how deep the light has to go.
struct Cloud {
    float opacity = 0;
    float depth = 0;
};

Cloud cloud_at(vec3 direction) {
    const float up = std::max(direction.y, 0.0F);
    const glm::vec2 place = glm::vec2{direction.x, direction.z} / (up + 0.16F);
    const vec3 p{place * 0.9F, 0.4F};
    const vec3 warped = p + 0.35F * vector_noise(p * 1.3F, 61);
    const float billows = 0.5F + layered_noise(warped, 6, 62);
    const float groups = 0.5F + layered_noise(p * 0.37F, 2, 77);
    const float d = billows + 0.55F * groups - 0.86F;
    return {smooth_step(0, 0.2F, d) * smooth_step(0.01F, 0.12F, up), smooth_step(0.05F, 0.5F, d)};
}

}  // namespace

vec3 day_sky(vec3 direction) {
    const vec3 clear = clear_sky(direction);
    if (direction.y < 0) return glm::mix(clear, vec3(0.21F, 0.205F, 0.19F), smooth_step(0, 0.12F, -direction.y));
    const Cloud cloud = cloud_at(direction);
    const vec3 lit = glm::mix(vec3(0.98F, 0.97F, 0.94F), vec3(0.55F, 0.6F, 0.68F), cloud.depth);
    return glm::mix(clear, glm::max(lit, clear), 0.92F * cloud.opacity);
}

vec3 night_sky(vec3 direction) {
    if (direction.y < 0) return {0.0051F, 0.0051F, 0.0049F};
    const float up = std::sqrt(direction.y);
    return glm::mix(vec3(0.03F, 0.035F, 0.05F), vec3(0.009F, 0.013F, 0.05F), up);
}

Image<RgbaF> sky_image(bool night, int height_px) {
    Image<RgbaF> image(2 * height_px, height_px);
    for (int y = 0; y < height_px; ++y) {
        const float elevation =
            portable::kPiF * (0.5F - (static_cast<float>(y) + 0.5F) / static_cast<float>(height_px));
        for (int x = 0; x < 2 * height_px; ++x) {
            const float azimuth = portable::kPiF * ((static_cast<float>(x) + 0.5F) / static_cast<float>(height_px) - 1);
            const float flat = portable::cos(elevation);
            const vec3 direction{flat * portable::sin(azimuth), portable::sin(elevation),
                                 -flat * portable::cos(azimuth)};
            const vec3 radiance = night ? night_sky(direction) : day_sky(direction);
            image(x, y) = {radiance.x, radiance.y, radiance.z, 1};
        }
    }
    return image;
}

}  // namespace rs::synthetic
