#pragma once
// Walls of a display, from strict JSON (README.md) or by preset name.

#include "compositor/displays/wall.hpp"
#include "compositor/scene/mesh.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct WallDisplay {
    std::vector<Wall> walls;  // 1..64; each passes check_wall(); names are unique and valid in file names
    Head head;
    std::optional<Head> tracker;  // the tracker's origin: position and heading; default: the head
    double eye_distance_m = 0.065;
    double units_per_metre = 1;
    std::optional<RoomPose> place;  // room pose in the scene; default: the initial viewpoint
    bool fits_scene = false;        // fits the scene to the first wall instead: fit_scene_to_wall()
};

/// Presets: "cave" (front, left and right wall and a floor, 3 m), "power-wall" (4.8 x 2.7 m), "tabletop" (a table of
/// 1.2 x 0.8 m below the scene).
/// \return nullopt for other names.
std::optional<WallDisplay> preset_display(const std::string& name);

/// Files beyond 4 MiB are rejected. Errors name the file and the key.
Result<WallDisplay> read_walls(const std::filesystem::path& path);
Result<WallDisplay> walls_from_json(const std::string& text, const std::filesystem::path& path);

/// {"heads": [{"position": ..., ...}, ...]}: head pose of each of 1..100000 frames. Up to 64 MiB.
Result<std::vector<Head>> read_heads(const std::filesystem::path& path);
Result<std::vector<Head>> heads_from_json(const std::string& text, const std::filesystem::path& path);

/// Keeps only the named walls ("front,left"), in the display's order. Fails for unknown names.
Status select_walls(WallDisplay& display, const std::string& names);

/// Places the scene on the centre of the wall, as large as it allows, with the bottom of its box (not empty) on the
/// wall.
RoomPose fit_scene_to_wall(const Wall& table, const BoundingBox& scene_box);

}  // namespace rs::compositor
