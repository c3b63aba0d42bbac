#pragma once
// Reads SCENE arguments: a mesh file, or a recipe (.json) with object, materials, camera, lights, environment, room.
// The recipe's schema is in capture/README.md.

#include "capture/tracer/scene/recipe_parts.hpp"
#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rs::capture {

struct SceneFile {
    Scene scene;               // normalised: centred (normalise_meshes()), farthest vertex at distance 1
    double object_radius = 1;  // the largest distance of a vertex from the Y axis
    double ground_height = 0;  // Y of the lowest vertex
    CameraRecipe camera;
    std::optional<ToonStyle> toon;  // set for toon rendering
    std::uint64_t seed = 1;
};

// Generates the procedural object `name`. Errors need not name the recipe.
using Generator =
    std::function<Result<Scene>(const std::string& name, const nlohmann::json& parameters, std::uint64_t seed)>;

/// Loads a scene. A mesh file gets the default studio and camera. Lights and environment of a recipe replace those of
/// the generator; a scene without either gets the default studio.
/// \return an error with the file and the key
Result<SceneFile> load_scene_file(const std::filesystem::path& path, const Generator& generator);

}  // namespace rs::capture
