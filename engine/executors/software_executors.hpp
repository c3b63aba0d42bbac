#pragma once
// Executors without hardware, modelled or real: they take every object and every view.

#include "engine/core/definition/executor.hpp"

#include <memory>

namespace rs::engine {

std::unique_ptr<Executor> make_scalar_executor();  // reconstruct_scalar: the definition
std::unique_ptr<Executor> make_core_executor();    // CoreExecutor

}  // namespace rs::engine
