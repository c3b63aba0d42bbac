// Numbers out of range on the command line of `rs-capture import` are usage errors, reported before any work.

#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rs {
namespace {

TEST(ImportUsage, NumbersOutOfRangeAreUsageErrors) {
    const test::TemporaryFolder scratch;
    const std::string photos = (scratch / "nowhere").string();
    const std::string set = (scratch / "set").string();
    const auto exit_code_with = [&](const std::string& option, const std::string& value) {
        const test::ToolRun run =
            test::run_tool(scratch.path(), "rs-capture", {"import", photos, "-o", set, "-q", option, value});
        if (run.exit_code == 2) {
            EXPECT_NE(run.err.find(option), std::string::npos) << run.err;
        }
        return run.exit_code;
    };
    for (const char* fov : {"0.5", "121", "-25", "wide"}) EXPECT_EQ(exit_code_with("--fov", fov), 2) << fov;
    for (const char* step : {"0", "-10", "181", "ten"}) {
        EXPECT_EQ(exit_code_with("--degrees-per-view", step), 2) << step;
    }
    // In range: only the folder is invalid.
    for (const char* fov : {"1", "120"}) EXPECT_EQ(exit_code_with("--fov", fov), 1) << fov;
    for (const char* step : {"0.01", "180"}) EXPECT_EQ(exit_code_with("--degrees-per-view", step), 1) << step;
}

}  // namespace
}  // namespace rs
