#pragma once
// All executors, by the names that --executor takes. A new one is a class (engine/core/definition/executor.hpp) and a
// row of the table.

#include "engine/core/definition/executor.hpp"

#include <memory>
#include <string>

namespace rs::engine {

struct ExecutorOptions {
    bool instant_loads = false;  // objects are in a modelled board's memory at once, not over its modelled disk
};

// `name` is one of executor_names(), CONFIG as `rs-engine simulate` takes it. Errors name what is valid.
Result<std::unique_ptr<Executor>> make_executor(const std::string& name, const ExecutorOptions& options = {});

std::string executor_names();  // "scalar, core, board:CONFIG"

}  // namespace rs::engine
