#include "compositor/tools/replaced_flags.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace rs::compositor {
namespace {

struct ReplacedFlag {
    std::string_view flag;
    std::string_view subcommand;
};

// The flags that selected a mode come first: of several that are given, the first one in this list is named.
constexpr std::array kReplacedFlags{
    ReplacedFlag{"--sequence", "sequence FOLDER"},
    ReplacedFlag{"--walls", "walls SCENE --display PRESET|FILE.json"},
    ReplacedFlag{"--quilt", "quilt SCENE --layout COLSxROWS"},
    ReplacedFlag{"--probe", "probe SCENE --position X,Y,Z"},
    ReplacedFlag{"--save-lights", "lights SCENE -o FILE.json"},
    ReplacedFlag{"--plan", "tile plan SCENE -o FILE.json"},
    ReplacedFlag{"--tile", "tile trace SCENE --tile F:X,Y,WxH"},
    ReplacedFlag{"--tiles", "tile assemble SCENE --tiles FOLDER"},
    ReplacedFlag{"-o", "render SCENE -o FILE"},
    ReplacedFlag{"--output", "render SCENE -o FILE"},
    ReplacedFlag{"--headless", "render SCENE -o FILE"},
    ReplacedFlag{"--path", "render SCENE --path FILE.json -o FILE"},
    ReplacedFlag{"--orbit", "render SCENE --orbit N -o FILE"},
    ReplacedFlag{"--passes", "render SCENE --passes N -o FILE"},
    ReplacedFlag{"--seconds", "render SCENE --seconds S -o FILE"},
    ReplacedFlag{"--streaming", "render SCENE --streaming -o FILE"},
    ReplacedFlag{"--upright", "render SCENE --upright -o FILE"},
    ReplacedFlag{"--stats", "render SCENE --stats FILE.json -o FILE"},
};

}  // namespace

void refuse_unknown_arguments(const std::vector<std::string>& arguments) {
    if (arguments.empty()) return;
    for (const ReplacedFlag& replaced : kReplacedFlags) {
        const bool is_given = std::ranges::any_of(arguments, [&](const std::string& argument) {
            return std::string_view(argument).substr(0, argument.find('=')) == replaced.flag;
        });
        if (!is_given) continue;
        throw CLI::ValidationError(std::string(replaced.flag) + " is not an option of 'rs-view open'; use 'rs-view " +
                                   std::string(replaced.subcommand) + "'");
    }
    throw CLI::ExtrasError("open", arguments);
}

}  // namespace rs::compositor
