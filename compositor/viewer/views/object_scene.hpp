#pragma once
// Scene of ray-space objects without a scene file: a photographer's table. The objects stand on a neutral ground in
// light from all sides, which casts soft shadows. Pure except for the reading of files; thread-safe.

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::compositor {

/// True for names that end in .rso, in any case.
bool is_object_file(const std::filesystem::path& path);

/// Reads the size of an object: its radius in the units of its capture set, which become scene units; 1 if it is beyond
/// 0.01 .. 100.
Result<double> own_radius(const std::filesystem::path& file);

/// Stands the objects beside each other along X, in their own sizes, as required objects. If their radii are beyond
/// 0.01 .. 100, all are scaled so that the largest is 1. A single object has a viewpoint, "capture", with the distance
/// and the height of its first photo and a field of view at which it fits. The navigation type is EXAMINE. Reads maps
/// and the first photos of each file.
/// \param files at least one
Result<Scene> scene_of_objects(const std::vector<std::string>& files);

}  // namespace rs::compositor
