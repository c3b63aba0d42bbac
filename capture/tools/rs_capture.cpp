// rs-capture: photographs or traced images -> a calibrated, matted capture set.

#include "capture/tools/commands.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <malloc.h>

int main(int argc, char** argv) {
    // Images come and go all the time. Given back to the system each time, a tenth of an import of large photographs
    // would go into clearing their pages; glibc keeps blocks of up to 32 MB, if it is asked to.
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
    CLI::App app("Makes capture sets (images and transforms.json) of objects on a turntable", "rs-capture");
    app.require_subcommand(1);
    app.footer(
        "Examples:\n  rs-capture synth datasets-synthetic/recipes/vase.json -o vase-set\n  rs-capture import "
        "photographs -o shoe-set");
    std::function<rs::Status()> run;
    rs::capture::add_synth_command(app, run);
    rs::capture::add_import_command(app, run);
    rs::capture::add_board_command(app, run);
    rs::capture::add_luminaire_command(app, run);
    return rs::tool_main(app, argc, argv, run);
}
