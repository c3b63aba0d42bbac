// rs-street: writes a street with traffic as the files of a sequence.

#include "datasets-synthetic/street/street.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

struct Options {
    std::filesystem::path output;
    std::filesystem::path scenario;
    std::string objects;
    std::string name = "street";
    std::string time;
    double seconds = 0;
    bool small = false;
    bool force = false;
};

rs::Status run_street(const Options& options) {
    rs::synthetic::StreetOptions street;
    street.name = options.name;
    street.objects = options.objects;
    street.force = options.force;
    street.scenario = rs::synthetic::default_scenario();
    if (options.small) street.texture_scale = 0.25F;
    const auto objects = options.objects.empty() ? std::filesystem::path() : options.output / options.objects;
    if (auto kept = rs::refuse_overwriting_inputs(options.output, {options.scenario, objects}); !kept) return kept;
    if (!options.scenario.empty()) {
        RS_ASSIGN_OR_RETURN(const auto scenario, rs::synthetic::read_scenario(options.scenario));
        street.scenario = scenario;
    }
    if (!options.time.empty()) street.scenario.night = options.time == "night";
    if (options.seconds > 0) street.scenario.seconds = options.seconds;
    RS_ASSIGN_OR_RETURN(const auto figures, rs::synthetic::write_street(street, options.output));
    std::printf("%s: %zu frames, up to %zu vehicles, %zu static triangles\n",
                (options.output / "maps" / options.name).string().c_str(), figures.frames, figures.vehicles,
                figures.static_triangles);
    if (!figures.missing.empty()) {
        std::fprintf(stderr,
                     "rs-street: shop windows refer to %s, missing in %s (relative to the output folder); create them "
                     "with rs-encode build, or omit --objects\n",
                     rs::listed(std::vector(figures.missing.begin(), figures.missing.end()), 3).c_str(),
                     options.objects.c_str());
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Writes a street with traffic: a base scene, vehicles, and an extended OBJ for each frame",
                 "rs-street");
    Options options;
    app.add_option("-o,--output", options.output, "Folder to write: maps/NAME/anim/out/frames.json, models/")
        ->required();
    app.add_option("--scenario", options.scenario,
                   "JSON: traffic, time and camera (datasets-synthetic/README.md); default: ten seconds by day")
        ->type_name("FILE.json");
    app.add_option("--time", options.time, "Overrides the scenario's time of day")
        ->check(CLI::IsMember({"day", "night"}));
    app.add_option("--seconds", options.seconds, "Overrides the scenario's duration")->check(CLI::Range(0.1, 3600.0));
    app.add_option("--objects", options.objects,
                   "Folder of vase.rso, flower.rso, doll.rso, lamp.rso, lattice.rso and blocks.rso for shop windows, "
                   "relative to the output folder; without it, the windows are empty");
    app.add_option("--name", options.name, "Name of the map")->capture_default_str();
    app.add_flag("--small", options.small, "Textures at a quarter of the resolution");
    app.add_flag("--force", options.force, rs::kForceHelp);
    app.footer(
        "Examples:\n  rs-street -o town --objects .. && rs-view sequence town/maps/street -o street.mp4\n"
        "  rs-street -o evening --time night --seconds 4 && rs-view sequence evening --weather rain -o rain.mp4");
    std::function<rs::Status()> run;
    app.callback([&] { run = [&] { return run_street(options); }; });
    return rs::tool_main(app, argc, argv, run);
}
