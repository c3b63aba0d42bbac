#pragma once
// Simulated board as an executor with the interface and the results of the hardware.

#include "engine/model/signals/board_config.hpp"
#include "rayspace/api/types/executor.hpp"

#include <memory>

namespace rs::engine::model {

// Objects are loaded from the board's disk in simulated time, or with `instant_loads` placed into memory at once.
std::unique_ptr<Executor> make_simulated_board(const BoardConfig& config, bool instant_loads = false);

}  // namespace rs::engine::model
