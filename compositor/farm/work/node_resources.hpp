#pragma once
// What of its node a rank may use.

#include "compositor/farm/schedule/worker.hpp"

#include <optional>
#include <vector>

namespace rs::farm {

// The host's name, and the memory that system, container and Slurm leave to all ranks of it together.
WorkerNode this_node();

// The processors for the items of the `place`-th of `places` ranks of a node: `requested` of them; without that those
// that MPI or Slurm bound the rank to, or where it is not bound an equal share. At least one.
std::vector<int> processors_of(int place, int places, std::optional<int> requested);

}  // namespace rs::farm
