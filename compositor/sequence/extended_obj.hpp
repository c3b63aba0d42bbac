#pragma once
// Extended OBJ: a Wavefront file with two kinds of lines more,
//
//     instance ID dx dy dz rx ry rz sx sy sz MATERIAL
//     camera ex ey ez tx ty tz ANGLE
//
// as simulators of traffic hand scenes over frame by frame. An instance is
// an object of the file scaled, then turned (degrees, about X, then Y, then Z), both about the middle of the object's
// box, and put so that this middle comes to (dx, dy, dz). A camera looks from e to t; ANGLE is its horizontal field of
// view in degrees. Numbers of these lines may end in `f`.
//
// This reads those lines, and checks all others as far as the reader of meshes (scene/model/model_file.hpp) does not
// tell a line: that reader skips what is added here.

#include "compositor/scene/camera_path.hpp"
#include "compositor/scene/transform.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rs::compositor {

// Text of one file, and lines of instances in it, at most: some 30 MB in memory.
inline constexpr std::uint64_t kMaxExtendedObj_bytes = std::uint64_t{64} << 20;
inline constexpr std::size_t kMaxInstances = 100'000;

struct InstancePose {
    glm::dvec3 move{0};      // where the object's middle comes to
    glm::dvec3 turn_deg{0};  // about X, then Y, then Z
    glm::dvec3 scale{1};     // none 0
    bool operator==(const InstancePose&) const = default;
};

// Z * Y * X.
glm::dmat3 turn_matrix(const glm::dvec3& turn_deg);

// Of an object whose box has this middle, in the object's coordinates.
glm::dmat4 instance_matrix(const InstancePose& pose, const glm::dvec3& middle);

struct InstanceLine {
    int line = 0;    // of the file, from 1
    std::string id;  // a number counts objects from 0; else a name, or the file of a ray-space object (.rso)
    InstancePose pose;
    std::string material;  // a number counts materials of the library from 0; or a name; "-" and "-1": the object's own
};

struct SequenceCamera {
    CameraPose pose;
    double fov_x_rad = radians(60);  // full horizontal angle
};

// An `o` of the file, or where there is none before the first face, a `g`, or all that is in it.
struct ObjObject {
    std::string name;
    std::vector<std::string> nodes;  // that the reader of meshes makes of it: itself, and `g`s that come after it
};

struct NamedLine {
    int line = 0;
    std::string name;
};

struct ExtendedObj {
    std::vector<ObjObject> objects;    // with at least one face each, in the order of their first
    std::vector<NamedLine> libraries;  // mtllib
    std::vector<InstanceLine> instances;
    std::optional<SequenceCamera> camera;
    // Of all lines but those that are added: files of the same digest have the same meshes (FNV-1a, 64 bits).
    std::uint64_t mesh_digest = 0;
};

// `shown` names the file in errors: "FILE:LINE: what is wrong; what to do". Pure; thread-safe.
Result<ExtendedObj> parse_extended_obj(std::string_view text, const std::string& shown);

}  // namespace rs::compositor
