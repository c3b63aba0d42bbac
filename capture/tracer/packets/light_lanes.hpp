#pragma once
// One light on sixteen surfaces. Scalar counterparts: LightSet::sample_centre(), Surface::evaluate() and
// WhittedTracer::make_shadow_ray(); for virtual lights, a function in tests/capture/tracer/packets/packets_test.cpp.

#include "capture/tracer/packets/surface_lanes.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

// LightSample for the lanes that are `lit`.
struct LightLanes {
    MaskLanes lit;
    Lanes3 direction;
    Lanes distance;
    Lanes3 radiance;
    Lanes pdf;
    // For all lanes:
    bool delta = true;  // `pdf` is 1 and unused
    ShadowCasters casters;
};

// A point light, spot light or luminaire without its photometric web or cone falloff.
struct PointLight {
    glm::dvec3 location{0.0};
    double radius = 0;
    glm::vec3 attenuation{1, 0, 0};
    float least_attenuation = 1;
    glm::vec3 colour{0};  // pi times the light's
    // For LightSet's estimate.
    float power = 0;
    glm::vec3 towards{0};
    float min_cos = -1;
};

// A rectangle or a disc, sampled at its centre.
struct AreaLight {
    glm::vec3 centre{0}, normal{0};
    glm::vec3 radiance{0};
    float area = 1;
    float power = 0;  // for LightSet's estimate
};

// A surface point that reflects the flux of a photon (integrator/virtual_lights.hpp); fields as in SurfaceLanes. The
// viewer is the direction to the photon's origin.
struct VirtualLight {
    SurfaceKind kind = SurfaceKind::diffuse;
    float alpha = 1, ior = 1, translucency = 0, base = 1;
    std::int32_t table = 0;
    glm::vec3 position{0}, near_start{0};
    glm::vec3 geometric_normal{0};
    glm::vec3 normal{0}, tangent{0}, bitangent{0};
    glm::vec3 colour{0};
    glm::vec3 viewer{0};
    float step_off = 0;
    glm::vec3 flux{0};  // incident
    int depth = 1;      // surfaces on the photon's path, this one included
};

// Directional light; `direction` has unit length and points to the light.
void light_from_direction(const glm::vec3& direction, const glm::vec3& irradiance, const MaskLanes& active,
                          LightLanes& incident);

// Finds the lanes on which the light may have an effect: LightSet's estimate is above 0, and the surface faces the
// light or is translucent. Returns false if there are none.
bool cull_point_light(const PointLight& light, const SurfaceLanes& surfaces, const MaskLanes& active,
                      MaskLanes& reached);

// The functions below compute unoccluded light and return false if no lane is lit.

bool light_from_point(const PointLight& light, const Lanes3& positions, const MaskLanes& active, LightLanes& incident);

bool light_from_area(const AreaLight& light, const Lanes3& positions, const MaskLanes& active, LightLanes& incident);

// Limits the geometry term, both cosines over squared distance, to `bound`.
bool light_from_virtual(const VirtualLight& light, float bound, const float* tables, const SurfaceLanes& surfaces,
                        const MaskLanes& active, LightLanes& incident);

// Shadow rays, and the radiance that diffuse, glossy and metal surfaces reflect to their viewers if unoccluded.
struct ShadowLanes {
    MaskLanes active;  // lanes that have a ray
    RayLanes ray;      // `time` is not set
    Lanes3 light;
};
// Returns false if no lane has a ray.
bool reflect_light(const SurfaceLanes& surfaces, const LightLanes& incident, const float* tables, ShadowLanes& shadows);

// Adds the light of the unoccluded rays to `sum`.
void add_light(const ShadowLanes& shadows, Lanes3& sum);

}  // namespace rs::capture
