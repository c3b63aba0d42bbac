// Command line of `rs-capture luminaire`.

#include "rayspace/file/file_output.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>

namespace rs {
namespace {

const std::string kDownlight =
    "IESNA:LM-63-2002\n[LUMCAT]<Sphere> & Co\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 10\n0 180\n0\n100 100\n";

TEST(LuminaireTool, PrintsLumensAndDrawsThePlot) {
    const test::TemporaryFolder scratch;
    const std::string file = (scratch / "even.ies").string();
    const std::string plot = (scratch / "even.svg").string();
    ASSERT_TRUE(write_file(file, kDownlight));
    const test::ToolRun run = test::run_tool(scratch.path(), "rs-capture", {"luminaire", file, "-o", plot});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("1256.6 lm, at most 100.0 cd, 10.0 W (125.7 lm/W); by zones 1256.64 lm"), std::string::npos)
        << run.out;
    const auto bytes = read_file(plot, 1 << 20);
    ASSERT_TRUE(bytes);
    const std::string svg(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    EXPECT_NE(svg.find("&lt;Sphere&gt; &amp; Co"), std::string::npos);
    EXPECT_EQ(svg.find("var(--"), std::string::npos);
    const test::ToolRun json = test::run_tool(scratch.path(), "rs-capture", {"luminaire", file, "--json"});
    const auto parsed = nlohmann::json::parse(json.out);
    EXPECT_NEAR(parsed["lumens"].get<double>(), 1256.637, 1e-3);
    EXPECT_EQ(parsed["keywords"][0][1], "<Sphere> & Co");
}

TEST(LuminaireTool, NamesUnreadableFilesAndWritesNothing) {
    const test::TemporaryFolder scratch;
    const std::string file = (scratch / "cut.ies").string();
    const std::string plot = (scratch / "cut.svg").string();
    ASSERT_TRUE(write_file(file, kDownlight.substr(0, kDownlight.size() - 4)));
    const test::ToolRun run = test::run_tool(scratch.path(), "rs-capture", {"luminaire", file, "-o", plot});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("cut.ies: line 7: the file ends before intensity 2"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(plot));
    EXPECT_EQ(test::run_tool(scratch.path(), "rs-capture", {"luminaire", file, "-o", "cut.png"}).exit_code, 2);
}

}  // namespace
}  // namespace rs
