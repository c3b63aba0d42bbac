#include "capture/tracer/rays/instance_tree.hpp"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/gtc/type_ptr.hpp>

#include <limits>
#include <utility>

namespace rs::capture {

namespace {

glm::mat3 normal_matrix(const glm::dmat4& world_from_part) {
    return glm::mat3(glm::transpose(glm::inverse(glm::dmat3(world_from_part))));
}

}  // namespace

Result<InstanceTree> InstanceTree::build(RTCDeviceTy* device, const Scene& scene) {
    InstanceTree tree_set;
    tree_set.scene_ = &scene;
    for (const Part& part : scene.parts) {
        RS_ASSIGN_OR_RETURN(MeshTree tree, MeshTree::build(device, part.meshes, scene));
        tree_set.trees_.push_back(std::move(tree));
    }
    tree_set.top_.reset(rtcNewScene(device));
    rtcSetSceneFlags(tree_set.top_.get(),
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    tree_set.placements_.resize(scene.instances.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const MeshTree& tree = tree_set.trees_[scene.instances[i].part];
        if (tree.empty()) continue;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, tree.embree());
        rtcAttachGeometryByID(tree_set.top_.get(), geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
        tree_set.place(i);
    }
    tree_set.commit();
    return tree_set;
}

void InstanceTree::place(std::size_t instance) {
    const Instance& from = scene_->instances[instance];
    const MeshTree& tree = trees_[from.part];
    if (tree.empty()) return;
    Placement& to = placements_[instance];
    blurred_ += static_cast<int>(from.at_close.has_value()) - static_cast<int>(to.blurred);
    to.blurred = from.at_close.has_value();
    to.open = glm::mat4(from.world_from_part);
    to.close = glm::mat4(from.at_close.value_or(from.world_from_part));
    to.normals = normal_matrix(from.world_from_part);
    to.lower = glm::vec3(std::numeric_limits<float>::infinity());
    to.upper = -to.lower;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec4 p((corner & 1U) != 0 ? tree.upper().x : tree.lower().x,
                          (corner & 2U) != 0 ? tree.upper().y : tree.lower().y,
                          (corner & 4U) != 0 ? tree.upper().z : tree.lower().z, 1.0F);
        for (const glm::mat4& at : {to.open, to.close}) {
            to.lower = glm::min(to.lower, glm::vec3(at * p));
            to.upper = glm::max(to.upper, glm::vec3(at * p));
        }
    }
    RTCGeometry geometry = rtcGetGeometry(top_.get(), static_cast<unsigned>(instance));
    rtcSetGeometryTimeStepCount(geometry, to.blurred ? 2 : 1);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, glm::value_ptr(to.open));
    if (to.blurred) {
        rtcSetGeometryTransform(geometry, 1, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, glm::value_ptr(to.close));
    }
    rtcCommitGeometry(geometry);
}

void InstanceTree::commit() {
    // One thread, so that the tree does not depend on the number of threads (ray_scene.cpp).
    tbb::task_arena one_thread(1);
    one_thread.execute([&] { rtcCommitScene(top_.get()); });
    ++top_builds_;
    glm::vec3 lower(std::numeric_limits<float>::infinity());
    glm::vec3 upper = -lower;
    for (const Placement& placement : placements_) {
        if (placement.lower.x > placement.upper.x) continue;
        lower = glm::min(lower, placement.lower);
        upper = glm::max(upper, placement.upper);
    }
    if (lower.x <= upper.x) {
        lower_ = lower;
        upper_ = upper;
    }
}

void InstanceTree::update(std::span<const std::size_t> moved) {
    for (const std::size_t instance : moved) place(instance);
    if (!moved.empty()) commit();
}

InstanceTransform InstanceTree::transform_at(std::size_t instance, float time) const {
    const Placement& placement = placements_[instance];
    if (!placement.blurred) return {placement.open, placement.normals};
    const glm::mat4 at = placement.open * (1.0F - time) + placement.close * time;
    return {at, normal_matrix(glm::dmat4(at))};
}

}  // namespace rs::capture
