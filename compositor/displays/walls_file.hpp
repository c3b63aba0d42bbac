#pragma once
// The walls of a display, from JSON that must be exactly as documented (README.md), or by the name of
// a preset.

#include "compositor/displays/wall.hpp"
#include "compositor/scene/mesh.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct WallDisplay {
    std::vector<Wall> walls;  // 1..64, each passes check_wall(); names differ and are fit for files
    Head head;
    std::optional<Head> tracker;  // its zero, of which position and heading count; else the head
    double eye_distance_m = 0.065;
    double units_per_metre = 1;
    std::optional<RoomPlace> place;  // in the scene; else where a visitor would begin
    bool fits_scene = false;         // in place of both: fitted_place()
};

// "cave": a front, a left and a right wall and a floor of 3 m; "power-wall": one of 4.8 x 2.7 m; "tabletop": a table of
// 1.2 x 0.8 m that the scene stands on. Nothing where there is no such preset.
std::optional<WallDisplay> preset_display(const std::string& name);

// A file beyond 4 MiB is refused. Errors name the file and the key.
Result<WallDisplay> read_walls(const std::filesystem::path& path);
Result<WallDisplay> walls_from_json(const std::string& text, const std::filesystem::path& path);

// {"heads": [{"position": ..., ...}, ...]}: where the head is in each of 1..100000 frames. Up to 64 MiB.
Result<std::vector<Head>> read_heads(const std::filesystem::path& path);
Result<std::vector<Head>> heads_from_json(const std::string& text, const std::filesystem::path& path);

// Only walls of these names, in the order of the display; "front,left". Fails at a name that no wall has.
Status keep_walls(WallDisplay& display, const std::string& names);

// The scene stands on the middle of the first wall, as large as the wall allows: the lower side of its box, which is
// not empty, there.
RoomPlace fitted_place(const Wall& table, const BoundingBox& scene_box);

}  // namespace rs::compositor
