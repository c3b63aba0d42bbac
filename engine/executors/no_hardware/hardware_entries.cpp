#include "engine/executors/entries.hpp"

namespace rs::engine {

std::vector<ExecutorEntry> hardware_entries() {
    return {};
}

}  // namespace rs::engine
