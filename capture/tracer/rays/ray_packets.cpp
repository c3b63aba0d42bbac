// Packet tracing of RayScene.
#include "capture/tracer/rays/ray_scene.hpp"
#include "capture/tracer/rays/scope_query.hpp"
#include "rayspace/api/types/check.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstddef>

namespace rs::capture {

namespace {

// Copies up to kLanes rays to a packet and returns their number.
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

// For instances: Embree 3.13.5 does not return for some coherent packets.
RTCIntersectContext incoherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return context;
}

// Embree aborts if lanes that are not active contain NaN. Their times are kept for later calls.
void reset_inactive_lanes(const MaskLanes& active, RayLanes& rays) {
    for (std::size_t i = 0; i < kLanes; ++i) {
        if (active[i] != 0) continue;
        rays.origin.set(i, glm::vec3(0.0F));
        rays.direction.set(i, glm::vec3(0.0F, 0.0F, 1.0F));
        rays.nearest[i] = rays.reach[i] = 0.0F;
    }
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
        rtcIntersect16(valid, static_meshes_->embree(), &context, &packet);
        if (instances_) {
            context = incoherent();
            rtcIntersect16(valid, instances_->embree(), &context, &packet);
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
        rtcOccluded16(valid, static_meshes_->embree(), &context, &packet);
        if (instances_) {
            for (std::size_t i = 0; i < count; ++i) valid[i] = packet.tfar[i] < 0.0F ? 0 : -1;
            context = incoherent();
            rtcOccluded16(valid, instances_->embree(), &context, &packet);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Ray& ray = rays[first + i];
            const bool occluded =
                packet.tfar[i] < 0.0F || primitive_occludes(ray.origin, ray.direction, ray.reach, ray.time, {});
            hidden[first + i] = occluded ? 1 : 0;
        }
    }
}

// Primitives support single rays only.
bool RayScene::primitive_occludes(const glm::vec3& origin, const glm::vec3& direction, float distance, float time,
                                  const ShadowCasters& casters) const {
    if (!primitives_) return false;
    if (casters.scoped_light != kUnscoped) {
        const std::vector<bool>& in_scope = primitives_in_scope_[casters.scoped_light];
        for (std::size_t i = 0; i < in_scope.size(); ++i) {
            if (!in_scope[i]) continue;
            const auto answer = scene_->primitives[i]->answer(origin, direction);
            if (answer && answer->distance < distance) return true;
        }
        return false;
    }
    RTCIntersectContext context = incoherent();
    RTCRay ray{origin.x,    origin.y, origin.z, 0.0F,        direction.x, direction.y,
               direction.z, time,     distance, 0xFFFFFFFFU, 0,           0};
    rtcOccluded1(primitives_.get(), &context, &ray);
    return ray.tfar < 0.0F;
}

void RayScene::intersect(const MaskLanes& active, RayHitLanes& met) const {
    static_assert(sizeof(RayHitLanes) == sizeof(RTCRayHit16) &&
                  offsetof(RayHitLanes, hit) == offsetof(RTCRayHit16, hit));
    static_assert(offsetof(RayLanes, reach) == offsetof(RTCRay16, tfar));
    static_assert(offsetof(HitLanes, instance) == offsetof(RTCHit16, instID));
    reset_inactive_lanes(active, met.ray);
    auto* packet = reinterpret_cast<RTCRayHit16*>(&met);
    RTCIntersectContext context = coherent();
    rtcIntersect16(active.of.data(), static_meshes_->embree(), &context, packet);
    if (!instances_) return;
    context = incoherent();
    rtcIntersect16(active.of.data(), instances_->embree(), &context, packet);
}

void RayScene::occluded(const MaskLanes& active, RayLanes& rays, const ShadowCasters& casters) const {
    if (!casters.any) return;
    reset_inactive_lanes(active, rays);
    auto* packet = reinterpret_cast<RTCRay16*>(&rays);
    ScopeQuery in_scope(*scene_, casters.scoped_light, true, RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    RTCIntersectContext all = coherent();
    RTCIntersectContext& context = casters.scoped_light == kUnscoped ? all : in_scope.context;
    const Lanes reach = rays.reach;
    rtcOccluded16(active.of.data(), static_meshes_->embree(), &context, packet);
    if (instances_) {
        MaskLanes remaining;
        for (std::size_t i = 0; i < kLanes; ++i) remaining[i] = rays.reach[i] < 0.0F ? 0 : active[i];
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        rtcOccluded16(remaining.of.data(), instances_->embree(), &context, packet);
    }
    if (!primitives_) return;
    for (std::size_t i = 0; i < kLanes; ++i) {
        if (active[i] == 0 || rays.reach[i] < 0.0F) continue;
        if (primitive_occludes(rays.origin.at(i), rays.direction.at(i), reach[i], rays.time[i], casters)) {
            rays.reach[i] = -1.0F;
        }
    }
}

const Mesh& RayScene::gather_triangle(const RayHitLanes& met, std::size_t lane, TriangleLanes& triangles) const {
    const HitLanes& hit = met.hit;
    const unsigned instance = hit.instance[lane];
    const Mesh& mesh = scene_->mesh_of(hit.mesh[lane], instance);
    const glm::uvec3 t = mesh.triangles[hit.triangle[lane]];
    const bool has_normals = !mesh.normals.empty(), has_uvs = !mesh.uvs.empty();
    for (std::size_t i = 0; i < 3; ++i) {
        const unsigned vertex = t[static_cast<int>(i)];
        triangles.corner[i].set(lane, mesh.positions[vertex]);
        triangles.normal[i].set(lane, has_normals ? mesh.normals[vertex] : glm::vec3(0.0F));
        triangles.uv[i].set(lane, has_uvs ? mesh.uvs[vertex] : glm::vec2(0.0F));
    }
    triangles.winding[lane] = 1.0F;
    if (instance != RTC_INVALID_GEOMETRY_ID) {
        Corners corners(mesh, t);
        place(instance, met.ray.time[lane], corners);
        for (std::size_t i = 0; i < 3; ++i) {
            triangles.corner[i].set(lane, corners.positions[i]);
            triangles.normal[i].set(lane, corners.normals[i]);
        }
        triangles.winding[lane] = corners.winding;
    }
    triangles.u[lane] = hit.u[lane];
    triangles.v[lane] = hit.v[lane];
    return mesh;
}

}  // namespace rs::capture
