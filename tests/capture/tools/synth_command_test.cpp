// Usage errors and failures of `rs-capture synth`.

#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rs::capture::test {
namespace {

using rs::test::ToolRun;
using testing::HasSubstr;

class SynthCommand : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(std::filesystem::path(RAYSPACE_TOOLS_DIR) / "rs-capture")) {
            GTEST_SKIP() << "rs-capture is not built";
        }
        std::ofstream(folder_ / "a.obj") << "v -1 -1 0\nv 1 -1 0\nv 0 1 0.5\nf 1 2 3\n";
    }

    [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }

    [[nodiscard]] ToolRun synth(const std::string& scene, const std::string& output,
                                std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"synth", scene, "-o", output, "-q"});
        ToolRun run = rs::test::run_tool(scratch_.path(), "rs-capture", arguments);
        EXPECT_EQ(std::ranges::count(run.err, '\n'), run.exit_code == 0 ? 0 : 1) << run.err;
        return run;
    }
    [[nodiscard]] ToolRun small(const std::string& scene, const std::string& output,
                                std::vector<std::string> more = {}) const {
        more.insert(more.end(), {"--views", "2", "--size", "16x12", "--spp", "1"});
        return synth(scene, output, more);
    }

    rs::test::TemporaryFolder folder_;
    rs::test::TemporaryFolder scratch_;
};

TEST_F(SynthCommand, WrongNumbersAreUsageErrorsBeforeAnythingIsRead) {
    // The scene does not exist, which would be a failure (exit code 1).
    for (const char* size : {"0x5", "12", "12x", "axb", "-3x4", "99999999x2"}) {
        const ToolRun run = synth(in("gone.obj"), in("set"), {"--size", size});
        EXPECT_EQ(run.exit_code, 2) << size;
        EXPECT_THAT(run.err, HasSubstr("--size"));
    }
    for (const char* seed : {"-1", "1.5", "010x", "", "18446744073709551616"}) {
        const ToolRun run = synth(in("gone.obj"), in("set"), {"--seed", seed});
        EXPECT_EQ(run.exit_code, 2) << seed;
        EXPECT_THAT(run.err, HasSubstr("--seed"));
    }
    for (const char* option : {"--distance", "--elevation", "--focal-widths", "--first-angle"}) {
        for (const char* value : {"nan", "-inf", "1e6"}) {
            const ToolRun run = synth(in("gone.obj"), in("set"), {option, value});
            EXPECT_EQ(run.exit_code, 2) << option << " " << value;
            EXPECT_THAT(run.err, HasSubstr(option));
        }
    }
    const ToolRun run = synth(in("gone.obj"), in("set"), {"--poses", in("gone.json"), "--size", "8x8"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(synth(in("gone.obj"), in("set"), {"--seed", "18446744073709551615", "--size", "8x8"}).exit_code, 1);
}

TEST_F(SynthCommand, PathsThatAreNotUtf8StayOutOfTheWayOfJson) {
    const ToolRun run = small(in("a.obj"), in("s\xFFt"), {"--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out).at("views"), 2);
}

TEST_F(SynthCommand, NeverReplacesTheFolderOfItsInput) {
    ASSERT_EQ(small(in("a.obj"), in("set")).exit_code, 0);
    ASSERT_EQ(small(in("a.obj"), in("set")).exit_code, 0) << "a set may be made again";
    std::filesystem::copy_file(folder_ / "a.obj", folder_ / "set" / "inside.obj");
    std::filesystem::create_symlink(folder_ / "set", folder_ / "link");
    std::filesystem::create_directories(folder_ / "elsewhere");
    std::filesystem::rename(folder_ / "set" / "transforms.json", folder_ / "elsewhere" / "poses.json");
    std::filesystem::create_symlink(folder_ / "elsewhere" / "poses.json", folder_ / "set" / "transforms.json");

    const auto expect_refused = [&](const ToolRun& run, const std::string& output, const std::string& input) {
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_THAT(run.err, HasSubstr(output + ": would overwrite"));
        EXPECT_THAT(run.err, HasSubstr(input));
    };
    expect_refused(small(in("set/inside.obj"), in("set")), "set", "inside.obj");
    expect_refused(small(in("set/inside.obj"), in("set/")), "set/", "inside.obj");
    expect_refused(small(in("set/inside.obj"), in("link")), "link", "inside.obj");
    expect_refused(small(in("link/inside.obj"), in("set")), "set", "inside.obj");
    expect_refused(small(in("link/inside.obj"), in("set/../set")), "set", "inside.obj");
    expect_refused(small(in("set/inside.obj"), folder_.path().string()), "", "inside.obj");
    expect_refused(synth(in("a.obj"), in("set"), {"--poses", in("set/transforms.json")}), "set", "transforms.json");
    expect_refused(synth(in("a.obj"), in("set"), {"--poses", in("set")}), "set", "set");
    expect_refused(synth(in("a.obj"), in("elsewhere"), {"--poses", in("set/transforms.json")}), "elsewhere",
                   "transforms.json");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "set" / "inside.obj"));
    // A name with the same prefix is another folder.
    EXPECT_EQ(small(in("set/inside.obj"), in("se")).exit_code, 0);
}

}  // namespace
}  // namespace rs::capture::test
