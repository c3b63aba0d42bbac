#include "capture/tracer/rays/ray_scene.hpp"

#include "capture/tracer/rays/scope_query.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {

namespace {

// Embree calls back for the primitives' boxes and for intersection with one. The context carries the result.
struct PrimitiveQuery {
    RTCIntersectContext context{};
    std::optional<RayPrimitive::Answer> nearest{};
};

void primitive_bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto& primitive = *static_cast<const RayPrimitive*>(arguments->geometryUserPtr);
    const RayPrimitive::Box box = primitive.bounds();
    *arguments->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

std::optional<RayPrimitive::Answer> intersect_nearest(const void* user, const RTCRay& ray) {
    auto answer = static_cast<const RayPrimitive*>(user)->answer({ray.org_x, ray.org_y, ray.org_z},
                                                                 {ray.dir_x, ray.dir_y, ray.dir_z});
    if (answer && !(answer->distance > ray.tnear && answer->distance < ray.tfar)) answer.reset();
    return answer;
}

void intersect_primitive(const RTCIntersectFunctionNArguments* arguments) {
    auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const auto answer = intersect_nearest(arguments->geometryUserPtr, hit.ray);
    if (!answer) return;
    hit.ray.tfar = answer->distance;
    hit.hit.geomID = arguments->geomID;
    hit.hit.primID = arguments->primID;
    reinterpret_cast<PrimitiveQuery*>(arguments->context)->nearest = answer;
}

// Position derivatives by uv from the triangle's edges in space and in the texture; 0 without area in the texture.
void set_texture_axes(const Mesh& mesh, const glm::uvec3& t, const std::array<glm::vec3, 3>& corners,
                      SurfacePoint& point) {
    point.along_u = point.along_v = glm::vec3(0.0F);
    if (mesh.uvs.empty()) return;
    const glm::vec2 d1 = mesh.uvs[t.y] - mesh.uvs[t.x], d2 = mesh.uvs[t.z] - mesh.uvs[t.x];
    const glm::vec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0];
    const float area = d1.x * d2.y - d2.x * d1.y;
    if (area == 0.0F) return;
    point.along_u = (e1 * d2.y - e2 * d1.y) / area;
    point.along_v = (e2 * d1.x - e1 * d2.x) / area;
}

void occlude_primitive(const RTCOccludedFunctionNArguments* arguments) {
    auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
    if (intersect_nearest(arguments->geometryUserPtr, ray)) ray.tfar = -std::numeric_limits<float>::infinity();
}

glm::vec3 normalize_or_zero(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0F ? v / length : glm::vec3(0.0F);
}

}  // namespace

