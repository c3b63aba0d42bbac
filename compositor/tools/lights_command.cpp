#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/scene_options.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <memory>

namespace rs::compositor {
namespace {

struct LightsOptions {
    SceneOptions scene;
    std::string output;
};

Status run_lights(const LightsOptions& options) {
    RS_ASSIGN_OR_RETURN(const Scene scene, open_scene(options.scene, {.outputs = {options.output}}));
    return write_light_list(lights_as_list(scene), options.output);
}

}  // namespace

void add_lights_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<LightsOptions>();
    CLI::App* command =
        app.add_subcommand("lights", "Write all lights of a scene as a JSON list, which replaces those of the scene");
    add_scene_without_objects_options(*command, options->scene);
    command->add_option("-o,--output", options->output, "list to write, FILE.json")
        ->required()
        ->check(ends_in({".json"}))
        ->type_name("");
    command->footer("Example: rs-view lights hall.wrl -o hall_lights.json");
    command->callback([options, &run] { run = [options] { return run_lights(*options); }; });
}

}  // namespace rs::compositor
