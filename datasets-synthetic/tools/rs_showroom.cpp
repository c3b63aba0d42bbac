// rs-showroom: writes a shop and a museum with the procedural objects as a VRML97 world, or benchmark rooms for
// renderers.

#include "datasets-synthetic/measuring/cabin.hpp"
#include "datasets-synthetic/measuring/hall.hpp"
#include "datasets-synthetic/measuring/model_file.hpp"
#include "datasets-synthetic/showroom/showroom.hpp"
#include "datasets-synthetic/showroom/world_file.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

struct Options {
    std::filesystem::path output;
    std::string scene = "showroom";
    std::string objects = "..";
    bool small = false;
};

rs::Status run_showroom(const Options& options) {
    rs::synthetic::ShowroomOptions showroom;
    if (options.small) showroom.texture_scale = 0.25F;
    const rs::synthetic::World world = rs::synthetic::make_showroom(showroom);
    if (rs::Status written = rs::synthetic::write_world(world, options.output, "showroom", options.objects); !written) {
        return written;
    }
    std::size_t triangles = 0;
    for (const rs::synthetic::WorldPart& part : world.parts) triangles += part.mesh.triangles.size();
    std::printf("%s: %zu triangles, %zu objects, %zu textures, %zu viewpoints\n",
                (options.output / "showroom.wrl").string().c_str(), triangles, world.objects.size(),
                world.textures.size(), world.viewpoints.size());
    return {};
}

rs::Status run_measuring(const Options& options) {
    const rs::synthetic::Model model = options.scene == "cabin"  ? rs::synthetic::make_cabin()
                                       : options.scene == "hall" ? rs::synthetic::make_hall()
                                                                 : rs::synthetic::make_great_hall();
    if (rs::Status written = rs::synthetic::write_model(model, options.output, options.scene); !written) return written;
    std::printf("%s: %lld triangles, %zu nodes, %zu viewpoints\n",
                (options.output / (options.scene + ".gltf")).string().c_str(),
                static_cast<long long>(rs::synthetic::triangle_count(model)), model.nodes.size(), model.views.size());
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Writes a shop and a museum room with the procedural objects (VRML97, textures, a camera path), or a benchmark "
        "room for renderers (glTF, a light list)",
        "rs-showroom");
    Options options;
    app.add_option("-o,--output", options.output,
                   "Folder to write: showroom.wrl, showroom-walk.json, evening.json, textures; or SCENE.gltf, "
                   "SCENE.bin, lights.json, textures")
        ->required();
    app.add_option("--scene", options.scene,
                   "showroom; hall (66,450 triangles), great-hall (150,220) or cabin (2,800,000, 49 lights)")
        ->capture_default_str()
        ->check(CLI::IsMember({"showroom", "hall", "great-hall", "cabin"}));
    app.add_option("--objects", options.objects,
                   "Folder of vase.rso, flower.rso, doll.rso, lamp.rso, lattice.rso and blocks.rso, relative to the "
                   "output folder")
        ->capture_default_str();
    app.add_flag("--small", options.small, "Textures at a quarter of the resolution");
    app.footer(
        "Examples:\n  rs-showroom -o showroom && rs-view showroom/showroom.wrl --viewpoint museum -o museum.png\n"
        "  rs-view showroom/showroom.wrl --lights showroom/evening.json --exposure 3 --renderer path -o evening.png\n"
        "  rs-showroom --scene hall -o hall && rs-view hall/hall.gltf --lights hall/lights.json --renderer whitted -o "
        "hall.png");
    std::function<rs::Status()> run;
    app.callback(
        [&] { run = [&] { return options.scene == "showroom" ? run_showroom(options) : run_measuring(options); }; });
    return rs::tool_main(app, argc, argv, run);
}
