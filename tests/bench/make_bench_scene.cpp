// make_bench_scene: writes a benchmark scene for renderers (glTF, textures, a list of lights).
//
//     make_bench_scene hall -o hall && rs-view render hall/hall.gltf --lights hall/lights.json -o hall.png

#include "rayspace/tool/tool_main.hpp"
#include "tests/bench/scenes/cabin.hpp"
#include "tests/bench/scenes/hall.hpp"
#include "tests/bench/scenes/model_file.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>

namespace {

rs::Status write_bench_scene(const std::string& scene, const std::filesystem::path& output) {
    const rs::synthetic::Model model = scene == "cabin"  ? rs::synthetic::make_cabin()
                                       : scene == "hall" ? rs::synthetic::make_hall()
                                                         : rs::synthetic::make_great_hall();
    RS_TRY(rs::synthetic::write_model(model, output, scene));
    std::printf("%s: %lld triangles, %zu nodes, %zu viewpoints\n", (output / (scene + ".gltf")).string().c_str(),
                static_cast<long long>(rs::synthetic::triangle_count(model)), model.nodes.size(), model.views.size());
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Writes a benchmark scene for renderers: SCENE.gltf, SCENE.bin, lights.json, textures",
                 "make_bench_scene");
    std::string scene;
    std::filesystem::path output;
    app.add_option("scene", scene, "hall (66,450 triangles), great-hall (150,220) or cabin (2,800,000, 49 lights)")
        ->required()
        ->check(CLI::IsMember({"hall", "great-hall", "cabin"}));
    app.add_option("-o,--output", output, "Folder to write")->required();
    app.footer("Example:\n  make_bench_scene hall -o hall");
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return write_bench_scene(scene, output); }; });
    return rs::tool_main(app, argc, argv, run);
}
