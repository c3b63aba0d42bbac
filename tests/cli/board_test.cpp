// Command line of `rs-capture board`.

#include "rayspace/image_io/image_io.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rs {
namespace {

TEST(BoardTool, WritesEachKindOfFile) {
    const test::TemporaryFolder scratch;
    for (const char* name : {"board.pdf", "board.svg", "board.png"}) {
        const std::string file = (scratch / name).string();
        const test::ToolRun run =
            test::run_tool(scratch.path(), "rs-capture", {"board", "-o", file, "--dpi", "100", "--blank-mm", "60"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.out.find("--board squares=9x9,square-mm=18"), std::string::npos) << run.out;
        EXPECT_GT(std::filesystem::file_size(file), 1000U);
    }
    const auto info = read_image_info(scratch / "board.png");
    ASSERT_TRUE(info);
    EXPECT_EQ(info->width, 780);
}

TEST(BoardTool, InvalidNumbersAreUsageErrorsAndUnprintableBoardsFail) {
    const test::TemporaryFolder scratch;
    const std::string file = (scratch / "board.pdf").string();
    const auto exit_code_with = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"board", "-o", file});
        return test::run_tool(scratch.path(), "rs-capture", options).exit_code;
    };
    EXPECT_EQ(exit_code_with({"--squares", "2"}), 2);
    EXPECT_EQ(exit_code_with({"--squares", "12"}), 2);  // too few markers in the dictionary
    EXPECT_EQ(exit_code_with({"--square-mm", "nan"}), 2);
    EXPECT_EQ(exit_code_with({"--paper", "napkin"}), 2);
    EXPECT_EQ(exit_code_with({"--square-mm", "30"}), 1);  // does not fit
    EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace rs
