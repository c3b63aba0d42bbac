#pragma once
// The hardware model as an executor of the conformance set.

#include "engine/conformance/run_vectors.hpp"

#include <string>

namespace rs::engine {

// `config`: as `rs-engine simulate` takes it. Declines objects and views that the board does not draw.
Result<Executor> board_executor(const std::string& config);

}  // namespace rs::engine
