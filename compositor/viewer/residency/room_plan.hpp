#pragma once
// From a scene's rooms and the place of its visitor to what is wanted in memory. Pure; thread-safe.
//
// First the objects of no room, then those of the room that the visitor is in, then room by room, the nearest to where
// the visitor will be soon first: so walking towards a door has the room behind it read before it is entered. In a room
// the nearest objects come first.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/residency/load_priority.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace rs::compositor {

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
