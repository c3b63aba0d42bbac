#pragma once
// Reader of VRML and X3D files, plain or gzip, independent of their extension: VRML97, X3D in XML and classic encoding
// (scene/vrml/graph.hpp lists the supported parts), VRML 1.0 (scene/vrml1/graph.hpp).
//
// In addition to VRML97's nodes there is one for image-based objects and one for rooms, whose objects are in memory
// while a visitor is inside or near (viewer/residency/load_priority.hpp):
//
//     RaySpace {
//         exposedField MFString url          []     # the .rso file; the first counts
//         exposedField SFFloat  size         1      # object radius in node units, > 0
//         exposedField SFBool   standing     TRUE   # foot at the origin; else the centre of its capture
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

/// Referenced files (textures, Inline) are relative to the file that refers to them; only local files are read. .rso
/// files are not opened. Unsupported parts become warnings of the scene; syntax errors are errors with their line.
/// Worlds beyond 64 MiB, or 256 MiB with all included files, are rejected. Thread-safe.
Result<Scene> read_vrml(const std::filesystem::path& path);

/// Reads a world from uncompressed text.
/// \param path file name for messages; referenced files are relative to its folder.
Result<Scene> scene_from_vrml(std::string_view text, const std::filesystem::path& path);

}  // namespace rs::compositor
