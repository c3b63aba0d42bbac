#include "compositor/tools/requested_scene.hpp"

#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/object_argument.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "engine/executors/executor_table.hpp"
#include "rayspace/base/printable.hpp"

#include <cstdio>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kRowSpacing = 2.2;  // between objects without a place of their own, object radii

}  // namespace

Result<Scene> requested_scene(const ViewArguments& arguments) {
    Scene scene;
    if (arguments.scene.empty()) {
        scene.floor = Floor{};
    } else {
        Result<Scene> read = read_scene(arguments.scene);
        if (!read) return read.error();
        scene = std::move(*read);
    }
    if (!arguments.lights.empty()) {
        Result<LightList> list = read_light_list(arguments.lights);
        if (!list) return list.error();
        if (Status added = add_lights(scene, std::move(*list), arguments.lights); !added) return added.error();
    }
    if (!arguments.path.empty()) {
        const Result<Scene> walk = read_scene(arguments.path);
        if (!walk) return walk.error();
        if (!walk->camera)
            return Error{arguments.path + ": has no camera path (compositor/README.md, JSON, \"camera\")"};
        scene.camera = walk->camera;
    }
    const auto count = static_cast<double>(arguments.objects.size());
    for (std::size_t i = 0; i < arguments.objects.size(); ++i) {
        const double row_place = (static_cast<double>(i) - (count - 1) / 2) * kRowSpacing;
        Result<RaySpaceNode> node = parse_object_argument(arguments.objects[i], {row_place, 0, 0});
        if (!node) return node.error();
        scene.objects.push_back(std::move(*node));
    }
    return scene;
}

Result<std::unique_ptr<engine::Executor>> requested_executor(const ViewArguments& arguments) {
    if (arguments.executor == "core") return std::unique_ptr<engine::Executor>();
    return engine::make_executor(arguments.executor, {.instant_loads = true});
}

ObjectDepth requested_depth(const ViewArguments& arguments) {
    return arguments.object_depth == "pixel" ? ObjectDepth::kPixel : ObjectDepth::kPlane;
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        std::fprintf(stderr, "rs-view: warning: %s\n", printable(warning).c_str());
}

}  // namespace rs::compositor
