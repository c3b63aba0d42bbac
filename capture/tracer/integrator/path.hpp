#pragma once
// One path of light, followed from the camera backwards: next-event estimation with multiple importance sampling at
// each surface, Russian roulette from the second rough one on, absorption inside glass.
//
//     camera ray -> hit -> [ draw a light: visible? add ] -> draw a direction -> next hit or light -> ...
//
// Light that passes glass or is reflected by a mirror is found when the drawn directions meet the environment, a
// area light or an emissive mesh: with no competing light sample it counts in full, otherwise by its weight.
// Lights without an area are not seen through glass or in mirrors, for no drawn direction meets them.

#include "capture/tracer/integrator/transport.hpp"

namespace rs::capture {

class PathTracer final : public Integrator {
public:
    // `guides`: it describes what surfaces are, for images that are filtered.
    PathTracer(const LightTransport& transport, int max_bounces, bool guides = false)
        : transport_(transport), max_bounces_(max_bounces), guides_(guides) {}

    bool trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
               glm::vec3& radiance) const override;
    void trace_many(std::span<CameraRay> rays, std::span<RadianceSample> arrived) const override;
    [[nodiscard]] bool gives_guides() const override { return guides_; }

private:
    [[nodiscard]] RadianceSample follow(CameraRay& ray) const;

    LightTransport transport_;
    int max_bounces_;
    bool guides_;
};

}  // namespace rs::capture
