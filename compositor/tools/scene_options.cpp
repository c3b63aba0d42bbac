#include "compositor/tools/scene_options.hpp"

#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/object_argument.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "rayspace/base/printable.hpp"

#include <cstdio>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kRowSpacing = 2.2;  // between objects without a position, in object radii

void add_lights_option(CLI::App& command, SceneOptions& options) {
    command.add_option("--lights", options.lights, "JSON list of lights, added to the scene's or replacing them")
        ->type_name("FILE.json");
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, ".wrl, .wrl.gz, .x3d, .x3dv, .gltf, .glb, .obj or .json; Y is up")
        ->type_name("");
    command
        .add_option("--object", options.objects,
                    "object to add, FILE.rso[@X,Y,Z[,TURN_DEG[,SCALE]]]; repeatable; a floor without SCENE")
        ->type_name("OBJECT")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_lights_option(command, options);
}

void add_scene_without_objects_options(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, ".wrl, .wrl.gz, .x3d, .x3dv, .gltf, .glb, .obj or .json")
        ->type_name("")
        ->required();
    add_lights_option(command, options);
}

void check_scene_options(const SceneOptions& options) {
    if (!options.scene && options.objects.empty()) {
        throw CLI::ValidationError("nothing to show; give a scene file or --object FILE.rso");
    }
}

Result<Scene> load_scene(const SceneOptions& options) {
    Scene scene;
    if (options.scene) {
        Result<Scene> read = read_scene(*options.scene);
        if (!read) return read.error();
        scene = std::move(*read);
    } else {
        scene.floor = Floor{};
    }
    if (options.lights) {
        Result<LightList> list = read_light_list(*options.lights);
        if (!list) return list.error();
        if (Status added = add_lights(scene, std::move(*list), *options.lights); !added) return added.error();
    }
    const auto count = static_cast<double>(options.objects.size());
    for (std::size_t i = 0; i < options.objects.size(); ++i) {
        const double row_x = (static_cast<double>(i) - (count - 1) / 2) * kRowSpacing;
        Result<RaySpaceNode> node = parse_object_argument(options.objects[i], {row_x, 0, 0});
        if (!node) return node.error();
        scene.objects.push_back(std::move(*node));
    }
    print_warnings(scene.warnings);
    return scene;
}

std::string scene_name(const SceneOptions& options) {
    return options.scene.value_or("rs-view");
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        std::fprintf(stderr, "rs-view: warning: %s\n", printable(warning).c_str());
}

}  // namespace rs::compositor
