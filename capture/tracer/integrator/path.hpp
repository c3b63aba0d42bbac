#pragma once
// One path of light, followed from the camera backwards: next-event estimation with multiple importance sampling at
// each surface, Russian roulette after the third, absorption inside glass.
//
//     camera ray -> hit -> [ draw a light: visible? add ] -> draw a direction -> next hit or light -> ...
//
// Light that passes glass or is reflected by a mirror is found when the drawn directions meet the environment, a
// area light or an emissive mesh: with no competing light sample it counts in full, otherwise by its weight.
// Lights without an area are not seen through glass or in mirrors, for no drawn direction meets them.
//
// Radiance is not scaled by the squared index of refraction inside glass: all lights are outside, where it cancels.

#include "capture/tracer/integrator/ray_scene.hpp"
#include "capture/tracer/integrator/sampler.hpp"
#include "capture/tracer/integrator/surface.hpp"
#include "capture/tracer/light/light_set.hpp"

#include <vector>

namespace rs::capture {

// By the camera itself.
struct Seen {
    bool areas = false;
    bool environment = false;
};

class PathTracer {
public:
    // Refers to all of them. Thread-safe.
    PathTracer(const Scene& scene, const RayScene& rays, const LightSet& lights,
               const std::vector<SurfaceModel>& models, int max_bounces, Seen seen = {})
        : scene_(scene), rays_(rays), lights_(lights), models_(models), max_bounces_(max_bounces), seen_(seen) {}

    // False where the ray meets nothing; then `radiance` is 0. The camera sees environment and area lights themselves
    // only where they are `seen`; primitives it never sees. `direction` has unit length.
    bool trace(glm::vec3 origin, glm::vec3 direction, Sampler& sampler, glm::vec3& radiance) const;

private:
    // How the segment that is being followed was drawn.
    struct Segment {
        glm::vec3 origin;
        glm::vec3 direction;
        float pdf = 0.0F;
        bool specular = true;  // no light sample could have given it
        bool seen_by_camera = true;
        LightSet::Selection selection{};  // of the light sample at its beginning
    };
    struct Shading;

    [[nodiscard]] glm::vec3 areas_on_the_way(const Segment& segment, float distance) const;
    [[nodiscard]] glm::vec3 environment_behind(const Segment& segment) const;
    [[nodiscard]] glm::vec3 emission_of(const Material& material, const SurfacePoint& point,
                                        const Segment& segment) const;
    [[nodiscard]] glm::vec3 light_sample(const Shading& shading, float u_source, const glm::vec2& u) const;
    [[nodiscard]] Segment segment_from(const Shading& shading, const SurfaceSample& drawn) const;

    const Scene& scene_;
    const RayScene& rays_;
    const LightSet& lights_;
    const std::vector<SurfaceModel>& models_;
    int max_bounces_;
    Seen seen_;
};

}  // namespace rs::capture
