// rs-engine: ray-space object + viewpoint -> images.

#include "engine/tools/commands.hpp"
#include "rayspace/tool/tool_main.hpp"

int main(int argc, char** argv) {
    using namespace rs::engine;
    CLI::App app("Renders ray-space objects.", "rs-engine");
    app.footer(
        "Examples:\n  rs-engine render vase.rso --orbit 120 -o vase.mp4\n  rs-engine compare vase.rso vase-held-out\n"
        "  rs-engine conformance vase.rso");
    std::function<rs::Status()> run;
    add_render_command(app, run);
    add_compare_command(app, run);
    add_conformance_command(app, run);
    add_hardware_commands(app, run);
    return rs::tool_main(app, argc, argv, run);
}
