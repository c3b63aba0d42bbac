#include "compositor/farm/work/child_process.hpp"
#include "compositor/farm/work/tool_job.hpp"
#include "compositor/farm/work/work_kinds.hpp"
#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <utility>

namespace rs::farm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kViewer = "rs-view";
constexpr int kTile_px = 256;
constexpr int kFramesEnough = 64;  // that as many are not cut: each tile reads the scene anew
constexpr double kFrameBytes = 300e6;
constexpr double kFrameBytesPerPixel = 200;
constexpr std::uint64_t kPlanCap_bytes = 1 << 20;
constexpr std::int64_t kMostTiles = 1 << 20;

struct Plan {
    int frames = 0;
    int width = 0;
    int height = 0;
    bool traced = false;
};

Result<Plan> plan_of(const std::vector<std::string>& arguments, const fs::path& tools, const fs::path& state) {
    const fs::path file = state / "plan.json";
    std::vector<std::string> words{(tools / kViewer).string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--plan", file.string()});
    const fs::path log = state / "plan.log";
    Result<ChildProcess> child = ChildProcess::start(words, {.log = log, .environment = {}, .processors = {}});
    if (!child) return child.error();
    const ChildEnd end = child->wait();
    if (end.exit_code != 0 || end.signal != 0) {
        std::ifstream said(log);
        std::string last;
        for (std::string line; std::getline(said, line);) last = line;
        return Error{last.empty() ? std::string(kViewer) + " ended by signal " + std::to_string(end.signal) : last};
    }
    const auto bytes = read_file(file, kPlanCap_bytes);
    if (!bytes) return bytes.error();
    const auto json = parse_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string());
    if (!json) return json.error();
    Plan plan;
    try {
        plan = {json->at("frames"), json->at("width"), json->at("height"), json->at("traced")};
    } catch (const nlohmann::json::exception& wrong) {
        return Error{file.string() + ": is no plan of rs-view: " + wrong.what()};
    }
    return plan;
}

std::string joined(std::initializer_list<int> numbers, const char* marks) {
    std::string text;
    for (const int number : numbers) {
        text += std::to_string(number);
        if (*marks != '\0') text += *marks++;
    }
    return text;
}

}  // namespace

Result<std::vector<Item>> render_items(const RenderRequest& request, const fs::path& state) {
    std::vector<std::string> arguments;
    if (!request.scene.empty()) arguments.push_back(fs::absolute(request.scene).lexically_normal().string());
    arguments.insert(arguments.end(), request.options.begin(), request.options.end());
    arguments.emplace_back("-q");
    const Result<Plan> plan = plan_of(arguments, request.tools, state);
    if (!plan) return plan.error();

    const double frame_px = static_cast<double>(plan->width) * plan->height;
    const auto memory_bytes =
        request.item_memory_bytes.value_or(static_cast<std::int64_t>(kFrameBytes + kFrameBytesPerPixel * frame_px));
    std::vector<Item> items;
    Item last;
    const auto add = [&](Item& item, const std::string& name, std::vector<std::string> more, const fs::path& output) {
        ToolOrder order{kViewer, arguments, "", output.string(), (state / "items" / name).string()};
        order.arguments.insert(order.arguments.end(), more.begin(), more.end());
        item.name = name;
        item.memory_bytes = memory_bytes;
        item.order = to_json(order);
    };
    const fs::path tiles = state / "tiles";
    std::set<std::string> names;
    if (plan->traced) {
        const bool whole = plan->frames >= kFramesEnough;
        const int width = whole ? plan->width : kTile_px;
        const int height = whole ? plan->height : kTile_px;
        const auto along = [](int length, int tile) { return (length + tile - 1) / tile; };
        if (std::int64_t{plan->frames} * along(plan->width, width) * along(plan->height, height) > kMostTiles) {
            return Error{"more than " + std::to_string(kMostTiles) + " tiles; render fewer frames at a time"};
        }
        for (int frame = 0; frame < plan->frames; ++frame) {
            for (int y = 0; y < plan->height; y += height) {
                for (int x = 0; x < plan->width; x += width) {
                    const int w = std::min(width, plan->width - x);
                    const int h = std::min(height, plan->height - y);
                    const std::string name = joined({frame, x, y}, "--");
                    names.insert(name + ".png");
                    Item& item = items.emplace_back();
                    add(item, name, {"--tile", joined({frame, x, y, w, h}, ":,,x")}, tiles / (name + ".png"));
                    item.size = static_cast<double>(w) * h;
                    last.after.push_back(items.size() - 1);
                }
            }
        }
    }
    std::error_code error;
    fs::create_directories(tiles, error);
    for (auto at = fs::directory_iterator(tiles, error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        if (!names.contains(at->path().filename().string())) fs::remove_all(at->path(), error);
    }
    if (error) return Error{tiles.string() + ": cannot be made or emptied: " + error.message()};
    std::vector<std::string> from_tiles;
    if (plan->traced) from_tiles = {"--tiles", tiles.string()};
    add(last, "frames", from_tiles, fs::absolute(request.output).lexically_normal());
    last.size = frame_px * plan->frames / 64;
    items.push_back(std::move(last));
    return items;
}

}  // namespace rs::farm
