// The half of RayScene that asks for many rays at a time.
#include "capture/tracer/rays/ray_scene.hpp"
#include "rayspace/base/check.hpp"

#include <embree3/rtcore.h>

#include <algorithm>

namespace rs::capture {

namespace {

constexpr std::size_t kLanes = 16;

// Fills the lanes that have a ray and gives how many they are.
std::size_t fill(std::span<const RayScene::Ray> rays, RTCRay16& packet, int (&valid)[kLanes]) {
    const std::size_t count = std::min(rays.size(), kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
        valid[i] = i < count ? -1 : 0;
        const RayScene::Ray& ray = rays[std::min(i, count - 1)];
        packet.org_x[i] = ray.origin.x;
        packet.org_y[i] = ray.origin.y;
        packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x;
        packet.dir_y[i] = ray.direction.y;
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = 0.0F;
        packet.tfar[i] = ray.reach;
        packet.time[i] = ray.time;
        packet.mask[i] = 0xFFFFFFFFU;
        packet.id[i] = packet.flags[i] = 0;
    }
    return count;
}

// For instances: Embree 3.13.5 does not come back from some coherent packets there.
RTCIntersectContext incoherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return context;
}

RTCIntersectContext coherent() {
    RTCIntersectContext context = incoherent();
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

}  // namespace

void RayScene::intersect_many(std::span<const Ray> rays, std::span<Hit> hits) const {
    RS_CHECK(rays.size() == hits.size());
    for (std::size_t first = 0; first < rays.size(); first += kLanes) {
        alignas(64) RTCRayHit16 packet;
        alignas(64) int valid[kLanes];
        const std::size_t count = fill(rays.subspan(first), packet.ray, valid);
        std::fill(std::begin(packet.hit.geomID), std::end(packet.hit.geomID), RTC_INVALID_GEOMETRY_ID);
        std::fill(std::begin(packet.hit.instID[0]), std::end(packet.hit.instID[0]), RTC_INVALID_GEOMETRY_ID);
        RTCIntersectContext context = coherent();
        rtcIntersect16(valid, still_->embree(), &context, &packet);
        if (moving_) {
            context = incoherent();
            rtcIntersect16(valid, moving_->embree(), &context, &packet);
        }
        for (std::size_t i = 0; i < count; ++i) {
            hits[first + i] = {};
            if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
            hits[first + i] = {packet.ray.tfar[i],   packet.hit.u[i],      packet.hit.v[i],
                               packet.hit.geomID[i], packet.hit.primID[i], packet.hit.instID[0][i]};
        }
    }
}

void RayScene::occluded_many(std::span<const Ray> rays, std::span<std::uint8_t> hidden) const {
    RS_CHECK(rays.size() == hidden.size());
    for (std::size_t first = 0; first < rays.size(); first += kLanes) {
        alignas(64) RTCRay16 packet;
        alignas(64) int valid[kLanes];
        const std::size_t count = fill(rays.subspan(first), packet, valid);
        RTCIntersectContext context = coherent();
        rtcOccluded16(valid, still_->embree(), &context, &packet);
        if (moving_) {
            for (std::size_t i = 0; i < count; ++i) valid[i] = packet.tfar[i] < 0.0F ? 0 : -1;
            context = incoherent();
            rtcOccluded16(valid, moving_->embree(), &context, &packet);
        }
        for (std::size_t i = 0; i < count; ++i) {
            bool in_the_way = packet.tfar[i] < 0.0F;
            if (!in_the_way && primitives_) {
                // Primitives take one ray at a time.
                const Ray& ray = rays[first + i];
                RTCIntersectContext single = incoherent();
                RTCRay asked{ray.origin.x,
                             ray.origin.y,
                             ray.origin.z,
                             0.0F,
                             ray.direction.x,
                             ray.direction.y,
                             ray.direction.z,
                             ray.time,
                             ray.reach,
                             0xFFFFFFFFU,
                             0,
                             0};
                rtcOccluded1(primitives_.get(), &single, &asked);
                in_the_way = asked.tfar < 0.0F;
            }
            hidden[first + i] = in_the_way ? 1 : 0;
        }
    }
}

}  // namespace rs::capture
