#include "capture/tracer/integrator/ray_scene.hpp"

#include "capture/tracer/scene/texture_lookup.hpp"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace rs::capture {

// Embree calls this for each candidate hit of a geometry that has holes.
struct CutoutFilter {
    static void reject_holes(const RTCFilterFunctionNArguments* arguments) {
        const auto& cutout = *static_cast<const RayScene::Cutout*>(arguments->geometryUserPtr);
        for (unsigned i = 0; i < arguments->N; ++i) {
            if (arguments->valid[i] == 0) continue;
            const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, i);
            const float u = RTCHitN_u(arguments->hit, arguments->N, i);
            const float v = RTCHitN_v(arguments->hit, arguments->N, i);
            const glm::vec2 uv = interpolate_uv(*cutout.mesh, primitive, u, v);
            if (sample_texture_alpha(*cutout.texture, uv) < kHoleAlpha) arguments->valid[i] = 0;
        }
    }
};

namespace {

// Embree asks for the primitives' boxes, and for what a ray meets in one. The answer travels in the context.
struct PrimitiveQuery {
    RTCIntersectContext context{};
    std::optional<RayPrimitive::Answer> nearest{};
};

void box_of(const RTCBoundsFunctionArguments* arguments) {
    const auto& primitive = *static_cast<const RayPrimitive*>(arguments->geometryUserPtr);
    const RayPrimitive::Box box = primitive.bounds();
    *arguments->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

std::optional<RayPrimitive::Answer> ask(const void* user, const RTCRay& ray) {
    auto answer = static_cast<const RayPrimitive*>(user)->answer({ray.org_x, ray.org_y, ray.org_z},
                                                                 {ray.dir_x, ray.dir_y, ray.dir_z});
    if (answer && !(answer->distance > ray.tnear && answer->distance < ray.tfar)) answer.reset();
    return answer;
}

void intersect_primitive(const RTCIntersectFunctionNArguments* arguments) {
    auto& hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    const auto answer = ask(arguments->geometryUserPtr, hit.ray);
    if (!answer) return;
    hit.ray.tfar = answer->distance;
    hit.hit.geomID = arguments->geomID;
    hit.hit.primID = arguments->primID;
    reinterpret_cast<PrimitiveQuery*>(arguments->context)->nearest = answer;
}

// From the triangle's edges in space and on the texture; 0 where it has no area there.
void set_texture_axes(const Mesh& mesh, const glm::uvec3& t, const glm::vec3* corners, SurfacePoint& point) {
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
    if (ask(arguments->geometryUserPtr, ray)) ray.tfar = -std::numeric_limits<float>::infinity();
}

}  // namespace

void RayScene::add_primitives() {
    if (scene_->primitives.empty()) return;
    primitives_.reset(rtcNewScene(device_.get()));
    for (const auto& primitive : scene_->primitives) {
        RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, const_cast<RayPrimitive*>(primitive.get()));
        rtcSetGeometryBoundsFunction(geometry, box_of, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect_primitive);
        rtcSetGeometryOccludedFunction(geometry, occlude_primitive);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(primitives_.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(primitives_.get());
}

std::optional<RayPrimitive::Answer> RayScene::ask_primitives(const glm::vec3& origin, const glm::vec3& direction,
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

void RayScene::Release::operator()(RTCDeviceTy* device) const {
    rtcReleaseDevice(device);
}
void RayScene::Release::operator()(RTCSceneTy* scene) const {
    rtcReleaseScene(scene);
}

Result<RayScene> RayScene::create(const Scene& scene) {
    // The order of the tree decides which of two triangles a ray through their common edge hits, so it must not depend
    // on scheduling or on the number of processors: Embree takes the size of its own arena from the one it is started
    // in. (Its option "threads=1" would limit the whole process.)
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
    result.embree_scene_.reset(rtcNewScene(result.device_.get()));
    rtcSetSceneFlags(result.embree_scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(result.embree_scene_.get(), RTC_BUILD_QUALITY_HIGH);

    glm::vec3 lower(std::numeric_limits<float>::infinity());
    glm::vec3 upper(-std::numeric_limits<float>::infinity());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (mesh.triangles.empty()) continue;
        RTCGeometry geometry = rtcNewGeometry(result.device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        // Copied into buffers of Embree's own, which have the padding that its vector loads need.
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 sizeof(glm::vec3), mesh.positions.size());
        void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                sizeof(glm::uvec3), mesh.triangles.size());
        if (vertices == nullptr || indices == nullptr) {
            rtcReleaseGeometry(geometry);
            return Error{"ray tracing: no memory for mesh \"" + mesh.name + "\" with " +
                         std::to_string(mesh.triangles.size()) + " triangles; use a smaller mesh"};
        }
        std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
        std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
        for (const glm::uvec3& t : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                lower = glm::min(lower, mesh.positions[t[corner]]);
                upper = glm::max(upper, mesh.positions[t[corner]]);
            }
        }
        const int texture = scene.materials[static_cast<std::size_t>(mesh.material)].texture;
        if (texture >= 0 && !mesh.uvs.empty() && has_holes(scene.textures[static_cast<std::size_t>(texture)])) {
            result.cutouts_.push_back(
                std::make_unique<Cutout>(Cutout{&mesh, &scene.textures[static_cast<std::size_t>(texture)]}));
            rtcSetGeometryUserData(geometry, result.cutouts_.back().get());
            rtcSetGeometryIntersectFilterFunction(geometry, CutoutFilter::reject_holes);
            rtcSetGeometryOccludedFilterFunction(geometry, CutoutFilter::reject_holes);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(result.embree_scene_.get(), geometry, static_cast<unsigned>(m));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(result.embree_scene_.get());
    result.add_primitives();
    if (rtcGetDeviceError(result.device_.get()) != RTC_ERROR_NONE) {
        return Error{"ray tracing: Embree could not build its acceleration structure; use smaller meshes"};
    }
    if (lower.x <= upper.x) {
        result.lower_ = lower;
        result.upper_ = upper;
        const glm::vec3 extent = glm::max(glm::abs(lower), glm::abs(upper));
        result.step_off_ = 1e-5F * std::max(extent.x, std::max(extent.y, extent.z));
    }
    return result;
}

bool RayScene::intersect(const glm::vec3& origin, const glm::vec3& direction, SurfacePoint& point) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = {origin.x,    origin.y,    origin.z,
                 0.0F,        direction.x, direction.y,
                 direction.z, 0.0F,        std::numeric_limits<float>::infinity(),
                 0xFFFFFFFFU, 0,           0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_scene_.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    const Mesh& mesh = scene_->meshes[query.hit.geomID];
    const glm::uvec3 t = mesh.triangles[query.hit.primID];
    const glm::vec3 corners[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const float weights[3] = {1.0F - query.hit.u - query.hit.v, query.hit.u, query.hit.v};
    point.position = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
    point.distance = query.ray.tfar;
    point.material = mesh.material;
    point.uv = interpolate_uv(mesh, query.hit.primID, query.hit.u, query.hit.v);
    point.colour = interpolate_colour(mesh, query.hit.primID, query.hit.u, query.hit.v);

    const glm::vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float length = glm::length(cross);
    point.geometric_normal = length > 0.0F ? cross / length : -direction;
    point.front_side = glm::dot(point.geometric_normal, direction) < 0.0F;
    if (!point.front_side) point.geometric_normal = -point.geometric_normal;
    if (scene_->materials[static_cast<std::size_t>(mesh.material)].relief >= 0) {
        set_texture_axes(mesh, t, corners, point);
    }
    point.shading_normal = point.geometric_normal;
    point.lifted_position = point.position;
    if (mesh.normals.empty()) return true;

    const glm::vec3 normals[3] = {mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]};
    const glm::vec3 blended = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
    const float blended_length = glm::length(blended);
    if (!(blended_length > 1e-6F)) return true;
    // Some files wind triangles against their normals: the sides follow the winding, the curvature follows the normals.
    const float side = glm::dot(blended, point.geometric_normal) < 0.0F ? -1.0F : 1.0F;
    point.shading_normal = blended * (side / blended_length);
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 normal = normals[i] * side;
        const float below = std::min(0.0F, glm::dot(point.position - corners[i], normal));
        point.lifted_position -= normal * (weights[i] * below);
    }
    return true;
}

bool RayScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{origin.x,    origin.y, origin.z, 0.0F,        direction.x, direction.y,
               direction.z, 0.0F,     distance, 0xFFFFFFFFU, 0,           0};
    rtcOccluded1(embree_scene_.get(), &context, &ray);
    if (ray.tfar >= 0.0F && primitives_) rtcOccluded1(primitives_.get(), &context, &ray);
    return ray.tfar < 0.0F;
}

}  // namespace rs::capture
