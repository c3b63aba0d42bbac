#include "compositor/displays/walls_file.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rs::compositor {
namespace {

constexpr std::uint64_t kMaxWallsFile_bytes = std::uint64_t{4} << 20;
constexpr std::uint64_t kMaxHeadsFile_bytes = std::uint64_t{64} << 20;
constexpr std::size_t kMaxWalls = 64;
constexpr std::size_t kMaxHeads = 100000;
constexpr double kMaxWallCoordinate_m = 1e4;
constexpr double kMaxRoomPosition = 1e6;  // scene units
constexpr double kMaxTurn_deg = 36000;
constexpr double kFitRatio = 0.8;  // fraction of the table's shorter side

double angle(JsonObject& object, const char* key) {
    return object.has(key) ? radians(object.take(key).number(-kMaxTurn_deg, kMaxTurn_deg)) : 0;
}

glm::dvec3 corner(JsonObject& object, const char* key) {
    return object.take(key).triple(-kMaxWallCoordinate_m, kMaxWallCoordinate_m);
}

// Valid in a file name: letters, digits, '-', '_', '.'; no leading '-' or '.'.
bool is_file_name(const std::string& name) {
    return name.size() <= 64 && name.front() != '.' && name.front() != '-' &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                      c == '_' || c == '.';
           });
}

Wall take_wall(JsonObject object) {
    Wall wall;
    const JsonValue name = object.take("name");
    wall.name = name.text();
    if (!is_file_name(wall.name)) {
        throw name.wrong(
            "names files: it must have 1 to 64 letters, digits, '-', '_' and '.', and begin with a letter "
            "or digit");
    }
    wall.lower_left = corner(object, "lower_left");
    wall.lower_right = corner(object, "lower_right");
    wall.upper_left = corner(object, "upper_left");
    const JsonValue pixels = object.take("pixels");
    pixels.list_size(2, 2);
    wall.width = pixels.item(0).whole_number(1, kMaxImageSide_px);
    wall.height = pixels.item(1).whole_number(1, kMaxImageSide_px);
    object.expect_no_unknown_keys();
    if (const Status fine = check_wall(wall); !fine) throw object.wrong(fine.error().message);
    return wall;
}

Head take_head(JsonObject object) {
    Head head;
    head.position = corner(object, "position");
    head.heading_rad = angle(object, "heading_deg");
    head.pitch_rad = angle(object, "pitch_deg");
    head.roll_rad = angle(object, "roll_deg");
    object.expect_no_unknown_keys();
    return head;
}

Head take_tracker(JsonObject object) {
    Head zero;
    zero.position = corner(object, "position");
    zero.heading_rad = angle(object, "heading_deg");
    object.expect_no_unknown_keys();
    return zero;
}

RoomPose take_place(JsonObject object) {
    RoomPose place;
    place.position = object.take("position").triple(-kMaxRoomPosition, kMaxRoomPosition);
    place.heading_rad = angle(object, "heading_deg");
    object.expect_no_unknown_keys();
    return place;
}

Wall standing(const char* name, const glm::dvec3& lower_left, const glm::dvec3& lower_right, double height,
              int width_px, int height_px) {
    return {name, lower_left, lower_right, lower_left + glm::dvec3(0, height, 0), width_px, height_px};
}

WallDisplay cave() {
    WallDisplay display;
    constexpr double kHalf = 1.5;
    constexpr int kPixels = 1024;
    const glm::dvec3 back_left(-kHalf, 0, kHalf), back_right(kHalf, 0, kHalf);
    const glm::dvec3 front_left(-kHalf, 0, -kHalf), front_right(kHalf, 0, -kHalf);
    display.walls = {standing("left", back_left, front_left, 2 * kHalf, kPixels, kPixels),
                     standing("front", front_left, front_right, 2 * kHalf, kPixels, kPixels),
                     standing("right", front_right, back_right, 2 * kHalf, kPixels, kPixels),
                     {"floor", back_left, back_right, front_left, kPixels, kPixels}};
    return display;
}

WallDisplay power_wall() {
    WallDisplay display;
    display.walls = {standing("front", {-2.4, 0.3, -2.5}, {2.4, 0.3, -2.5}, 2.7, 1920, 1080)};
    return display;
}

