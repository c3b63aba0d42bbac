#pragma once
// Row of six rooms connected by doors, with eight objects each, and a walk through all of them.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/camera.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace rs::test {

inline constexpr int kRooms = 6;
inline constexpr int kObjectsInRoom = 8;
inline constexpr double kRoomSide = 6;

inline std::size_t room_at(double z) {
    const double number = std::floor(-z / kRoomSide);
    return static_cast<std::size_t>(std::clamp(number, 0.0, kRooms - 1.0));
}

// Room r extends from z = -r * kRoomSide to the next. `file_of(room, number)` gives the file of an object.
template <class FileOf>
compositor::Scene six_rooms(const FileOf& file_of) {
    using namespace compositor;
    Scene scene;
    const auto add_wall = [&](const glm::dvec3& size, const glm::dvec3& centre, const glm::vec3& colour) {
        GeometryNode wall;
        wall.mesh = std::make_shared<const Mesh>(box_mesh(size));
        wall.material.diffuse = colour;
        wall.material.ambient = 1;
        wall.world_from_node[3] = glm::dvec4(centre, 1);
        scene.geometry.push_back(std::move(wall));
    };
    const double half = kRoomSide / 2;
    for (int r = 0; r < kRooms; ++r) {
        const double front = -r * kRoomSide;
        const glm::vec3 colour(0.5F + 0.08F * static_cast<float>(r), 0.7F, 0.9F - 0.08F * static_cast<float>(r));
        scene.rooms.push_back({"room " + std::to_string(r), {{-half, 0, front - kRoomSide}, {half, 3, front}}});
        for (const double side : {-1.0, 1.0}) {
            add_wall({0.1, 3, kRoomSide}, {side * half, 1.5, front - half}, colour);
            // Wall next to the door to the next room, 1.6 wide.
            add_wall({half - 0.8, 3, 0.1}, {side * (half + 0.8) / 2, 1.5, front - kRoomSide}, colour);
        }
        for (int n = 0; n < kObjectsInRoom; ++n) {
            RaySpaceNode node;
            node.file = file_of(r, n);
            node.room = scene.rooms.size() - 1;
            NodeTransform place;
            place.translation = {n % 2 == 0 ? -1.9 : 1.9, 0.4, front - 0.75 - 1.5 * (n / 2)};
            place.scale = 0.4;
            node.chain = {place};
            scene.objects.push_back(node);
            add_wall({0.6, 0.4, 0.6}, place.translation - glm::dvec3(0, 0.2, 0), {0.6F, 0.6F, 0.6F});
        }
    }
    scene.floor = Floor{};
    return scene;
}

// From the entrance of the first room to the end of the last, looking ahead and slightly from side to side.
inline std::vector<Camera> walk_through(int frames, int width, int height) {
    std::vector<Camera> cameras;
    for (int i = 0; i < frames; ++i) {
        const double t = static_cast<double>(i) / (frames - 1);
        const glm::dvec3 eye(0.2 * std::sin(40 * t), 1.5, -0.5 - t * (kRooms * kRoomSide - 1));
        const glm::dvec3 at = eye + glm::dvec3(0.9 * std::sin(25 * t), -0.25, -1);
        cameras.push_back(look_at_camera(eye, at, radians(60), width, height));
    }
    return cameras;
}

}  // namespace rs::test