void RayScene::add_primitives() {
    if (scene_->primitives.empty()) return;
    primitives_.reset(rtcNewScene(device_.get()));
    for (const auto& primitive : scene_->primitives) {
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, const_cast<RayPrimitive*>(primitive.get()));
        rtcSetGeometryBoundsFunction(geometry, primitive_bounds, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect_primitive);
        rtcSetGeometryOccludedFunction(geometry, occlude_primitive);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(primitives_.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(primitives_.get());
}

std::optional<RayPrimitive::Answer> RayScene::intersect_primitives(const glm::vec3& origin, const glm::vec3& direction,
                                                                   float distance) const {
    if (!primitives_) return std::nullopt;
    PrimitiveQuery query;
    rtcInitIntersectContext(&query.context);
    RTCRayHit hit{};
    hit.ray = {origin.x,    origin.y, origin.z, 0.0F,        direction.x, direction.y,
               direction.z, 0.0F,     distance, 0xFFFFFFFFU, 0,           0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(primitives_.get(), &query.context, &hit);
    return query.nearest;
}

Result<RayScene> RayScene::create(const Scene& scene) {
    // The tree's order determines which of two triangles a ray through their common edge hits, so it must not depend
    // on scheduling or the number of processors: Embree uses the concurrency of the calling arena. (Its option
    // "threads=1" would limit the whole process.)
    tbb::task_arena one_thread(1);
    return one_thread.execute([&] { return build(scene); });
}

Result<RayScene> RayScene::build(const Scene& scene) {
    RayScene result;
    result.scene_ = &scene;
    result.device_.reset(rtcNewDevice(nullptr));
    if (!result.device_) {
        return Error{rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU
                         ? "ray tracing: Embree cannot start on this processor"
                         : "ray tracing: Embree cannot start; is there enough memory (ulimit -v)?"};
    }
    RS_ASSIGN_OR_RETURN(MeshTree still, MeshTree::build(result.device_.get(), scene.meshes, scene));
    result.static_meshes_ = std::move(still);
    if (!scene.instances.empty()) {
        RS_ASSIGN_OR_RETURN(InstanceTree moving, InstanceTree::build(result.device_.get(), scene));
        result.instances_ = std::move(moving);
    }
    result.add_primitives();
    result.update_scopes();
    if (rtcGetDeviceError(result.device_.get()) != RTC_ERROR_NONE) {
        return Error{"ray tracing: Embree could not build its acceleration structure; use smaller meshes"};
    }
    result.compute_bounds();
    return result;
}

void RayScene::compute_bounds() {
    glm::vec3 lower(std::numeric_limits<float>::infinity());
    glm::vec3 upper(-std::numeric_limits<float>::infinity());
    if (!static_meshes_->empty()) {
        lower = static_meshes_->lower();
        upper = static_meshes_->upper();
    }
    if (instances_ && !instances_->empty()) {
        lower = glm::min(lower, instances_->lower());
        upper = glm::max(upper, instances_->upper());
    }
    if (lower.x > upper.x) return;
    lower_ = lower;
    upper_ = upper;
    const glm::vec3 extent = glm::max(glm::abs(lower), glm::abs(upper));
    step_off_ = 1e-5F * std::max(extent.x, std::max(extent.y, extent.z));
}

void RayScene::update(std::span<const std::size_t> moved) {
    if (!instances_) return;
    instances_->update(moved);
    compute_bounds();
    update_scopes();
}

RayScene::Builds RayScene::builds() const {
    return {1 + static_cast<std::int64_t>(instances_ ? scene_->parts.size() : 0),
            instances_ ? instances_->top_builds() : 0};
}

bool RayScene::intersect_visible(const glm::vec3& origin, const glm::vec3& direction, float time,
                                 SurfacePoint& point) const {
    float passed = 0.0F;
    while (intersect(origin + direction * passed, direction, time, point)) {
        point.distance += passed;
        if (!scene_->surrounds(point.material)) return true;
        passed = point.distance + step_off_;
    }
    return false;
}

void RayScene::update_scopes() {
    primitives_in_scope_.assign(scene_->lights.size(), {});
    for (std::uint32_t light = 0; light < scene_->lights.size(); ++light) {
        if (scene_->lights[light].everywhere || scene_->primitives.empty()) continue;
        const ScopeBounds bounds = bounds_of_scope(*scene_, light);
        for (const auto& primitive : scene_->primitives) {
            const RayPrimitive::Box box = primitive->bounds();
            primitives_in_scope_[light].push_back(bounds.contains(0.5F * (box.lower + box.upper)));
        }
    }
}

bool RayScene::intersect(const glm::vec3& origin, const glm::vec3& direction, float time, SurfacePoint& point) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return intersect_trees(context, origin, direction, time, point);
}

bool RayScene::intersect_in_scope(std::uint32_t light, const glm::vec3& origin, const glm::vec3& direction, float time,
                                  SurfacePoint& point) const {
    ScopeQuery query(*scene_, light, false, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    return intersect_trees(query.context, origin, direction, time, point);
}

bool RayScene::intersect_trees(RTCIntersectContext& context, const glm::vec3& origin, const glm::vec3& direction,
                               float time, SurfacePoint& point) const {
    RTCRayHit query{};
    query.ray = {origin.x,    origin.y,    origin.z,
                 0.0F,        direction.x, direction.y,
                 direction.z, time,        std::numeric_limits<float>::infinity(),
                 0xFFFFFFFFU, 0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(static_meshes_->embree(), &context, &query);
    if (instances_) rtcIntersect1(instances_->embree(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    surface_at({query.ray.tfar, query.hit.u, query.hit.v, query.hit.geomID, query.hit.primID, query.hit.instID[0]},
               direction, time, point);
    return true;
}

void RayScene::place(unsigned instance, float time, Corners& corners) const {
    if (instance == RTC_INVALID_GEOMETRY_ID) return;
    const InstanceTransform placed = instances_->transform_at(instance, time);
    for (glm::vec3& place : corners.positions) place = glm::vec3(placed.world_from_part * glm::vec4(place, 1.0F));
    for (glm::vec3& normal : corners.normals) normal = normalize_or_zero(placed.normals * normal);
    if (glm::determinant(placed.normals) < 0.0F) corners.winding = -1.0F;
}

void RayScene::surface_at(const Hit& hit, const glm::vec3& direction, float time, SurfacePoint& point) const {
    const Mesh& mesh = scene_->mesh_of(hit.mesh, hit.instance);
    const glm::uvec3 t = mesh.triangles[hit.triangle];
    Corners of(mesh, t);
    place(hit.instance, time, of);
    const auto& corners = of.positions;
    const auto& normals = of.normals;
    const float weights[3] = {1.0F - hit.u - hit.v, hit.u, hit.v};
    point.time = time;
    point.is_light_sampled = hit.instance == RTC_INVALID_GEOMETRY_ID || !scene_->instances[hit.instance].at_close;
    point.position = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
    point.distance = hit.distance;
    point.material = mesh.material;
    point.light_group = scene_->scopes.group_of(hit.mesh, hit.instance);
    point.uv = interpolate_uv(mesh, hit.triangle, hit.u, hit.v);
    point.colour = interpolate_colour(mesh, hit.triangle, hit.u, hit.v);

    const glm::vec3 cross = of.winding * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float length = glm::length(cross);
    point.geometric_normal = length > 0.0F ? cross / length : -direction;
    point.front_side = glm::dot(point.geometric_normal, direction) < 0.0F;
    if (!point.front_side) point.geometric_normal = -point.geometric_normal;
    if (scene_->materials[static_cast<std::size_t>(mesh.material)].relief >= 0) {
        set_texture_axes(mesh, t, corners, point);
    }
    point.shading_normal = point.geometric_normal;
    point.lifted_position = point.position;
    if (mesh.normals.empty()) return;

    const glm::vec3 blended = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
    const float blended_length = glm::length(blended);
    if (!(blended_length > 1e-6F)) return;
    // In some files the winding contradicts the normals: the sides follow the winding, the curvature the normals.
    const float side = glm::dot(blended, point.geometric_normal) < 0.0F ? -1.0F : 1.0F;
    point.shading_normal = blended * (side / blended_length);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 normal = normals[i] * side;
        const float below = std::min(0.0F, glm::dot(point.position - corners[i], normal));
        point.lifted_position -= normal * (weights[i] * below);
    }
}

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
    rtcIntersect8(valid.data(), static_meshes_->embree(), &context, &query);
    // Instances do not support coherent packets (ray_packets.cpp).
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    if (instances_) rtcIntersect8(valid.data(), instances_->embree(), &context, &query);
    Bundle found;
    for (std::size_t i = 0; i < kBundle; ++i) {
        found[i] =
            query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : query.ray.tfar[i];
    }
    return found;
}

bool RayScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float distance, float time,
                        const ShadowCasters& casters) const {
    if (!casters.any) return false;
    ScopeQuery in_scope(*scene_, casters.scoped_light, true, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    RTCIntersectContext all;
    rtcInitIntersectContext(&all);
    RTCIntersectContext& context = casters.scoped_light == kUnscoped ? all : in_scope.context;
    RTCRay ray{origin.x,    origin.y, origin.z, 0.0F,        direction.x, direction.y,
               direction.z, time,     distance, 0xFFFFFFFFU, 0,           0};
    rtcOccluded1(static_meshes_->embree(), &context, &ray);
    if (ray.tfar >= 0.0F && instances_) rtcOccluded1(instances_->embree(), &context, &ray);
    return ray.tfar < 0.0F || primitive_occludes(origin, direction, distance, time, casters);
}

}  // namespace rs::capture
