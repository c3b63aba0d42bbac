#pragma once
// Backward path tracing: next-event estimation with multiple importance sampling at each surface, Russian roulette from
// the second rough surface on, absorption inside glass.
//
//     camera ray -> hit -> [ sample a light: visible? add ] -> sample a direction -> next hit or light -> ...
//
// Light through glass or from mirrors is found when a sampled direction hits the environment, an area light or an
// emissive mesh: with weight 1 after a specular surface, otherwise with its MIS weight. Lights without an area are
// invisible through glass and in mirrors, because sampled directions cannot hit them.

#include "capture/tracer/integrator/transport.hpp"

namespace rs::capture {

class PathTracer final : public Integrator {
public:
    /// \param guides record denoising guides
    PathTracer(const LightTransport& transport, int max_bounces, bool guides = false)
        : transport_(transport), max_bounces_(max_bounces), guides_(guides) {}

    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> samples) const override;
    [[nodiscard]] bool has_guides() const override { return guides_; }

private:
    [[nodiscard]] RadianceSample follow(CameraRay& ray) const;

    LightTransport transport_;
    int max_bounces_;
    bool guides_;
};

}  // namespace rs::capture
