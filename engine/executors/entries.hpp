#pragma once
// Entries of the executors that the library has (rayspace/api/types/executor_table.hpp).

#include "rayspace/api/types/executor_table.hpp"

#include <vector>

namespace rs::engine {

ExecutorEntry scalar_entry();  // reconstruct_scalar: the definition
ExecutorEntry core_entry();    // CoreExecutor
// The models of the boards; none where the build leaves out the hardware (RAYSPACE_HARDWARE).
std::vector<ExecutorEntry> hardware_entries();

}  // namespace rs::engine
