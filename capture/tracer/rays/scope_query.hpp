#pragma once
// Embree context of rays that only hit surfaces illuminated by a scoped light (LightScopes), and one-sided surfaces
// only from the front. Part of ray_scene.

#include "capture/tracer/scene/scene.hpp"

#include <embree3/rtcore.h>

#include <cstdint>

namespace rs::capture {

struct ScopeQuery {
    RTCIntersectContext context;  // first member: the filter function casts its address
    const Scene& scene;
    std::uint32_t light;
    bool is_shadow_ray;  // towards the light; otherwise in the direction of the light

    ScopeQuery(const Scene& of, std::uint32_t scoped_light, bool shadow_ray, RTCIntersectContextFlags flags)
        : scene(of), light(scoped_light), is_shadow_ray(shadow_ray) {
        rtcInitIntersectContext(&context);
        context.flags = flags;
        context.filter = reject_others;
    }

private:
    static void reject_others(const RTCFilterFunctionNArguments* arguments) {
        const auto& query = *reinterpret_cast<const ScopeQuery*>(arguments->context);
        const unsigned n = arguments->N;
        for (unsigned i = 0; i < n; ++i) {
            if (arguments->valid[i] == 0) continue;
            const unsigned mesh = RTCHitN_geomID(arguments->hit, n, i);
            const unsigned instance = RTCHitN_instID(arguments->hit, n, i, 0);
            // Both in the coordinates of the part.
            const glm::vec3 normal(RTCHitN_Ng_x(arguments->hit, n, i), RTCHitN_Ng_y(arguments->hit, n, i),
                                   RTCHitN_Ng_z(arguments->hit, n, i));
            const glm::vec3 direction(RTCRayN_dir_x(arguments->ray, n, i), RTCRayN_dir_y(arguments->ray, n, i),
                                      RTCRayN_dir_z(arguments->ray, n, i));
            const bool hits_front = glm::dot(normal, direction) < 0.0F;
            if (!query.accepts(mesh, instance, hits_front != query.is_shadow_ray)) arguments->valid[i] = 0;
        }
    }

    [[nodiscard]] bool accepts(unsigned mesh, unsigned instance, bool lit_from_front) const {
        if (!scene.scopes.illuminates(light, scene.scopes.group_of(mesh, instance))) return false;
        return lit_from_front ||
               !scene.materials[static_cast<std::size_t>(scene.mesh_of(mesh, instance).material)].is_one_sided();
    }
};

}  // namespace rs::capture
