#pragma once
// Runs rs-farm under mpirun, allowing root and more ranks than processors.

#include "tests/support/run_tool.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::test {

/// False if rs-farm was not built because MPI is missing.
inline bool has_farm() {
    return std::filesystem::exists(std::string(RAYSPACE_TOOLS_DIR) + "/rs-farm") &&
           std::system("command -v mpirun >/dev/null") == 0;
}

inline void allow_mpi_here() {
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    ::setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    ::setenv("OMPI_MCA_btl", "self,vader", 1);                        // single machine
    ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);  // not permitted in containers
    ::setenv("OMPI_MCA_plm_rsh_agent", "true", 1);                    // do not search for ssh
}

inline std::vector<std::string> farm_command(int ranks, const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"-n", std::to_string(ranks), std::string(RAYSPACE_TOOLS_DIR) + "/rs-farm"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

/// 0 ranks: without mpirun.
inline ToolRun run_farm(const std::filesystem::path& scratch, int ranks, const std::vector<std::string>& arguments) {
    allow_mpi_here();
    if (ranks == 0) return run_tool(scratch, "rs-farm", arguments);
    return run_program(scratch, "mpirun", farm_command(ranks, arguments));
}

}  // namespace rs::test
