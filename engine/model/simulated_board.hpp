#pragma once
// The model of the board as an executor: what a host program would see of the real one, only slower.

#include "rayspace/api/types/executor.hpp"
#include "engine/model/signals/board_config.hpp"

#include <memory>

namespace rs::engine::model {

// Objects are loaded from the board's disk, with the time that it takes, or, `instant_loads`, put there at once.
std::unique_ptr<Executor> make_simulated_board(const BoardConfig& config, bool instant_loads = false);

}  // namespace rs::engine::model
