#include "compositor/tools/scene_options.hpp"

#include "compositor/lighting/light_warnings.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/material.hpp"
#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/views/object_scene.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace rs::compositor {
namespace {

constexpr double kRowSpacing = 2.2;  // between objects without a position, in object radii

}  // namespace

void add_lights_option(CLI::App& command, std::optional<std::string>& lights) {
    command.add_option("--lights", lights, "JSON list of lights, added to the scene's or replacing them")
        ->type_name("FILE.json");
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
    command
        .add_option("SCENE", options.scene,
                    ".wrl, .wrl.gz, .x3d, .x3dv, .gltf, .glb, .obj, .ply or .json; Y is up; or .rso objects")
        ->type_name("");
    command.add_option("OBJECTS", options.more_objects)->type_name("")->group("");
    command
        .add_option("--object", options.objects,
                    "object to add, FILE.rso[@X,Y,Z[,TURN_DEG[,SCALE]]]; repeatable; a floor without SCENE")
        ->type_name("OBJECT")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_lights_option(command, options.lights);
}

void add_scene_without_objects_options(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, ".wrl, .wrl.gz, .x3d, .x3dv, .gltf, .glb, .obj, .ply or .json")
        ->type_name("")
        ->required();
    add_lights_option(command, options.lights);
}

void hide_help_option(CLI::App& command) {
    command.get_help_ptr()->group("");
}

void check_scene_options(const SceneOptions& options) {
    if (!options.scene && options.objects.empty()) {
        throw CLI::ValidationError("nothing to show; give a scene file, or objects as FILE.rso");
    }
    if (options.more_objects.empty()) return;
    std::vector<std::string> files = options.more_objects;
    files.push_back(*options.scene);
    const auto other = std::ranges::find_if_not(files, is_object_file);
    if (other == files.end()) return;
    throw CLI::ValidationError(*other + ": only .rso objects can be shown beside each other; give one scene");
}

Status add_lights_of_file(Scene& scene, const std::string& file) {
    RS_ASSIGN_OR_RETURN(LightList list, read_light_list(file));
    return add_lights(scene, std::move(list), file);
}

Result<Scene> load_scene(const SceneOptions& options) {
    Scene scene;
    if (options.scene && is_object_file(*options.scene)) {
        std::vector<std::string> files{*options.scene};
        files.insert(files.end(), options.more_objects.begin(), options.more_objects.end());
        RS_ASSIGN_OR_RETURN(scene, scene_of_objects(files));
    } else if (options.scene) {
        RS_ASSIGN_OR_RETURN(scene, read_scene(*options.scene));
    } else {
        scene.floor = Floor{};
    }
    if (options.lights) {
        RS_TRY(add_lights_of_file(scene, *options.lights));
    }
    const auto count = static_cast<double>(options.objects.size());
    for (std::size_t i = 0; i < options.objects.size(); ++i) {
        const double row_x = (static_cast<double>(i) - (count - 1) / 2) * kRowSpacing;
        RS_ASSIGN_OR_RETURN(RaySpaceNode node, parse_object_argument(options.objects[i], {row_x, 0, 0}));
        scene.objects.push_back(std::move(node));
    }
    print_warnings(scene.warnings);
    return scene;
}

Status check_outputs(const SceneOptions& options, const Scene& scene, const CommandFiles& files) {
    std::vector<std::filesystem::path> used = files.inputs;
    for (const auto& file : {options.scene, options.lights}) {
        if (file) used.emplace_back(*file);
    }
    for (const RaySpaceNode& object : scene.objects) used.push_back(object.file);
    for (const GeometryNode& node : scene.geometry) {
        if (node.material.texture) used.push_back(node.material.texture->file);
        if (node.material.normals) used.push_back(node.material.normals->file);
    }
    for (const auto& image : scene.background.images) {
        if (image) used.push_back(image->file);
    }
    std::ranges::sort(used);  // nodes share textures
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const std::filesystem::path& output : files.outputs) {
        RS_TRY(refuse_overwriting_inputs(output, used));
        used.push_back(output);
    }
    return {};
}

Result<Scene> open_scene(const SceneOptions& options, const CommandFiles& files) {
    RS_ASSIGN_OR_RETURN(Scene scene, load_scene(options));
    print_warnings(light_warnings(scene));
    RS_TRY(check_outputs(options, scene, files));
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
