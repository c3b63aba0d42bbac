#pragma once
// Extended OBJ: a Wavefront file with two additional statements,
//
//     instance ID dx dy dz rx ry rz sx sy sz MATERIAL
//     camera ex ey ez tx ty tz ANGLE
//
// as written by traffic simulators, one file per frame. An instance is an object of the file, scaled, then rotated
// (degrees, about X, then Y, then Z), both about the centre of the object's box, and translated so that the centre is
// at (dx, dy, dz). A camera looks from e to t; ANGLE is its horizontal field of view in degrees. Numbers of these
// statements may end in `f`.
//
// Parses these statements and validates the others to the extent that the mesh reader (scene/model/model_file.hpp),
// which skips the additional ones, does not report line numbers.

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

/// Limits of one file: text size and number of instance lines; about 30 MB in memory.
inline constexpr std::uint64_t kMaxExtendedObj_bytes = std::uint64_t{64} << 20;
inline constexpr std::size_t kMaxInstances = 100'000;

struct InstancePose {
    glm::dvec3 move{0};      // position of the object's centre
    glm::dvec3 turn_deg{0};  // about X, then Y, then Z
    glm::dvec3 scale{1};     // no component is 0
    bool operator==(const InstancePose&) const = default;
};

/// Rz * Ry * Rx.
glm::dmat3 turn_matrix(const glm::dvec3& turn_deg);

/// Transform of an object whose box has this centre, in the object's coordinates.
glm::dmat4 instance_matrix(const InstancePose& pose, const glm::dvec3& middle);

struct InstanceLine {
    int line = 0;    // in the file, from 1
    std::string id;  // index of an object from 0; otherwise a name, or the file of a ray-space object (.rso)
    InstancePose pose;
    std::string material;  // index of a material of the library from 0, or a name; "-" and "-1": the object's own
};

struct SequenceCamera {
    CameraPose pose;
    double fov_x_rad = radians(60);  // full horizontal angle
};

/// An `o` of the file; without one before the first face a `g`, or the whole file.
struct ObjObject {
    std::string name;
    std::vector<std::string> nodes;  // nodes that the mesh reader creates for it: its own, and those of subsequent `g`s
};

struct NamedLine {
    int line = 0;
    std::string name;
};

struct ExtendedObj {
    std::vector<ObjObject> objects;    // with at least one face, in order of their first face
    std::vector<NamedLine> libraries;  // mtllib
    std::vector<InstanceLine> instances;
    std::optional<SequenceCamera> camera;
    /// FNV-1a (64 bits) of all other lines: files with the same digest have the same meshes.
    std::uint64_t mesh_digest = 0;
};

/// \param shown file name for errors: "FILE:LINE: what is wrong; what to do". Pure; thread-safe.
Result<ExtendedObj> parse_extended_obj(std::string_view text, const std::string& shown);

}  // namespace rs::compositor
