#pragma once
// Scene reader: JSON (compositor/README.md), VRML and X3D (vrml_file.hpp), glTF 2.0, OBJ and PLY
// (model/model_file.hpp); objects of the command line.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <filesystem>
#include <string>

namespace rs::compositor {

/// Selects the format by extension: .wrl, .wrl.gz, .wrz, .vrml, .x3d, .x3dz, .x3dv, ...; .gltf, .glb, .obj, .ply;
/// .json. Errors about formats of other programs name the format and advise to convert the file. Referenced files are
/// relative to the scene file; .rso files are not opened. Errors name the file and the line or key. Files beyond 64 MiB
/// are rejected.
Result<Scene> read_scene(const std::filesystem::path& path);

/// Reads a JSON scene from text.
/// \param path file name for errors; object files are relative to its folder.
Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& path);

/// Parses an object argument of the command line: FILE.rso[@X,Y,Z[,TURN_DEGREES[,SCALE]]].
/// Places the object at X,Y,Z, or at `otherwise` without a position, rotated about Y and scaled. A text that names an
/// existing file is a path without a position, whatever characters it contains.
Result<RaySpaceNode> parse_object_argument(const std::string& text, const glm::dvec3& otherwise);

}  // namespace rs::compositor
