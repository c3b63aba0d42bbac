#pragma once
// Built-in entries of the executor table (rayspace/api/types/executor_table.hpp).

#include "rayspace/api/types/executor_table.hpp"

#include <vector>

namespace rs::engine {

ExecutorEntry scalar_entry();  // reconstruct_scalar: the scalar definition
ExecutorEntry core_entry();    // CoreExecutor
// Models of the boards; empty in builds without RAYSPACE_HARDWARE.
std::vector<ExecutorEntry> hardware_entries();

}  // namespace rs::engine
