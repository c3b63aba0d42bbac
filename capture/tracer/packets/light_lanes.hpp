#pragma once
// One light that falls on sixteen surfaces. The twins are LightSet::middle(), Surface::evaluate() and what Whitted's
// ray tracing does between them; that of virtual lights stands beside its test
// (tests/capture/tracer/packets/packets_test.cpp).

#include "capture/tracer/packets/surface_lanes.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

// As LightSample has it, for the lanes that are `lit`.
struct LightLanes {
    MaskLanes lit;
    Lanes3 direction;
    Lanes distance;
    Lanes3 radiance;
    Lanes pdf;
    bool delta = true;  // all lanes; `pdf` is 1 then, and is not looked at
};

// A point, a spot or a luminaire, as far as it is known without its web or its cone.
struct PointLight {
    glm::dvec3 location{0.0};
    double radius = 0;
    glm::vec3 attenuation{1, 0, 0};
    float least_attenuation = 1;
    glm::vec3 colour{0};  // pi times the light's
    // What LightSet estimates by.
    float power = 0;
    glm::vec3 towards{0};
    float least_cos = -1;
};

// A rectangle or a disc, taken for its middle.
struct AreaLight {
    glm::vec3 middle{0}, normal{0};
    glm::vec3 radiance{0};
    float area = 1;
    float power = 0;  // what LightSet estimates by
};

// A surface that light has fallen on and that lights others (integrator/virtual_lights.hpp), as SurfaceLanes has one.
// Its viewer is where the light came from.
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
    glm::vec3 flux{0};  // that arrives
    int depth = 1;      // surfaces that it has met, this one included
};

// The same light everywhere; `direction` has unit length and goes to it.
void light_from_afar(const glm::vec3& direction, const glm::vec3& irradiance, const MaskLanes& wanted,
                     LightLanes& arrives);

// The lanes on which the light may have an effect: where LightSet's estimate is above 0, and which face it or let light
// through. False where there are none.
bool reach_of_point(const PointLight& light, const SurfaceLanes& surfaces, const MaskLanes& wanted, MaskLanes& reached);

// The light of a point with nothing in between; false where no lane is lit.
bool light_from_point(const PointLight& light, const Lanes3& places, const MaskLanes& wanted, LightLanes& arrives);

// That of an area.
bool light_from_area(const AreaLight& light, const Lanes3& places, const MaskLanes& wanted, LightLanes& arrives);

// That of a virtual light: the geometry term, both cosines over squared distance, is cut down to `bound`.
bool light_from_virtual(const VirtualLight& light, float bound, const float* tables, const SurfaceLanes& surfaces,
                        const MaskLanes& wanted, LightLanes& arrives);

// What light makes surfaces of matte, coated and metal materials send to their viewers, and the rays that have to find
// nothing in the way; false where there are none.
struct SentLanes {
    MaskLanes asked;  // lanes that have a ray
    RayLanes ray;     // `time` is not touched
    Lanes3 light;
};
bool send_light(const SurfaceLanes& surfaces, const LightLanes& arrives, const float* tables, SentLanes& sent);

// Adds the light of the rays that have found nothing in the way to `sum`.
void add_light(const SentLanes& sent, Lanes3& sum);

}  // namespace rs::capture
