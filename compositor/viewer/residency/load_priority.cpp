#include "compositor/viewer/residency/load_priority.hpp"

#include <algorithm>
#include <map>

namespace rs::compositor {
namespace {

constexpr double kFarther = 1.25;  // times as far: clearly farther

}  // namespace

bool gives_way(const LoadPriority& held, const LoadPriority& next) {
    if (held.room < next.room) return false;
    if (held.room == next.room) return held.distance > kFarther * next.distance + next.door;
    // A room that was left a moment ago is still near, wherever the visitor is bound for.
    return std::min(std::max(held.room, 0.0), held.room_now) > kFarther * std::max(next.room, 0.0) + next.door;
}

namespace {

// Of a room's longest side: what makes no difference to which is next.
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

std::vector<LoadPriority> RoomPlan::priorities(const VisitorPlace& visitor) const {
    std::vector<LoadPriority> priorities(files_.size());
    std::vector<bool> has_priority(files_.size());
    for (const Node& node : nodes_) {
        LoadPriority priority;
        priority.distance = glm::distance(node.middle, visitor.eye);
        priority.door = door_;
        if (node.room && !rooms_[*node.room].box.empty()) {
            const Place& room = rooms_[*node.room];
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
