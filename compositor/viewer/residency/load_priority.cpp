#include "compositor/viewer/residency/load_priority.hpp"

#include <algorithm>
#include <map>

namespace rs::compositor {
namespace {

constexpr double kClearlyFarther = 1.25;  // ratio of distances from which one is clearly farther

}  // namespace

bool is_evictable_for(const LoadPriority& held, const LoadPriority& next) {
    if (held.room < next.room) return false;
    if (held.room == next.room) return held.distance > kClearlyFarther * next.distance + next.door;
    // A room left a moment ago is still near, whatever the predicted position.
    return std::min(std::max(held.room, 0.0), held.room_now) > kClearlyFarther * std::max(next.room, 0.0) + next.door;
}

namespace {

// LoadPriority::door as a fraction of the room's longest side.
constexpr double kDoorOfRoom = 0.05;

double distance_to(const BoundingBox& box, const glm::dvec3& point) {
    return glm::length(point - glm::clamp(point, box.lowest, box.highest));
}

double longest_side(const BoundingBox& box) {
    const glm::dvec3 sides = box.highest - box.lowest;
    return std::max({sides.x, sides.y, sides.z});
}

}  // namespace

RoomPlan::RoomPlan(const Scene& scene) {
    std::map<std::filesystem::path, std::size_t> known;
    for (const RaySpaceNode& node : scene.objects) {
        const auto [found, is_new] = known.try_emplace(node.file, files_.size());
        if (is_new) files_.push_back(node.file);
        const Similarity place = world_from_node(node.chain);
        nodes_.push_back({found->second, node.room, place.translation});
        door_ = std::max(door_, 0.5 * place.scale);
    }
    for (const Room& room : scene.rooms) {
        rooms_.push_back({room.box, room.box.empty() ? 0 : kDoorOfRoom * longest_side(room.box)});
    }
}

std::vector<LoadPriority> RoomPlan::priorities(const VisitorPosition& visitor) const {
    std::vector<LoadPriority> priorities(files_.size());
    std::vector<bool> has_priority(files_.size());
    for (const Node& node : nodes_) {
        LoadPriority priority;
        priority.distance = glm::distance(node.middle, visitor.eye);
        priority.door = door_;
        if (node.room && !rooms_[*node.room].box.empty()) {
            const RoomEntry& room = rooms_[*node.room];
            priority.door = room.door;
            priority.room_now = distance_to(room.box, visitor.eye);
            priority.room = priority.room_now > 0 ? distance_to(room.box, visitor.soon) : LoadPriority::kHere;
        }
        if (!has_priority[node.file] || priority < priorities[node.file]) priorities[node.file] = priority;
        has_priority[node.file] = true;
    }
    return priorities;
}

}  // namespace rs::compositor
