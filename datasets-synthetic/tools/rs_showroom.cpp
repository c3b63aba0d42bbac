// rs-showroom: writes a shop and a museum as a VRML97 world that shows the procedural objects.

#include "datasets-synthetic/showroom/showroom.hpp"
#include "datasets-synthetic/showroom/world_file.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

struct Options {
    std::filesystem::path output;
    std::string objects = "..";
    bool small = false;
    bool force = false;
};

rs::Status run_showroom(const Options& options) {
    const std::filesystem::path objects = options.output / options.objects;
    if (rs::Status kept = rs::refuse_overwriting_inputs(options.output, {objects}); !kept) return kept;
    rs::synthetic::ShowroomOptions showroom;
    if (options.small) showroom.texture_scale = 0.25F;
    const rs::synthetic::World world = rs::synthetic::make_showroom(showroom);
    if (rs::Status written =
            rs::synthetic::write_world(world, options.output, "showroom", options.objects, options.force);
        !written) {
        return written;
    }
    std::size_t triangles = 0;
    for (const rs::synthetic::WorldPart& part : world.parts) triangles += part.mesh.triangles.size();
    std::printf("%s: %zu triangles, %zu objects, %zu textures, %zu viewpoints\n",
                (options.output / "showroom.wrl").string().c_str(), triangles, world.objects.size(),
                world.textures.size(), world.viewpoints.size());
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Writes a shop and a museum (VRML97, textures, a camera path) that show the procedural objects",
                 "rs-showroom");
    Options options;
    app.add_option("-o,--output", options.output,
                   "Folder to write: showroom.wrl, showroom-walk.json, evening.json, textures")
        ->required();
    app.add_option("--objects", options.objects,
                   "Folder of vase.rso, flower.rso, doll.rso, lamp.rso, lattice.rso and blocks.rso, relative to the "
                   "output folder")
        ->capture_default_str();
    app.add_flag("--small", options.small, "Write the textures at a quarter of the resolution");
    app.add_flag("--force", options.force, rs::kForceHelp);
    app.footer(
        "Examples:\n  rs-showroom -o showroom && rs-view render showroom/showroom.wrl --viewpoint museum -o "
        "museum.png\n  rs-view render showroom/showroom.wrl --lights showroom/evening.json --exposure 3 --renderer "
        "path "
        "-o evening.png");
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return run_showroom(options); }; });
    return rs::tool_main(app, argc, argv, run);
}
