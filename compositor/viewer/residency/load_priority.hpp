#pragma once
// Load priorities of objects. Pure; thread-safe.

#include "compositor/scene/scene.hpp"

#include <glm/glm.hpp>

#include <compare>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace rs::compositor {

/// Load priority; lesser values load first. Compares the room, then the object's own distance. Scene units.
struct LoadPriority {
    static constexpr double kAlways = -2;  // not in any room
    static constexpr double kHere = -1;    // in the visitor's room
    double room = kAlways;                 // one of these, or distance from the room to the predicted eye position
    double distance = 0;
    double door = 0.5;                                          // tolerance when distances are compared: about a step
    double room_now = std::numeric_limits<double>::infinity();  // distance from the room to the current eye position
    auto operator<=>(const LoadPriority&) const = default;
};
/// True if an object in memory may be evicted for one that is not: its priority must be clearly lower, so that a
/// visitor at a door does not make two rooms alternate.
bool is_evictable_for(const LoadPriority& held, const LoadPriority& next);

// Load priorities from the scene's rooms and the visitor's position. Pure; thread-safe.
//
// Objects outside of all rooms come first, then those of the visitor's room, then room by room by distance from the
// predicted position: the room behind a door is loaded while the visitor walks towards it. Within a room, nearer
// objects come first.

struct VisitorPosition {
    glm::dvec3 eye{0};
    glm::dvec3 soon{0};  // predicted eye position
};

class RoomPlan {
public:
    explicit RoomPlan(const Scene& scene);

    /// Distinct files of the scene's objects.
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
    [[nodiscard]] std::size_t file_of_node(std::size_t node) const { return nodes_[node].file; }

    /// Priorities by file index.
    [[nodiscard]] std::vector<LoadPriority> priorities(const VisitorPosition& visitor) const;

private:
    struct Node {
        std::size_t file = 0;
        std::optional<std::size_t> room;
        glm::dvec3 middle{0};
    };
    struct RoomEntry {
        BoundingBox box;
        double door = 0;  // LoadPriority::door
    };
    std::vector<std::filesystem::path> files_;
    std::vector<Node> nodes_;
    std::vector<RoomEntry> rooms_;
    double door_ = 0;  // LoadPriority::door of objects without a room
};

}  // namespace rs::compositor
