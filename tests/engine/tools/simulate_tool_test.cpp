// Tests of `rs-engine simulate` on the command line.

#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/engine/model/parallel_test_objects.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace rs::engine::model {
namespace {

using rs::test::run_tool;
using rs::test::ToolRun;

TEST(SimulateTool, RendersWritesAndCompares) {
    const rs::test::TemporaryFolder scratch;
    const RaySpaceObject object = rs::test::ring_object({.views = 12, .planes = 6, .x_cells = 32, .u_cells = 32});
    const std::string file = (scratch / "ring.rso").string();
    ASSERT_TRUE(write_object(file, object).ok());
    const auto path = [&](const char* name) { return (scratch / name).string(); };
    const ToolRun run = run_tool(
        scratch.path(), "rs-engine",
        {"simulate", "prototype-2000", file, file, "--orbit", "3", "--size", "40x32", "--per-cycle", "2", "--load",
         "-o", path("drawn"), "--stats", path("stats.json"), "--chart", path("chart.svg"), "--trace", path("run.vcd")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("6 of 6 images equal the definition bit for bit"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("MByte/s"), std::string::npos);
    EXPECT_NE(run.out.find("limited by"), std::string::npos);
    const Result<Image<Rgba8>> image = read_image(scratch / "drawn/0005.png");
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(image->width(), 40);
    std::ifstream stats(path("stats.json"));
    EXPECT_EQ(nlohmann::json::parse(stats)["rendering_cycles"], 3);
    EXPECT_GT(std::filesystem::file_size(path("chart.svg")), 1000U);
    EXPECT_GT(std::filesystem::file_size(path("run.vcd")), 1000U);
}

// Names of the signals of a waveform, as GTKWave writes them.
std::set<std::string> signals_of(const std::string& vcd) {
    std::set<std::string> names;
    std::string scope, word, line;
    std::ifstream file(vcd);
    while (std::getline(file, line)) {
        std::istringstream words(line);
        words >> word;
        if (word == "$scope") {
            words >> word >> word;
            scope += word + ".";
        } else if (word == "$upscope") {
            scope.erase(scope.rfind('.', scope.size() - 2) + 1);
        } else if (word == "$var") {
            std::string name, bits;
            words >> word >> word >> word >> name >> bits;
            names.insert(scope + name + (bits == "$end" ? "" : bits));
        }
    }
    return names;
}

TEST(SimulateTool, RunsTheRtlWithTheCyclesOfTheModel) {
    const rs::test::TemporaryFolder scratch;
    const RaySpaceObject object = rs::test::ring_object({.views = 12, .planes = 6, .x_cells = 32, .u_cells = 32});
    const std::string file = (scratch / "ring.rso").string();
    ASSERT_TRUE(write_object(file, object).ok());
    const std::string vcd = (scratch / "run.vcd").string();
    const auto run = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"simulate", "prototype-2000", file, file, "--orbit", "3", "--size", "40x32",
                                         "--per-cycle", "2", "--trace-cycles", "100"});
        return run_tool(scratch.path(), "rs-engine", options);
    };
    EXPECT_EQ(run({"--rtl", "--stats", "stats.json"}).exit_code, 2);
    const ToolRun rtl = run({"--rtl", "--load", "--trace", vcd});
    if (rtl.exit_code != 0) {  // a build without Verilator
        EXPECT_NE(rtl.err.find("RAYSPACE_RTL=ON"), std::string::npos) << rtl.err;
        return;
    }
    EXPECT_NE(rtl.out.find("6 of 6 images equal the definition bit for bit"), std::string::npos) << rtl.out;
    const auto rates = [](const std::string& out) {
        const std::size_t first = out.find("drawing: ");
        return out.substr(first, out.find('\n', out.find("arriving")) - first);
    };
    EXPECT_EQ(rates(rtl.out), rates(run({"--load"}).out));

    const std::set<std::string> signals = signals_of(vcd);
    std::ifstream view(std::string(RAYSPACE_SOURCE_DIR) + "/engine/rtl/board.gtkw");
    int shown = 0;
    for (std::string line; std::getline(view, line);) {
        const std::string name = line.substr(line.find(' ') + 1);  // behind "+{alias} "
        if (name.rfind("TOP.", 0) != 0 || line[0] == '[') continue;
        EXPECT_TRUE(signals.contains(name)) << line;
        ++shown;
    }
    EXPECT_GT(shown, 40);

    const ToolRun other =
        run_tool(scratch.path(), "rs-engine", {"simulate", "prototype-2000-pci-x", file, "--orbit", "1", "--rtl"});
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_NE(other.err.find("verilated for prototype-2000"), std::string::npos) << other.err;
}

