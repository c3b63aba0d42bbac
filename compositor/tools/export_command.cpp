#include "compositor/scene/export/gltf_file.hpp"
#include "compositor/tools/commands.hpp"
#include "compositor/tools/scene_options.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <memory>

namespace rs::compositor {
namespace {

struct ExportCommandOptions {
    SceneOptions scene;
    std::string output;
};

// Objects are files beside the output, or elsewhere on the same machine.
std::string url_beside(const std::filesystem::path& object, const std::filesystem::path& output) {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::absolute(output).parent_path();
    const std::filesystem::path relative = std::filesystem::relative(object, folder, failed);
    return url_of_path(failed || relative.empty() ? object : relative);
}

Status run_export(const ExportCommandOptions& options) {
    RS_ASSIGN_OR_RETURN(const Scene scene, open_scene(options.scene, {.outputs = {options.output}}));
    RS_ASSIGN_OR_RETURN(const GltfFile file, export_gltf(scene, [&](const std::filesystem::path& object) {
                            return url_beside(object, options.output);
                        }));
    RS_TRY(write_file(options.output, file.bytes));
    print_warnings(file.warnings);
    return {};
}

}  // namespace

void add_export_command(CLI::App& app, std::function<Status()>& run) {
    auto options = std::make_shared<ExportCommandOptions>();
    CLI::App* command = app.add_subcommand("export", "Convert a scene to binary glTF 2.0");
    add_scene_options(*command, options->scene);
    command->add_option("-o,--output", options->output, "file to write, FILE.glb; images are embedded")
        ->check(ends_in({".glb"}))
        ->required()
        ->type_name("");
    command->footer(
        "Writes triangles, lines and points with their materials and images, lights (KHR_lights_punctual), viewpoints\n"
        "as cameras, and ray-space objects as nodes with extras, which rs-view reads; their .rso files are not "
        "copied.\n"
        "Parts that glTF lacks are stated as warnings.\n"
        "Example:\n"
        "  rs-view export showroom.wrl -o showroom.glb");
    command->callback([options, &run] {
        check_scene_options(options->scene);
        run = [options] { return run_export(*options); };
    });
}

}  // namespace rs::compositor
