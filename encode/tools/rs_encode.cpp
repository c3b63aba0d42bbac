// rs-encode: builds ray-space objects from capture sets, evaluates and inspects them.

#include "encode/tools/commands.hpp"
#include "rayspace/tool/tool_main.hpp"

int main(int argc, char** argv) {
    using namespace rs::encode;
    CLI::App app("Builds ray-space objects from capture sets, evaluates and inspects them.", "rs-encode");
    app.footer(
        "Examples:\n  rs-encode build vase-set -o vase.rso --report vase.html\n  rs-encode evaluate vase-set\n"
        "  rs-encode info vase.rso\n  rs-encode verify vase.rso\n  rs-encode extract vase.rso -o vase-images");
    std::function<rs::Status()> run;
    add_build_command(app, run);
    add_evaluate_command(app, run);
    add_info_command(app, run);
    add_verify_command(app, run);
    add_extract_command(app, run);
    return rs::tool_main(app, argc, argv, run);
}
