#pragma once
// Writes a world as VRML97 with its textures, its camera path as JSON, and its evening lighting: a procedural luminaire
// as an IES file, and a light list that places it at ceilings and in lamps (compositor/traced/README.md).

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

inline constexpr const char* kDownlightFile = "downlight.ies";

// LM-63-2002 file: round opening, 560 lumens, intensity proportional to the 1.5th power of the cosine.
std::string downlight_ies();

// Light list that replaces the world's own lights: rows of luminaires about 2 m apart, and one in each point light.
std::string evening_lights(const World& world);

// Writes the folder OUTPUT with NAME.wrl, NAME-walk.json, evening.json with its luminaire, and the textures. An
// existing folder is replaced as StagedFolder states.
Status write_world(const World& world, const std::filesystem::path& output, const std::string& name,
                   const std::string& objects, bool force = false);

}  // namespace rs::synthetic
