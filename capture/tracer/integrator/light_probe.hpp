#pragma once
// What light reaches a place, from all sides: a map that lights other scenes as this place was lit (scene.hpp,
// Environment). Lights without an area, which nobody sees, are pixels of the radiance that gives their irradiance.

#include "capture/tracer/integrator/tracer.hpp"

namespace rs::capture {

struct LightProbeOptions {
    int width = 512;  // px, even; half as high
    int samples_per_pixel = 64;
    int max_bounces = 16;
};

// Linear light; alpha is the share of a pixel's rays that met a surface or a light, and what the others see is missing.
// The layout is Environment's. Advances `progress` by step_count() steps.
Image<RgbaF> light_probe(const Tracer& tracer, const glm::dvec3& place, const LightProbeOptions& options,
                         Progress* progress = nullptr);
std::int64_t light_probe_steps(const LightProbeOptions& options);

// Through the middle of a pixel of such a map, or any position in it; unit length.
glm::dvec3 probe_direction(double x, double y, int width);

}  // namespace rs::capture
