// rs-view: shows and renders scenes with ray-space objects.

#include "compositor/tools/commands.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace {

// `rs-view SCENE` is short for `rs-view open SCENE`.
bool is_short_for_open(const CLI::App& app, int argc, char** argv) {
    if (argc < 2) return false;
    const std::string_view first = argv[1];
    if (first == "-h" || first == "--help" || first == "--version") return false;
    return std::ranges::none_of(app.get_subcommands({}),
                                [&](const CLI::App* command) { return command->get_name() == first; });
}

}  // namespace

int main(int argc, char** argv) {
    using namespace rs::compositor;
    CLI::App app("Shows and renders scenes of geometry and ray-space objects.", "rs-view");
    app.get_formatter()->column_width(36);
    app.footer(
        "`rs-view SCENE` is short for `rs-view open SCENE`.\n"
        "Examples:\n"
        "  rs-view museum.wrl\n"
        "  rs-view vase.rso\n"
        "  rs-view render --object vase.rso@-1.2,0,0 --object lamp.rso@1.2,0,0,45,0.8 --orbit 120 -o turn.mp4\n"
        "  rs-view render hall.wrl --renderer path --lens f/1.4 --focus 2.5 -o portrait.png\n"
        "  rs-view walls hall.wrl --display cave --heads udp:0.0.0.0:4242\n"
        "  rs-view quilt hall.wrl --layout 5x9 -o hall.png\n"
        "  rs-view sequence maps/street --weather rain -o street.mp4\n"
        "  rs-view page vase.rso -o vase.html\n"
        "  rs-view page museum.wrl -o museum.html");
    std::function<rs::Status()> run;
    add_open_command(app, run);
    add_render_command(app, run);
    add_quilt_command(app, run);
    add_walls_command(app, run);
    add_sequence_command(app, run);
    add_probe_command(app, run);
    add_lights_command(app, run);
    add_export_command(app, run);
    add_page_command(app, run);
    add_tile_command(app, run);
    std::vector<char*> arguments(argv, argv + argc);
    char open[] = "open";
    if (is_short_for_open(app, argc, argv)) arguments.insert(arguments.begin() + 1, open);
    arguments.push_back(nullptr);
    return rs::tool_main(app, static_cast<int>(arguments.size()) - 1, arguments.data(), run);
}
