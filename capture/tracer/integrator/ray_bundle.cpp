// The part of RayScene that sends several rays at once.
#include "capture/tracer/integrator/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

namespace rs::capture {

RayScene::Bundle RayScene::distances(const std::array<glm::vec3, kBundle>& origins, const glm::vec3& direction,
                                     float time) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(32) const std::array<int, kBundle> valid{-1, -1, -1, -1, -1, -1, -1, -1};
    RTCRayHit8 query{};
    for (std::size_t i = 0; i < kBundle; ++i) {
        query.ray.org_x[i] = origins[i].x;
        query.ray.org_y[i] = origins[i].y;
        query.ray.org_z[i] = origins[i].z;
        query.ray.dir_x[i] = direction.x;
        query.ray.dir_y[i] = direction.y;
        query.ray.dir_z[i] = direction.z;
        query.ray.time[i] = time;
        query.ray.tfar[i] = std::numeric_limits<float>::infinity();
        query.ray.mask[i] = 0xFFFFFFFFU;
        query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid.data(), still_->embree(), &context, &query);
    if (moving_) rtcIntersect8(valid.data(), moving_->embree(), &context, &query);
    Bundle found;
    for (std::size_t i = 0; i < kBundle; ++i) {
        found[i] =
            query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : query.ray.tfar[i];
    }
    return found;
}

}  // namespace rs::capture
