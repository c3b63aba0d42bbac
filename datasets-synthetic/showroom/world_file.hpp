#pragma once
// Writes a world as VRML97 with its textures, and its camera path as JSON.

#include "datasets-synthetic/showroom/world.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs::synthetic {

// VRML97 with RaySpace nodes for OBJECTS/NAME.rso, relative to the world's folder. One shape per look and room.
// Deterministic.
std::string vrml_text(const World& world, const std::string& objects);

// Camera path: {"camera": {"path": [{"eye", "at"} ...], "frames", "closed", "fov_degrees"}}, as in JSON scenes.
std::string walk_text(const World& world);

// Writes the folder OUTPUT with NAME.wrl, NAME-walk.json, evening.json with its luminaire, and the textures. An
// existing folder is replaced as StagedFolder states.
Status write_world(const World& world, const std::filesystem::path& output, const std::string& name,
                   const std::string& objects, bool force = false);

}  // namespace rs::synthetic
