#include "compositor/sequence/sequence.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace rs::compositor {
namespace {

// Inverse of turn_matrix().
glm::dvec3 angles_of(const glm::dmat3& turn) {
    const double sine = std::clamp(-turn[0][2], -1.0, 1.0);
    const double y = std::asin(sine);
    const bool locked = 1 - std::abs(sine) < 1e-12;  // x and z turn about the same axis
    const double x = locked ? std::atan2(-turn[2][1], turn[1][1]) : std::atan2(turn[1][2], turn[2][2]);
    const double z = locked ? 0 : std::atan2(turn[0][1], turn[0][0]);
    return glm::degrees(glm::dvec3(x, y, z));
}

glm::dvec3 interpolate_turn(const glm::dvec3& from_deg, const glm::dvec3& to_deg, double part) {
    if (from_deg == to_deg) return from_deg;
    const glm::dquat from = glm::quat_cast(turn_matrix(from_deg)), to = glm::quat_cast(turn_matrix(to_deg));
    return angles_of(glm::mat3_cast(glm::slerp(from, to, part)));
}

InstancePose interpolate_pose(const InstancePose& from, const InstancePose& to, double part) {
    if (from == to) return from;
    return {from.move + (to.move - from.move) * part, interpolate_turn(from.turn_deg, to.turn_deg, part),
            from.scale + (to.scale - from.scale) * part};
}

SequenceCamera interpolate_camera(const SequenceCamera& from, const SequenceCamera& to, double part) {
    SequenceCamera camera = from;
    camera.pose.eye += (to.pose.eye - from.pose.eye) * part;
    camera.pose.at += (to.pose.at - from.pose.at) * part;
    camera.fov_x_rad += (to.fov_x_rad - from.fov_x_rad) * part;
    return camera;
}

// Equal for slots of the same object.
const void* object_of(const Sequence& sequence, const SequenceSlot& slot) {
    if (slot.object) return &sequence.scene.objects[*slot.object];
    return slot.geometry.empty() ? nullptr : sequence.scene.geometry[slot.geometry.front()].mesh.get();
}

std::map<const void*, int> count_instances(const Sequence& sequence, const SequenceFrame& frame) {
    std::map<const void*, int> counts;
    for (const SlotPose& pose : frame.poses) ++counts[object_of(sequence, sequence.slots[pose.slot])];
    return counts;
}

}  // namespace

SequenceFrame frame_at(const Sequence& sequence, double time) {
    const auto number = static_cast<std::size_t>(time);
    if (number + 1 >= sequence.frames.size()) return sequence.frames.back();
    const double part = time - static_cast<double>(number);
    if (part == 0) return sequence.frames[number];
    SequenceFrame frame = sequence.frames[number];
    const SequenceFrame& next = sequence.frames[number + 1];
    const std::map<const void*, int> shown = count_instances(sequence, frame);
    std::map<const void*, int> shown_next = count_instances(sequence, next);
    std::map<std::uint32_t, const SlotPose*> next_poses;
    for (const SlotPose& pose : next.poses) next_poses[pose.slot] = &pose;
    for (SlotPose& pose : frame.poses) {
        const auto to = next_poses.find(pose.slot);
        const void* const object = object_of(sequence, sequence.slots[pose.slot]);
        if (to == next_poses.end() || shown.at(object) != shown_next[object]) continue;
        if (pose.keeps_position || to->second->keeps_position) continue;
        pose.pose = interpolate_pose(pose.pose, to->second->pose, part);
    }
    const auto camera = camera_of(sequence, number), next_camera = camera_of(sequence, number + 1);
    if (camera && next_camera) frame.camera = interpolate_camera(*camera, *next_camera, part);
    return frame;
}

}  // namespace rs::compositor
