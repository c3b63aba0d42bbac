#include "compositor/sequence/frames_file.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxFramesFile_bytes = std::uint64_t{16} << 20;
constexpr std::size_t kMaxModels = 1000;

glm::vec3 take_colour(JsonObject& object, const char* key) {
    const glm::vec3 srgb(object.take(key).triple(0, 1));
    return {linear_from_srgb(srgb.r), linear_from_srgb(srgb.g), linear_from_srgb(srgb.b)};
}

// Gradient from the zenith to the horizon; the ground has the horizon's colour.
Background take_background(JsonObject object) {
    Background background;
    const glm::vec3 zenith = take_colour(object, "zenith");
    const glm::vec3 horizon = take_colour(object, "horizon");
    object.expect_no_unknown_keys();
    background.sky = {zenith, glm::mix(zenith, horizon, 0.45F), horizon};
    background.sky_angles_rad = {radians(60), radians(90)};
    return background;
}

std::vector<fs::path> take_files(JsonObject& object, const char* key, std::size_t least, std::size_t most,
                                 const fs::path& folder) {
    const JsonValue list = object.take(key);
    std::vector<fs::path> files;
    const std::size_t count = list.list_size(least, most);
    for (std::size_t i = 0; i < count; ++i) files.push_back(folder / list.item(i).text());
    return files;
}

// Map of a project folder with a single map.
Result<std::optional<fs::path>> find_single_map(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> maps;
    for (fs::directory_iterator i(folder / "maps", error), end; !error && i != end; i.increment(error)) {
        fs::path file = i->path() / "anim" / "out" / "frames.json";
        std::error_code none;
        if (fs::exists(file, none)) maps.push_back(std::move(file));
    }
    if (maps.empty()) return std::optional<fs::path>();
    if (maps.size() == 1) return std::optional<fs::path>(maps.front());
    std::sort(maps.begin(), maps.end());
    std::string names;
    for (const fs::path& map : maps) {
        names += (names.empty() ? "" : ", ") + map.parent_path().parent_path().parent_path().string();
    }
    return Error{printable(folder.string() + ": has several maps; give one or more of " + names)};
}

}  // namespace

Result<SequenceFiles> frames_from_json(const std::string& text, const fs::path& file) {
    const fs::path folder = file.parent_path();
    return read_json(text, file.string(), [&](JsonObject& top) {
        SequenceFiles files;
        files.file = file;
        if (top.has("base")) files.base = folder / top.take("base").text();
        if (top.has("models")) files.models = take_files(top, "models", 0, kMaxModels, folder);
        files.frames = take_files(top, "frames", 1, kMaxFrames, folder);
        top.read("frames_per_second", files.frames_per_second, 1, 240);
        if (top.has("lights")) files.lights = folder / top.take("lights").text();
        if (top.has("background")) files.background = take_background(JsonObject(top.take("background")));
        if (top.has("haze_m")) files.haze_m = top.take("haze_m").number(1, 1e6);
        if (top.has("weather")) {
            const JsonValue value = top.take("weather");
            Result<Weather> weather = parse_weather(value.text());
            if (!weather) throw value.wrong("is not a weather; give rain, snow or fog, or rain,fog");
            files.weather = *weather;
        }
        if (top.has("seed")) {
            const int seed = top.take("seed").whole_number(0, 1'000'000'000);
            if (files.weather) files.weather->seed = static_cast<std::uint32_t>(seed);
        }
        return files;
    });
}

Result<SequenceFiles> find_sequence(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error))
        return Error{printable(folder.string()) + ": the folder does not exist; correct the name"};
    if (!fs::is_directory(folder, error) && lower_case_extension(folder) == ".obj") {
        SequenceFiles files;
        files.file = folder;
        files.frames = {folder};
        return files;
    }
    std::optional<fs::path> file;
    if (!fs::is_directory(folder, error)) file = folder;
    for (const char* place : {"frames.json", "out/frames.json", "anim/out/frames.json"}) {
        if (!file && fs::exists(folder / place, error)) file = folder / place;
    }
    if (!file) {
        RS_ASSIGN_OR_RETURN(std::optional<fs::path> map, find_single_map(folder));
        file = std::move(map);
    }
    if (!file) {
        return Error{printable(folder.string()) +
                     ": has no frames.json, in it or in anim/out/; give a map's folder "
                     "(compositor/sequence/README.md)"};
    }
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(*file, kMaxFramesFile_bytes));
    return frames_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, *file);
}

}  // namespace rs::compositor
