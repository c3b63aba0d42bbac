#pragma once
// Toon shading: Whitted ray tracing that quantises the light intensity, not the colour, at every hit, so that objects
// in mirrors and glass have the same style, with lines along edges (toon_edges.hpp). Source: N. Burnett and T. Piazza,
// "Toon Shading Using Distributed Raytracing".
//
//     surface colour * tone( (sum of E_k (N . L_k) over the unoccluded lights + A) / (M + A) )
//
// E_k is the irradiance of light k on a surface that faces it. M is the largest irradiance that a surface at this
// position can receive without occlusion: |sum of E_k L_k|, or half the sum of E_k for lights on opposite sides. The
// intensity of a single light is therefore N . L at any brightness, and the best-lit sides have the first tone for any
// number of lights. Light colours are ignored. The environment is one more distant light from the direction of its
// largest irradiance, with strength largest - smallest irradiance. A is isotropic: the environment's smallest
// irradiance plus the ambient (indirect) light. Normals are interpolated vertex normals. Emission is unchanged, up
// to 1.
//
// For comparison, ToonStyle::Steps::colour quantises the radiance of Whitted ray tracing per camera ray (section 2).

#include "capture/tracer/integrator/toon_edges.hpp"
#include "capture/tracer/integrator/whitted.hpp"
#include "capture/tracer/scene/toon_style.hpp"

#include <span>

namespace rs::capture {

class ToonTracer final : public WhittedTracer {
public:
    /// \param pixel_rad angle between adjacent pixels' rays at the image centre
    ToonTracer(const LightTransport& transport, IrradianceMap irradiance, const glm::vec3& ambient, int max_depth,
               ToonStyle style, float pixel_rad);

    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const override {
        trace_one_by_one(rays, samples);
    }

protected:
    bool shade(const LightTransport::Vertex& vertex, const Ray& ray, Sampler& sampler,
               glm::vec3& radiance) const override;

private:
    void find_sky_light();
    // Quantises the largest component of a camera ray's radiance; keeps the ratios of the components.
    [[nodiscard]] glm::vec3 quantise_colour(const glm::vec3& radiance) const;
    [[nodiscard]] float intensity(const LightTransport::Vertex& vertex, Sampler& sampler) const;

    ToonStyle style_;
    ToonEdges edges_;
    glm::vec3 sky_direction_{0, 1, 0};  // of the environment's largest irradiance
    float sky_irradiance_ = 0;          // largest minus smallest irradiance of the environment
    float isotropic_irradiance_ = 0;    // A
};

}  // namespace rs::capture
