#include "compositor/tools/commands.hpp"
#include "compositor/tools/scene_options.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <memory>

namespace rs::compositor {
namespace {

struct ProbeOptions {
    SceneOptions scene;
    std::string position;  // X,Y,Z
    int passes = 256;
    std::string output;
    bool quiet = false;
};

Status run_probe(const ProbeOptions& options) {
    RS_ASSIGN_OR_RETURN(const Triple position, parse_triple(options.position, "--position"));
    RS_ASSIGN_OR_RETURN(const Scene scene, load_scene(options.scene));
    RS_TRY(check_outputs(options.scene, scene, {.outputs = {options.output}}));
    const Result<TracedRenderer> tracer = TracedRenderer::create(scene, {}, {});
    if (!tracer) return Error{scene_name(options.scene) + ": " + tracer.error().message};
    ProgressBar progress(options.quiet);
    return write_exr(options.output, tracer->probe({position.x, position.y, position.z}, options.passes, progress));
}

}  // namespace

void add_probe_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<ProbeOptions>();
    CLI::App* command =
        app.add_subcommand("probe", "Trace the light that reaches a point, as a latitude-longitude map");
    add_scene_without_objects_options(*command, options->scene);
    command->add_option("--position", options->position, "the point, in scene units")->required()->type_name("X,Y,Z");
    command->add_option("-o,--output", options->output, "map to write, FILE.exr")
        ->required()
        ->check(ends_in({".exr"}))
        ->type_name("");
    command->add_option("--passes", options->passes, "rays per pixel of the map, 1..65536")
        ->check(CLI::Range(1, 65536).description(""))
        ->type_name("N")
        ->capture_default_str();
    command->add_flag("-q,--quiet", options->quiet, "no progress bar");
    command->footer(
        "As \"environment\" of a recipe of `rs-capture synth`, the map lights an object as the scene would.\n"
        "Ray-space objects of the scene are left out.\n"
        "Example: rs-view probe hall.wrl --lights evening.json --position 0,0.9,0 -o evening.exr");
    command->callback([options, &run] { run = [options] { return run_probe(*options); }; });
}

}  // namespace rs::compositor
