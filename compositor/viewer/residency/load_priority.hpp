#pragma once
// The load priority of objects. Pure; thread-safe.

#include "compositor/scene/scene.hpp"

#include <glm/glm.hpp>

#include <compare>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace rs::compositor {

// What comes first into memory: the lesser value. First its room counts, then its own distance; scene units.
struct LoadPriority {
    static constexpr double kAlways = -2;  // belongs to no room
    static constexpr double kHere = -1;    // the visitor is in its room
    double room = kAlways;                 // one of these, or how far its room is from where the visitor will be soon
    double distance = 0;
    double door = 0.5;  // what does not count as a difference of distances: a step or so
    double room_now = std::numeric_limits<double>::infinity();  // how far its room is from where the visitor is
    auto operator<=>(const LoadPriority&) const = default;
};
// Whether something that is in memory has to make room for something that is not: only where its priority is clearly
// lower, so that a visitor at a door does not make two rooms take turns.
bool gives_way(const LoadPriority& held, const LoadPriority& next);

// From a scene's rooms and the place of its visitor to load priorities. Pure; thread-safe.
//
// First the objects of no room, then those of the room that the visitor is in, then room by room, the nearest to where
// the visitor will be soon first: so walking towards a door has the room behind it read before it is entered. In a room
// the nearest objects come first.

struct VisitorPlace {
    glm::dvec3 eye{0};
    glm::dvec3 soon{0};  // where the eye will be in a moment
};

class RoomPlan {
public:
    explicit RoomPlan(const Scene& scene);

    // Each file of the scene's objects once.
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
    [[nodiscard]] std::size_t file_of_node(std::size_t node) const { return nodes_[node].file; }

    // [file]
    [[nodiscard]] std::vector<LoadPriority> priorities(const VisitorPlace& visitor) const;

private:
    struct Node {
        std::size_t file = 0;
        std::optional<std::size_t> room;
        glm::dvec3 middle{0};
    };
    struct Place {
        BoundingBox box;
        double door = 0;  // LoadPriority::door
    };
    std::vector<std::filesystem::path> files_;
    std::vector<Node> nodes_;
    std::vector<Place> rooms_;
    double door_ = 0;  // of objects without a room
};

}  // namespace rs::compositor
