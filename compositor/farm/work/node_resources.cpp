#include "compositor/farm/work/node_resources.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

namespace rs::farm {
namespace {

// A number at the front of a file or text; nothing where there is none.
std::optional<std::int64_t> number_in(const char* path) {
    std::ifstream file(path);
    std::int64_t number = 0;
    if (file >> number) return number;
    return std::nullopt;
}

}  // namespace

WorkerNode this_node() {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    std::int64_t bytes = std::int64_t{::sysconf(_SC_PHYS_PAGES)} * ::sysconf(_SC_PAGESIZE);
    if (const auto container = number_in("/sys/fs/cgroup/memory.max")) bytes = std::min(bytes, *container);
    if (const char* const slurm_mib = std::getenv("SLURM_MEM_PER_NODE")) {
        const std::int64_t given = std::strtoll(slurm_mib, nullptr, 10) << 20;
        if (given > 0) bytes = std::min(bytes, given);
    }
    return {host, bytes};
}

std::vector<int> processors_of(int place, int places, std::optional<int> requested) {
    cpu_set_t set;
    CPU_ZERO(&set);
    std::vector<int> mine;
    if (::sched_getaffinity(0, sizeof set, &set) != 0) return mine;
    for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
        if (CPU_ISSET(static_cast<std::size_t>(processor), &set)) mine.push_back(processor);
    }
    const int count = static_cast<int>(mine.size());
    const bool bound = count < ::sysconf(_SC_NPROCESSORS_ONLN);
    const int share = requested.value_or(bound ? count : std::max(1, count / std::max(1, places)));
    if (share >= count) return mine;
    std::vector<int> some;
    for (int i = 0; i < share; ++i) some.push_back(mine[static_cast<std::size_t>((place * share + i) % count)]);
    std::ranges::sort(some);
    return some;
}

}  // namespace rs::farm
