#include "compositor/sequence/sequence.hpp"

#include <algorithm>

namespace rs::compositor {
namespace {

// Ray-space objects are rotated and scaled uniformly: the reader has checked that the scales are equal.
TransformChain chain_of(const InstancePose& pose) {
    NodeTransform transform = NodeTransform::of(turn_matrix(pose.turn_deg), pose.scale.x);
    transform.translation = pose.move;
    return {transform};
}

}  // namespace

SlotTransforms slot_transforms(const Sequence& sequence, std::size_t frame) {
    return slot_transforms(sequence, sequence.frames[frame]);
}

SlotTransforms slot_transforms(const Sequence& sequence, const SequenceFrame& frame) {
    SlotTransforms moved;
    moved.geometry.resize(sequence.slots.size());
    std::vector<bool> shown(sequence.slots.size());
    for (const SlotPose& pose : frame.poses) {
        const SequenceSlot& slot = sequence.slots[pose.slot];
        shown[pose.slot] = true;
        if (slot.object) moved.objects.emplace_back(*slot.object, chain_of(pose.pose));
        moved.geometry[pose.slot] = pose.keeps_position ? glm::dmat4(1.0) : instance_matrix(pose.pose, slot.middle);
    }
    for (std::size_t i = 0; i < sequence.slots.size(); ++i) {
        if (!shown[i] && sequence.slots[i].object) moved.objects.emplace_back(*sequence.slots[i].object, std::nullopt);
    }
    return moved;
}

std::optional<SequenceCamera> camera_of(const Sequence& sequence, std::size_t frame) {
    return sequence.frames[frame].camera ? sequence.frames[frame].camera : sequence.camera;
}

Scene scene_at(const Sequence& sequence, std::size_t frame) {
    return scene_at(sequence.scene, sequence, frame);
}

Scene scene_at(Scene scene, const Sequence& sequence, std::size_t frame) {
    const SlotTransforms moved = slot_transforms(sequence, frame);
    std::vector<bool> hidden_objects(scene.objects.size());
    for (const auto& [node, chain] : moved.objects) {
        hidden_objects[node] = !chain;
        if (chain) scene.objects[node].chain = *chain;
    }
    std::erase_if(scene.geometry,
                  [&](const GeometryNode& node) { return node.moving && !moved.geometry[*node.moving]; });
    for (GeometryNode& node : scene.geometry) {
        if (node.moving) node.world_from_node = *moved.geometry[*node.moving] * node.world_from_node;
    }
    std::size_t i = 0;
    std::erase_if(scene.objects, [&](const RaySpaceNode&) { return hidden_objects[i++]; });
    return scene;
}

}  // namespace rs::compositor
