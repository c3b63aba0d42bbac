#pragma once
// A sequence of frames of one world: what stands still, once, and where everything that moves is, frame by frame.
//
//     frames.json -> base scene ----------------------------> Scene: static nodes, placed once
//                 -> models, frames' meshes -> model library -> Scene: one set of nodes for each instance that is ever
//                 -> frames' instance lines -> slots, poses      shown at the same time (a slot); a frame moves slots
//
// Instances of the same object and material take that object's slots in the order of their lines; slots that a frame
// does not need are hidden in it. So meshes, buffers and trees are made once, whatever the number of frames.

#include "compositor/scene/scene.hpp"
#include "compositor/scene/weather.hpp"
#include "compositor/sequence/extended_obj.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rs::compositor {

// Lines of instances in all frames together, at most: some 90 MB.
inline constexpr std::size_t kMaxPoses = 1'000'000;

struct SequenceSlot {
    std::vector<std::size_t> geometry;  // of Scene::geometry, all of the slot's number (GeometryNode::moving)
    glm::dvec3 middle{0};               // of the object's box
    std::optional<std::size_t> object;  // of Scene::objects, in place of geometry
};

struct SlotPose {
    std::uint32_t slot = 0;
    bool in_place = false;  // where the object stands in its file, without a pose
    InstancePose pose;
};

struct SequenceFrame {
    std::vector<SlotPose> poses;
    std::optional<SequenceCamera> camera;
};

struct Sequence {
    std::string name;  // of its map
    Scene scene;       // lit by Phong's formula; what moves is where its model has it
    std::vector<SequenceSlot> slots;
    std::vector<SequenceFrame> frames;     // at least one
    std::optional<SequenceCamera> camera;  // the base's, for frames without one
    double frames_per_second = 25;
    std::optional<Weather> weather;  // that the files request; the scene is not in it yet
};

// Errors name file, line and remedy. Reads every file; a second or so for some hundred frames.
Result<Sequence> read_sequence(const std::filesystem::path& folder);

// Where a frame has everything that moves; nothing: nowhere. Of geometry the matrix that comes before the nodes' own.
struct MovedSlots {
    std::vector<std::optional<glm::dmat4>> geometry;                             // [slot]
    std::vector<std::pair<std::size_t, std::optional<TransformChain>>> objects;  // of Scene::objects
};
MovedSlots moved_slots(const Sequence& sequence, std::size_t frame);

// Of a frame, or the base's; nothing where neither has one.
std::optional<SequenceCamera> camera_of(const Sequence& sequence, std::size_t frame);

// The scene with everything that moves where a frame has it, and without what it does not show.
Scene scene_at(const Sequence& sequence, std::size_t frame);

}  // namespace rs::compositor
