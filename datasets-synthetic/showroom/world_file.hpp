#pragma once
// Writes a world as VRML97 with its textures, and the way through it as JSON.

#include "datasets-synthetic/showroom/world.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::synthetic {

// VRML97 with RaySpace nodes, whose files are OBJECTS/NAME.rso, as seen from the world's folder. One shape for each
// look of each room. The same text every time.
std::string vrml_text(const World& world, const std::string& objects);

// {"camera": {"path": [{"eye", "at"} ...], "frames", "closed", "fov_degrees"}}, as scenes in JSON have it.
std::string walk_text(const World& world);

// The folder OUTPUT with NAME.wrl, NAME-walk.json, evening.json with its luminaire and the textures. What stands there
// is replaced only where it is such a folder (StagedFolder).
Status write_world(const World& world, const std::filesystem::path& output, const std::string& name,
                   const std::string& objects);

}  // namespace rs::synthetic