TEST(SimulateTool, RendersCompressedImages) {
    const rs::test::TemporaryFolder scratch;
    const std::string file = (scratch / "balls.rso").string();
    ASSERT_TRUE(write_object(file, test::encoded_object(12, 64).coded).ok());
    const ToolRun run =
        run_tool(scratch.path(), "rs-engine", {"simulate", "compressed-2000", file, "--orbit", "2", "--size", "40x32"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("2 of 2 images equal the definition bit for bit"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("160 slots"), std::string::npos) << run.out;
    const ToolRun refused =
        run_tool(scratch.path(), "rs-engine", {"simulate", "prototype-2000", file, "--orbit", "2", "--size", "40x32"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.err.find("use compressed-2000"), std::string::npos) << refused.err;
}

TEST(SimulateTool, RendersShapeMapsOnTheParallelBoard) {
    const rs::test::TemporaryFolder scratch;
    const std::string file = (scratch / "balls.rso").string();
    RaySpaceObject object = test::encoded_object(12, 64).coded;
    object.rings.front().shape = rs::test::small_shape(object, 0);
    ASSERT_TRUE(write_object(file, object).ok());
    const std::string config = (scratch / "two.json").string();
    std::ofstream(config) << R"({"base": "parallel", "pipes": 2})";
    const ToolRun run = run_tool(scratch.path(), "rs-engine",
                                 {"simulate", config, file, "--orbit", "2", "--size", "40x32", "--upright", "--stats",
                                  (scratch / "stats.json").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("2 of 2 images equal the definition bit for bit"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("memory channel 1: "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find(" of 320 MByte/s"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("_p1"), std::string::npos) << "blocks of all pipes are added up";
    std::ifstream stats(scratch / "stats.json");
    const nlohmann::json json = nlohmann::json::parse(stats);
    EXPECT_GT(json["memory_channel_1"]["bytes"], 1000);
    EXPECT_TRUE(json["rendering"]["blocks"].contains("texel_cache"));
    const ToolRun refused =
        run_tool(scratch.path(), "rs-engine", {"simulate", "compressed-2000", file, "--orbit", "2", "--upright"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.err.find("or use parallel"), std::string::npos) << refused.err;
}

// `rs-engine board` names objects that the board cannot draw.
TEST(EngineBoardTool, ObjectsThatCannotBeDrawnAreNamedWithTheRemedy) {
    const rs::test::TemporaryFolder scratch;
    const auto path = [&](const char* name) { return (scratch / name).string(); };
    ASSERT_TRUE(write_object(path("ring.rso"), rs::test::ring_object({.views = 8, .planes = 4})).ok());
    RaySpaceObject shaped = test::encoded_object(12, 64).coded;
    shaped.name = "shaped";
    shaped.rings.front().shape = rs::test::small_shape(shaped, 0);
    ASSERT_TRUE(write_object(path("shaped.rso"), shaped).ok());
    const auto board = [&](std::vector<std::string> options) {
        options.insert(options.begin(), "board");
        return run_tool(scratch.path(), "rs-engine", options);
    };
    const ToolRun all = board({path("ring.rso")});
    EXPECT_EQ(all.exit_code, 0) << all.err;
    EXPECT_NE(all.out.find("all fit on prototype-2000"), std::string::npos) << all.out;
    const ToolRun some = board({path("ring.rso"), path("shaped.rso")});
    EXPECT_EQ(some.exit_code, 1);
    EXPECT_EQ(some.out.find("all fit"), std::string::npos) << some.out;
    EXPECT_NE(some.err.find("shaped: its images are of profile board"), std::string::npos) << some.err;
    EXPECT_NE(some.err.find("--profile raw"), std::string::npos) << some.err;
    EXPECT_NE(some.err.find("--raymap plane"), std::string::npos) << some.err;
    EXPECT_NE(some.err.find("1 of 2 objects cannot be drawn by prototype-2000"), std::string::npos) << some.err;
    const ToolRun parallel = board({"--config", "parallel", path("ring.rso"), path("shaped.rso")});
    EXPECT_EQ(parallel.exit_code, 0) << parallel.err;
    EXPECT_NE(parallel.err.find("shaped: this board has only the bilinear texel filter"), std::string::npos)
        << parallel.err;
    EXPECT_NE(board({"--buses"}).out.find("`prototype-2000-pci-x`"), std::string::npos);
    EXPECT_EQ(board({}).exit_code, 2);
    EXPECT_EQ(board({"--buses", path("ring.rso")}).exit_code, 2);
}

TEST(SimulateTool, ReportsErrors) {
    const rs::test::TemporaryFolder scratch;
    const auto run = [&](std::vector<std::string> options) {
        options.insert(options.begin(), "simulate");
        return run_tool(scratch.path(), "rs-engine", options);
    };
    EXPECT_EQ(run({"prototype-2000"}).exit_code, 2);           // no object
    EXPECT_EQ(run({"prototype-2000", "a.rso"}).exit_code, 2);  // no views
    EXPECT_EQ(run({"prototype-1999", "a.rso", "--orbit", "3"}).exit_code, 1);
    EXPECT_EQ(run({"prototype-2000", "a.rso", "--orbit", "3"}).exit_code, 1);  // no such file
    const ToolRun diagram = run({"prototype-2000", "--diagram"});
    EXPECT_EQ(diagram.exit_code, 0);
    EXPECT_NE(diagram.out.find("| memory_controller |"), std::string::npos);
    EXPECT_NE(run({"prototype-2000", "--print-config"}).out.find("\"burst_words\": 4"), std::string::npos);
}

}  // namespace
}  // namespace rs::engine::model
