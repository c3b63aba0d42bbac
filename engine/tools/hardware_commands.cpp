#include "engine/tools/commands.hpp"

namespace rs::engine {

void add_hardware_commands(CLI::App& app, std::function<Status()>& run) {
    add_board_command(app, run);
    add_simulate_command(app, run);
}

}  // namespace rs::engine
