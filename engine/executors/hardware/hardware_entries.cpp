#include "engine/executors/entries.hpp"
#include "engine/model/board.hpp"
#include "engine/model/signals/board_config.hpp"

namespace rs::engine {

std::vector<ExecutorEntry> hardware_entries() {
    return {{"board", "CONFIG", [](const std::string& argument) -> Result<std::unique_ptr<Executor>> {
                 RS_ASSIGN_OR_RETURN(const model::BoardConfig config, model::read_board_config(argument));
                 return model::make_simulated_board(config, true);
             }}};
}

}  // namespace rs::engine
