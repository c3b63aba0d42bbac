#include "rayspace/file/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

namespace rs {
namespace {

using testing::ElementsAre;

TEST(ChildProcess, LinesOfBothOutputs) {
    std::vector<std::string> lines;
    const Result<int> status = run_program({"sh", "-c", "echo one; echo; printf 'to stderr\nno end' >&2; exit 3"},
                                           [&](std::string_view line) { lines.emplace_back(line); });
    ASSERT_TRUE(status.ok()) << status.error().message;
    EXPECT_EQ(*status, 3);
    EXPECT_THAT(lines, ElementsAre("one", "", "to stderr", "no end"));
}

TEST(ChildProcess, ArgumentsAreNotExpandedAndStdinIsEmpty) {
    std::string text;
    const Result<int> status =
        run_program({"sh", "-c", "cat; echo \"$1\"", "sh", "$HOME *"}, [&](std::string_view line) { text += line; });
    ASSERT_TRUE(status.ok());
    EXPECT_EQ(*status, 0);
    EXPECT_EQ(text, "$HOME *");
}

TEST(ChildProcess, SignalAndMissingProgram) {
    const Result<int> killed = run_program({"sh", "-c", "kill -9 $$"});
    ASSERT_TRUE(killed.ok());
    EXPECT_EQ(*killed, 128 + SIGKILL);
    const Result<int> missing = run_program({"no-such-program-of-rayspace"}, [](std::string_view) {});
    ASSERT_FALSE(missing.ok());
    EXPECT_THAT(missing.error().message, testing::HasSubstr("No such file"));
}

}  // namespace
}  // namespace rs
