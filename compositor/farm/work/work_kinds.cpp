#include "compositor/farm/work/work_kinds.hpp"

#include "compositor/farm/work/tool_job.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace rs::farm {
namespace {

namespace fs = std::filesystem;

constexpr double kMega = 1e6;
constexpr std::uint64_t kRecipeCap_bytes = 16 << 20;

Result<Extent> extent_of_set(const fs::path& set, const std::vector<std::string>& /*options*/) {
    const Result<Rig> rig = read_rig(set);
    if (!rig) return rig.error();
    const Camera& camera = rig->views.front().camera;
    return Extent{static_cast<double>(rig->views.size()), static_cast<double>(camera.width) * camera.height};
}

int max_side_of(const std::vector<std::string>& options) {
    constexpr std::string_view kOption = "--max-side";
    int max_side_px = kDefaultMaxSide_px;
    for (std::size_t i = 0; i < options.size(); ++i) {
        std::string_view value;
        if (options[i] == kOption && i + 1 < options.size()) value = options[i + 1];
        if (options[i].starts_with(std::string(kOption) + "=")) {
            value = std::string_view(options[i]).substr(kOption.size() + 1);
        }
        // What is no number rs-capture refuses.
        std::from_chars(value.data(), value.data() + value.size(), max_side_px);
    }
    return std::clamp(max_side_px, 1, kMaxImageSide_px);
}

// All files count as photographs of the size of the first that is one, as large as they are worked with; reading one
// takes a thirteenth of what working on as many pixels does.
Result<Extent> extent_of_photos(const fs::path& folder, const std::vector<std::string>& options) {
    constexpr double kReading = 24.0 / 312;
    std::error_code error;
    std::set<fs::path> files;
    for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        if (at->is_regular_file(error) && !at->path().filename().string().starts_with('.')) files.insert(at->path());
    }
    for (const fs::path& file : files) {
        const Result<ImageInfo> info = read_image_info(file, kMaxPhotographSide_px);
        if (!info) continue;
        const double reduction = photograph_reduction(info->width, info->height, max_side_of(options));
        const double pixels = static_cast<double>(info->width) * info->height;
        return Extent{static_cast<double>(files.size()), std::max(pixels / (reduction * reduction), kReading * pixels)};
    }
    return Error{folder.string() + ": holds no photographs"};
}

// What the recipe states, else what rs-capture synth takes.
Result<Extent> extent_of_recipe(const fs::path& recipe, const std::vector<std::string>& /*options*/) {
    nlohmann::json camera;
    if (recipe.extension() == ".json") {
        const auto bytes = read_file(recipe, kRecipeCap_bytes);
        if (!bytes) return bytes.error();
        const auto json = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, recipe.string());
        if (!json) return json.error();
        if (json->is_object() && json->contains("camera")) camera = json->at("camera");
    }
    const auto number = [&](const char* key, double usual) {
        if (!camera.is_object() || !camera.contains(key) || !camera.at(key).is_number()) return usual;
        return camera.at(key).get<double>();
    };
    return Extent{number("views", 90), number("width", 512) * number("height", 512), number("spp", 64)};
}

// Where all results would go to one place, or to none.
Status check_options(const std::vector<std::string>& options) {
    for (const std::string& option : options) {
        for (const char* const refused : {"-o", "--output", "--report", "--json", "--list"}) {
            if (option == refused || option.starts_with(std::string(refused) + "=")) {
                return Error{option + ": is not for a farm, whose items all get the same options; leave it out"};
            }
        }
    }
    return {};
}

bool is_utf8(const std::string& text) {
    try {
        return !nlohmann::json(text).dump().empty();
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

// Absolute and without a slash at its end, so that an input is the same from wherever it is named.
fs::path whole_path(const std::string& given) {
    const fs::path path = fs::absolute(given).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

}  // namespace

const std::array<WorkKind, 3> kWorkKinds = {{
    {"encode", "rs-encode", "build", "capture sets", ".rso", true, extent_of_set, 150 * kMega, 14, 0},
    {"import", "rs-capture", "import", "folders of photographs", "", true, extent_of_photos, 200 * kMega, 8, 312},
    {"synth", "rs-capture", "synth", "recipes or meshes", "", false, extent_of_recipe, 150 * kMega, 0, 160},
}};

fs::path state_folder(const fs::path& output) {
    return output / ".rs-farm";
}

Result<std::vector<Item>> items_of(const WorkKind& kind, const FarmRequest& request) {
    if (Status fine = check_options(request.options); !fine) return fine.error();
    const fs::path output = whole_path(request.output.string());
    std::map<std::string, fs::path> named;
    std::vector<Item> items;
    for (const std::string& given : request.inputs) {
        const fs::path input = whole_path(given);
        const std::string name = (kind.reads_folder ? input.filename() : input.stem()).string();
        if (!is_utf8(name)) return Error{given + ": has a name that is not UTF-8; rename it"};
        const auto [other, is_new] = named.emplace(name, input);
        if (!is_new) {
            return Error{given + ": would be written as " + name + kind.ending + ", as " + other->second.string() +
                         " would; rename one, or give each run a folder of its own"};
        }
        Item item;
        item.name = name;
        const Result<Extent> found = kind.extent_of(input, request.options);
        const Extent extent = found ? *found : Extent{};
        item.size = extent.images * extent.pixels * extent.samples;
        item.memory_bytes = request.item_memory_bytes.value_or(
            static_cast<std::int64_t>(kind.base_bytes + kind.bytes_per_pixel * extent.images * extent.pixels +
                                      kind.bytes_per_image_pixel * extent.pixels));
        ToolOrder order;
        order.tool = kind.tool;
        order.arguments = {kind.command, input.string(), "-q"};
        order.arguments.insert(order.arguments.end(), request.options.begin(), request.options.end());
        if (kind.reads_folder) order.folder = input.string();
        order.output = (output / (name + kind.ending)).string();
        order.state = (state_folder(output) / "items" / name).string();
        item.order = to_json(order);
        items.push_back(std::move(item));
    }
    return items;
}

}  // namespace rs::farm
