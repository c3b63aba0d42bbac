// rs-capture: photos or rendered images -> a calibrated capture set with alpha.

#include "capture/tools/commands.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <malloc.h>

int main(int argc, char** argv) {
    // Large images are allocated and freed continually. Returning their memory to the system each time would cost a
    // tenth of an import of large photos in page clearing; this makes glibc keep blocks of up to 32 MB.
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
    CLI::App app("Make capture sets (images and transforms.json) of objects on a turntable", "rs-capture");
    app.require_subcommand(1);
    app.footer(
        "Examples:\n  rs-capture synth datasets-synthetic/recipes/vase.json -o vase-set\n  rs-capture import "
        "photos -o shoe-set");
    std::function<rs::Status()> run;
    rs::capture::add_synth_command(app, run);
    rs::capture::add_import_command(app, run);
    rs::capture::add_export_command(app, run);
    rs::capture::add_board_command(app, run);
    rs::capture::add_luminaire_command(app, run);
    return rs::tool_main(app, argc, argv, run);
}
