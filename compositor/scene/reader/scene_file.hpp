#pragma once
// Scenes from files: JSON (compositor/README.md), VRML and X3D (vrml_file.hpp), glTF 2.0 and OBJ
// (model/model_file.hpp).

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::compositor {

// By the file's name: .wrl, .wrl.gz, .wrz, .vrml, .x3d, .x3dz, .x3dv, ...; .gltf, .glb, .obj; .json. Files that the
// scene names are looked for beside it; no .rso is opened here. Errors name the file and the line or key. Files beyond
// 64 MiB are refused.
Result<Scene> read_scene(const std::filesystem::path& path);

// The text of a JSON scene; `path` names it in errors, and its folder is where object files are.
Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& path);

}  // namespace rs::compositor
