#pragma once
// Sequence created in memory, for tests of players and windows.

#include "compositor/sequence/sequence.hpp"

#include <cmath>
#include <cstdint>
#include <memory>

namespace rs::test {

// Ground with a wall, and boxes that move in every frame; the last is hidden in the second frame.
inline std::shared_ptr<const compositor::Sequence> moving_boxes(int count, int frames) {
    using namespace compositor;
    auto sequence = std::make_shared<Sequence>();
    Scene& scene = sequence->scene;
    scene.shading = Shading::kPhong;
    const auto box = std::make_shared<const Mesh>(box_mesh({1, 1, 1}));
    const auto still = [&](const glm::dvec3& size, const glm::dvec3& middle) {
        GeometryNode node;
        node.mesh = std::make_shared<const Mesh>(box_mesh(size));
        node.world_from_node[3] = glm::dvec4(middle, 1);
        scene.geometry.push_back(node);
    };
    still({40, 0.1, 40}, {0, -0.05, 0});
    still({40, 8, 0.1}, {0, 4, -8});
    Light lamp;
    lamp.kind = LightKind::kSpot;
    lamp.location = {2, 4, 0};
    lamp.towards = {0, -1, 0};
    lamp.cut_off_rad = lamp.beam_width_rad = radians(50);
    lamp.radius = 6;
    scene.lights.push_back(lamp);
    for (int i = 0; i < count; ++i) {
        GeometryNode node;
        node.mesh = box;
        node.material.diffuse = {0.8F, 0.1F * static_cast<float>(i % 10), 0.2F};
        node.moving = static_cast<std::uint32_t>(i);
        sequence->slots.push_back({{scene.geometry.size()}, glm::dvec3(0), {}});
        scene.geometry.push_back(node);
    }
    for (int f = 0; f < frames; ++f) {
        SequenceFrame frame;
        for (int i = 0; i < count; ++i) {
            if (f == 1 && i == count - 1) continue;
            const double angle = 0.7 * i + 0.2 * f;
            InstancePose pose;
            pose.move = {5 * std::cos(angle), 0.5, 4 * std::sin(angle)};
            pose.turn_deg = {0, 20.0 * f, 0};
            frame.poses.push_back({static_cast<std::uint32_t>(i), false, pose});
        }
        frame.camera = SequenceCamera{{{0, 3, 12}, {0.1 * f, 1, 0}}, radians(60)};
        sequence->frames.push_back(frame);
    }
    return sequence;
}

}  // namespace rs::test
