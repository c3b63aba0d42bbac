#pragma once
// Sequence of frames: a static scene, and the transforms of its moving parts in every frame.
//
//     frames.json -> base scene ----------------------------> Scene: static nodes
//                 -> models, meshes of frames -> model library -> Scene: a set of nodes (slot) per instance of an
//                 object
//                 -> instance lines of frames -> slots, poses     visible at the same time; a frame moves slots
//
// Instances of the same object and material use its slots in the order of their lines; slots that a frame does not need
// are hidden. So meshes, buffers and acceleration structures are built once for all frames.

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

/// Maximum number of instance lines in all frames: about 90 MB.
inline constexpr std::size_t kMaxPoses = 1'000'000;

struct SequenceSlot {
    std::vector<std::size_t>
        geometry;          // indices into Scene::geometry; all have the slot's index as GeometryNode::moving
    glm::dvec3 middle{0};  // centre of the object's box
    std::optional<std::size_t> object;  // index into Scene::objects, instead of geometry
};

struct SlotPose {
    std::uint32_t slot = 0;
    bool keeps_position = false;  // original position in the object's file, without a pose
    InstancePose pose;
};

struct SequenceFrame {
    std::vector<SlotPose> poses;
    std::optional<SequenceCamera> camera;
};

struct Sequence {
    std::string name;  // name of its map
    Scene scene;       // with Phong shading; moving parts at their positions in the models
    std::vector<SequenceSlot> slots;
    std::vector<SequenceFrame> frames;     // at least one
    std::optional<SequenceCamera> camera;  // camera of the base scene, for frames without one
    double frames_per_second = 25;
    std::optional<Weather> weather;  // weather of the files; not applied to the scene yet
};

/// Errors name file, line and remedy. Reads every file: about a second for some hundred frames.
Result<Sequence> read_sequence(const std::filesystem::path& folder);

/// Frame at a time between two frames, for motion blur (frame_interpolation.cpp). Positions, scales and fields of view
/// are interpolated linearly, rotations by slerp (K. Shoemake, Animating Rotation with Quaternion Curves, 1985). Equal
/// poses stay bit for bit. Instances correspond by the order of their lines; if the two frames show different numbers
/// of an object, all instances of it keep the earlier frame's poses. \param time in frames, >= 0; after the last frame
/// the last one is held
SequenceFrame frame_at(const Sequence& sequence, double time);

/// Transforms of all moving parts in a frame; nullopt: hidden. Geometry matrices apply before the nodes' own.
struct SlotTransforms {
    std::vector<std::optional<glm::dmat4>> geometry;                             // [slot]
    std::vector<std::pair<std::size_t, std::optional<TransformChain>>> objects;  // indices into Scene::objects
};
SlotTransforms slot_transforms(const Sequence& sequence, const SequenceFrame& frame);
SlotTransforms slot_transforms(const Sequence& sequence, std::size_t frame);

/// Camera of the frame, else of the base scene, else nullopt.
std::optional<SequenceCamera> camera_of(const Sequence& sequence, std::size_t frame);

/// Scene with all moving parts transformed for a frame; hidden parts are removed.
Scene scene_at(const Sequence& sequence, std::size_t frame);
/// The same of `scene`: the sequence's scene with other lights or weather.
Scene scene_at(Scene scene, const Sequence& sequence, std::size_t frame);

}  // namespace rs::compositor
