#pragma once
// The model of the board behind the interface that the data module drives (driver/board_device.hpp): what a host
// program would see of the real one, only slower.

#include "engine/driver/board_device.hpp"
#include "engine/model/signals/board_config.hpp"

#include <memory>

namespace rs::engine::model {

// Objects are loaded from the board's disk, with the time that it takes, or, `instant_loads`, put there at once.
std::unique_ptr<BoardDevice> make_simulated_board(const BoardConfig& config, bool instant_loads = false);

}  // namespace rs::engine::model
