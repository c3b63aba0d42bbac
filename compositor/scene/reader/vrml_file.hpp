#pragma once
// Scenes from VRML and X3D files, plain or gzip, whatever their names are: VRML97, X3D in its XML and its classic
// encoding (scene/vrml/graph.hpp states what is read and what is left out), VRML 1.0 (scene/vrml1/graph.hpp).
//
// Besides the nodes of VRML97 there are one for objects made of images and one for rooms, whose objects are in memory
// while a visitor is in them or near (viewer/residency/load_priority.hpp):
//
//     RaySpace {
//         exposedField MFString url          []     # the .rso file; the first counts
//         exposedField SFFloat  size         1      # the object's radius in the units of the node, above 0
//         exposedField SFBool   standing     TRUE   # its foot stands at the origin; else the middle of its capture
//         exposedField SFString description  ""
//     }
//     RaySpaceRoom {
//         exposedField MFNode   children     []
//         exposedField SFString description  ""
//         field        SFVec3f  bboxCenter   0 0 0
//         field        SFVec3f  bboxSize     -1 -1 -1   # -1: of what it holds
//     }

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string_view>

namespace rs::compositor {

// Files that the world names (textures, Inline) are looked for beside the file that names them, on this machine only.
// No .rso is opened. What cannot be shown becomes a warning of the scene; what cannot be read is an error, with its
// line. Worlds beyond 64 MiB, all included files together beyond 256 MiB, are refused. Thread-safe.
Result<Scene> read_vrml(const std::filesystem::path& path);

// The text of a world without gzip; `path` names it in messages, and its folder is where it looks for files.
Result<Scene> scene_from_vrml(std::string_view text, const std::filesystem::path& path);

}  // namespace rs::compositor
