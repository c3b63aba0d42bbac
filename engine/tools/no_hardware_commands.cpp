#include "engine/tools/commands.hpp"

namespace rs::engine {

void add_hardware_commands(CLI::App& /*app*/, std::function<Status()>& /*run*/) {}

}  // namespace rs::engine
