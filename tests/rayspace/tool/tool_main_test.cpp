#include "rayspace/tool/tool_main.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <thread>

namespace {

using namespace rs;
using testing::HasSubstr;

struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;
};

Outcome run_tool(
    std::vector<std::string> arguments, const std::function<Status()>& work = [] { return Status{}; }) {
    CLI::App app{"A tool for this test.", "rs-test"};
    app.require_subcommand(1);
    std::function<Status()> run;
    std::string input;
    CLI::App* const render = app.add_subcommand("render", "Renders.");
    render->add_option("INPUT", input)->required();
    render->callback([&] { run = work; });

    arguments.insert(arguments.begin(), "rs-test");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Outcome outcome;
    outcome.exit_code = tool_main(app, static_cast<int>(argv.size()), argv.data(), run);
    outcome.out = testing::internal::GetCapturedStdout();
    outcome.err = testing::internal::GetCapturedStderr();
    return outcome;
}

TEST(ToolMain, SuccessIsSilent) {
    const Outcome done = run_tool({"render", "x"});
    EXPECT_EQ(done.exit_code, kExitOk);
    EXPECT_EQ(done.out + done.err, "");
}

TEST(ToolMain, HelpAndVersionGoToStdout) {
    const Outcome help = run_tool({"--help"});
    EXPECT_EQ(help.exit_code, kExitOk);
    EXPECT_THAT(help.out, HasSubstr("render"));
    EXPECT_EQ(help.err, "");
    const Outcome version = run_tool({"--version"});
    EXPECT_EQ(version.exit_code, kExitOk);
    EXPECT_THAT(version.out, testing::MatchesRegex("rayspace [0-9]+[.][0-9]+[.][0-9]+\n"));
    EXPECT_THAT(run_tool({"render", "--help"}).out, HasSubstr("INPUT"));
}

TEST(ToolMain, WrongUsageIsOneLineWithAHint) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{}, {"render"}, {"render", "x", "--nonsense"}, {"paint"}}) {
        const Outcome outcome = run_tool(arguments);
        EXPECT_EQ(outcome.exit_code, kExitUsage);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("--help"));
        EXPECT_THAT(outcome.err, testing::StartsWith("rs-test: "));
    }
    EXPECT_THAT(run_tool({"render"}).err, HasSubstr("rs-test render --help"));
}

TEST(ToolMain, ErrorsAreOneLine) {
    const Outcome outcome = run_tool({"render", "x"}, [] { return Status{Error{"a.png: broken:\n  line two\n"}}; });
    EXPECT_EQ(outcome.exit_code, kExitFailed);
    EXPECT_EQ(outcome.err, "rs-test: error: a.png: broken: line two\n");
}

TEST(ToolMain, EscapedExceptionsAreErrors) {
    EXPECT_EQ(run_tool({"render", "x"}, []() -> Status { throw std::runtime_error("deep\nwithin"); }).err,
              "rs-test: error: deep within\n");
    const Outcome memory = run_tool({"render", "x"}, []() -> Status { throw std::bad_alloc(); });
    EXPECT_EQ(memory.exit_code, kExitFailed);
    EXPECT_EQ(memory.err, "rs-test: error: out of memory\n");
}

// A child process that stages a file and a folder, interrupts itself, and would otherwise wait for a long time.
TEST(ToolMain, InterruptionLeavesNoPartialOutput) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const test::TemporaryFolder folder;
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            run_tool({"render", "x"}, [&]() -> Status {
                const auto file = StagedFile::create(folder / "a.png");
                const auto set = StagedFolder::create(folder / "set", "pictures");
                if (!file || !set) _exit(7);
                ::kill(::getpid(), signal);
                std::this_thread::sleep_for(std::chrono::seconds(20));
                return {};
            });
            _exit(8);
        }
        int how = 0;
        ASSERT_EQ(::waitpid(child, &how, 0), child);
        ASSERT_TRUE(WIFSIGNALED(how)) << how;
        EXPECT_EQ(WTERMSIG(how), signal);
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    }
}

TEST(ParseSize, TakesWidthTimesHeight) {
    const auto size = parse_size("640x480");
    ASSERT_TRUE(size.ok());
    EXPECT_EQ(size->width, 640);
    EXPECT_EQ(size->height, 480);
    EXPECT_TRUE(parse_size("1x8192").ok());
    for (const char* bad :
         {"", "640", "640x", "x480", "640X480", "640x480x3", " 640x480", "640x480 ", "6.5x4", "99999999999x1"}) {
        EXPECT_THAT(parse_size(bad).error().message, HasSubstr("such as 640x480")) << bad;
    }
    for (const char* bad : {"0x4", "4x0", "-4x4", "8193x1", "1x8193"}) {
        EXPECT_THAT(parse_size(bad).error().message, HasSubstr("1..8192")) << bad;
    }
}

TEST(ParseTriple, TakesThreeNumbers) {
    const auto triple = parse_triple("0.5,1,-2e1", "--eye");
    ASSERT_TRUE(triple.ok());
    EXPECT_EQ(triple->x, 0.5);
    EXPECT_EQ(triple->y, 1);
    EXPECT_EQ(triple->z, -20);
    for (const char* bad : {"", "1,2", "1,2,3,4", "1,2,", "1;2;3", "nan,0,0", "1,inf,2", "1,2,3x", "1e999,0,0"}) {
        EXPECT_THAT(parse_triple(bad, "--eye").error().message, HasSubstr("--eye")) << bad;
    }
}

TEST(ToolMain, NamesOfFilesToWriteEndAsTheyShould) {
    const auto page = ends_in({".html", ".htm"});
    EXPECT_EQ(page("a.html") + page("b/c.HTM") + page(".d.html"), "");
    for (const char* wrong : {"shoe.jpg", "noext", "html", "a.html/", ""}) {
        EXPECT_THAT(page(wrong), HasSubstr(std::string(wrong) + ": must end in .html")) << wrong;
    }
}

}  // namespace
