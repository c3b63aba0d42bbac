#pragma once
// rs-farm under mpirun, as root and on fewer processors than ranks, as tests run.

#include "tests/support/run_tool.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace rs::test {

// False where it was not built, for there is no MPI.
inline bool has_farm() {
    return std::filesystem::exists(std::string(RAYSPACE_TOOLS_DIR) + "/rs-farm") &&
           std::system("command -v mpirun >/dev/null") == 0;
}

inline void allow_mpi_here() {
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    ::setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    ::setenv("OMPI_MCA_btl", "self,vader", 1);                        // of one machine
    ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);  // which containers refuse
    ::setenv("OMPI_MCA_plm_rsh_agent", "true", 1);                    // no ssh is looked for
}

inline std::vector<std::string> farm_command(int ranks, const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"-n", std::to_string(ranks), std::string(RAYSPACE_TOOLS_DIR) + "/rs-farm"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

// 0 ranks: without mpirun.
inline ToolRun run_farm(const std::filesystem::path& scratch, int ranks, const std::vector<std::string>& arguments) {
    allow_mpi_here();
    if (ranks == 0) return run_tool(scratch, "rs-farm", arguments);
    return run_program(scratch, "mpirun", farm_command(ranks, arguments));
}

}  // namespace rs::test