WallDisplay tabletop() {
    WallDisplay display;
    constexpr double kHeight = 0.8;
    display.walls = {{"table", {-0.6, kHeight, 0.4}, {0.6, kHeight, 0.4}, {-0.6, kHeight, -0.4}, 1200, 800}};
    display.head = {.position = {0, 1.6, 0.9}, .pitch_rad = radians(-40)};
    display.fits_scene = true;
    return display;
}

}  // namespace

std::optional<WallDisplay> preset_display(const std::string& name) {
    if (name == "cave") return cave();
    if (name == "power-wall") return power_wall();
    if (name == "tabletop") return tabletop();
    return std::nullopt;
}

Result<WallDisplay> walls_from_json(const std::string& text, const std::filesystem::path& path) {
    return read_json(text, path.string(), [](JsonObject& top) {
        WallDisplay display;
        const JsonValue walls = top.take("walls");
        const std::size_t count = walls.list_size(1, kMaxWalls);
        std::set<std::string> names;
        for (std::size_t i = 0; i < count; ++i) {
            display.walls.push_back(take_wall(JsonObject(walls.item(i))));
            if (!names.insert(display.walls.back().name).second) {
                throw walls.item(i).wrong("is another wall '" + display.walls.back().name + "'; rename one");
            }
        }
        if (top.has("head")) display.head = take_head(JsonObject(top.take("head")));
        if (top.has("tracker")) display.tracker = take_tracker(JsonObject(top.take("tracker")));
        top.read("eye_distance", display.eye_distance_m, 0, 1);
        top.read("units_per_metre", display.units_per_metre, 1e-6, 1e6);
        top.read("fit_scene", display.fits_scene);
        if (top.has("place")) {
            const JsonValue place = top.take("place");
            if (display.fits_scene) throw place.wrong("cannot be combined with \"fit_scene\": true; leave one out");
            display.place = take_place(JsonObject(place));
            display.place->units_per_metre = display.units_per_metre;
        }
        return display;
    });
}

Result<WallDisplay> read_walls(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxWallsFile_bytes));
    return walls_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

Result<std::vector<Head>> heads_from_json(const std::string& text, const std::filesystem::path& path) {
    return read_json(text, path.string(), [](JsonObject& top) {
        const JsonValue list = top.take("heads");
        const std::size_t count = list.list_size(1, kMaxHeads);
        std::vector<Head> heads;
        for (std::size_t i = 0; i < count; ++i) heads.push_back(take_head(JsonObject(list.item(i))));
        return heads;
    });
}

Result<std::vector<Head>> read_heads(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxHeadsFile_bytes));
    return heads_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

Status select_walls(WallDisplay& display, const std::string& names) {
    std::set<std::string> chosen;
    for (std::size_t begin = 0; begin <= names.size();) {
        const std::size_t end = std::min(names.find(',', begin), names.size());
        chosen.insert(names.substr(begin, end - begin));
        begin = end + 1;
    }
    std::string known;
    for (const Wall& wall : display.walls) known += (known.empty() ? "" : ", ") + wall.name;
    for (const std::string& name : chosen) {
        const bool there = std::any_of(display.walls.begin(), display.walls.end(),
                                       [&](const Wall& wall) { return wall.name == name; });
        if (!there) return Error{"there is no wall '" + printable(name) + "'; there are " + known};
    }
    std::erase_if(display.walls, [&](const Wall& wall) { return !chosen.contains(wall.name); });
    return {};
}

RoomPose fit_scene_to_wall(const Wall& table, const BoundingBox& scene_box) {
    const glm::dvec3 across = table.lower_right - table.lower_left;
    const glm::dvec3 along = table.upper_left - table.lower_left;
    const glm::dvec3 size = scene_box.highest - scene_box.lowest;
    const double shorter_m = kFitRatio * std::min(glm::length(across), glm::length(along));
    RoomPose place;
    place.units_per_metre = std::max(std::max(size.x, size.z), 1e-6) / shorter_m;
    const glm::dvec3 foot((scene_box.lowest.x + scene_box.highest.x) / 2, scene_box.lowest.y,
                          (scene_box.lowest.z + scene_box.highest.z) / 2);
    place.position = foot - place.units_per_metre * (table.lower_left + 0.5 * (across + along));
    return place;
}

}  // namespace rs::compositor
