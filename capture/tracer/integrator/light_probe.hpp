#pragma once
// Light probe: an environment map of the radiance that arrives at a position from all directions (scene.hpp,
// Environment). Lights without an area become single pixels with the radiance that yields their irradiance.

#include "capture/tracer/integrator/tracer.hpp"
#include "rayspace/light/irradiance_harmonics.hpp"

namespace rs::capture {

struct LightProbeOptions {
    int width = 512;  // px, even; the height is half of it
    int samples_per_pixel = 64;
    int max_bounces = 16;
};

/// Renders a light probe with the layout of Environment. Advances `progress` by light_probe_steps() steps.
/// \return linear light; alpha is the share of a pixel's rays that hit a surface or a light
Image<RgbaF> light_probe(const Tracer& tracer, const glm::dvec3& position, const LightProbeOptions& options,
                         Progress* progress = nullptr);
std::int64_t light_probe_steps(const LightProbeOptions& options);

/// Irradiance at a position that lights reach without a reflection. Area lights are sampled at 64 points. Without the
/// environment and emissive surfaces. Thread-safe.
IrradianceHarmonics direct_irradiance(const Tracer& tracer, const glm::dvec3& position);

/// Irradiance at a position: direct_irradiance(), and a light probe without lights. Primitives (RayPrimitive) occlude
/// lights and are otherwise invisible. Thread-safe.
IrradianceHarmonics trace_irradiance(const Tracer& tracer, const glm::dvec3& position,
                                     const LightProbeOptions& options);

/// Unit direction of a pixel position in a map of this width; pixel centres have fraction 0.5.
glm::dvec3 probe_direction(double x, double y, int width);

}  // namespace rs::capture
