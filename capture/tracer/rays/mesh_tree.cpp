#include "capture/tracer/rays/mesh_tree.hpp"

#include "capture/tracer/scene/texture_lookup.hpp"

#include <embree3/rtcore.h>

#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace rs::capture {

// Embree filter function, called for each candidate hit of a geometry with holes.
struct CutoutFilter {
    static void reject_holes(const RTCFilterFunctionNArguments* arguments) {
        const auto& cutout = *static_cast<const MeshTree::Cutout*>(arguments->geometryUserPtr);
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

void ReleaseEmbree::operator()(RTCDeviceTy* device) const {
    rtcReleaseDevice(device);
}
void ReleaseEmbree::operator()(RTCSceneTy* scene) const {
    rtcReleaseScene(scene);
}

Result<MeshTree> MeshTree::build(RTCDeviceTy* device, const std::vector<Mesh>& meshes, const Scene& scene) {
    MeshTree tree;
    tree.embree_.reset(rtcNewScene(device));
    rtcSetSceneFlags(tree.embree_.get(),
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneBuildQuality(tree.embree_.get(), RTC_BUILD_QUALITY_HIGH);
    glm::vec3 lower(std::numeric_limits<float>::infinity());
    glm::vec3 upper(-std::numeric_limits<float>::infinity());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Mesh& mesh = meshes[m];
        if (mesh.triangles.empty()) continue;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Copied into Embree's buffers, which have the padding required by its vector loads.
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
            tree.cutouts_.push_back(
                std::make_unique<Cutout>(Cutout{&mesh, &scene.textures[static_cast<std::size_t>(texture)]}));
            rtcSetGeometryUserData(geometry, tree.cutouts_.back().get());
            rtcSetGeometryIntersectFilterFunction(geometry, CutoutFilter::reject_holes);
            rtcSetGeometryOccludedFilterFunction(geometry, CutoutFilter::reject_holes);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(tree.embree_.get(), geometry, static_cast<unsigned>(m));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(tree.embree_.get());
    if (lower.x <= upper.x) {
        tree.lower_ = lower;
        tree.upper_ = upper;
    }
    return tree;
}

}  // namespace rs::capture
