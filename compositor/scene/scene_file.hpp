#pragma once
// Scenes from JSON. The format is described in compositor/README.md.

#include "compositor/scene/scene.hpp"
#include "rayspace/result.hpp"

#include <filesystem>
#include <string>

namespace rs::compositor {

// Object files are looked for beside the scene file; none is opened here. Errors name the file and the key. Files
// beyond 64 MiB are refused.
Result<Scene> read_scene(const std::filesystem::path& path);

// The text of a scene file; `path` names it in errors, and its folder is where object files are.
Result<Scene> scene_from_json(const std::string& text, const std::filesystem::path& path);

}  // namespace rs::compositor
