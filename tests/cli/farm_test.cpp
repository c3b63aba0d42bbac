// rs-farm as a user runs it: what it makes is what the tools make, byte for byte, by however many ranks.

#include "rayspace/format/object_file.hpp"
#include "rayspace/geometry/rig.hpp"
#include "tests/support/drawn_set.hpp"
#include "tests/support/run_mpi.hpp"
#include "tests/support/small_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace rs {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class FarmTool : public testing::Test {
protected:
    void SetUp() override {
        if (!test::has_farm()) GTEST_SKIP() << "rs-farm was not built, for there is no MPI";
    }
    std::string in(const std::string& name) const { return (work_ / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(work_ / name) << text; }
    test::ToolRun farm(int ranks, const std::vector<std::string>& arguments) const {
        return test::run_farm(scratch_.path(), ranks, arguments);
    }
    test::ToolRun tool(const std::string& name, const std::vector<std::string>& arguments) const {
        return test::run_tool(scratch_.path(), name, arguments);
    }
    std::string bytes_of(const std::string& name) const {
        std::ifstream file(work_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    // Of every file below, the name and the bytes.
    std::string tree_of(const std::string& name) const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(work_ / name)) {
            if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(work_ / name));
        }
        std::ranges::sort(files);
        std::string all;
        for (const fs::path& file : files) all += file.string() + "\n" + bytes_of(name + "/" + file.string());
        return all;
    }
    // Sets a, b, c of 8, 9, 10 images.
    void draw_sets() const {
        int count = 8;
        for (const char* const name : {"a", "b", "c"}) {
            Rig rig = make_ring({.count = count++, .fl_px = 60, .width = 48, .height = 40});
            rig.object_radius = 0.9;
            test::write_drawn_set(work_ / name, rig);
        }
    }
    const std::vector<std::string> small_ = {"--planes", "3", "--cells", "16x16"};

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST_F(FarmTool, EncodesAsTheEncoderDoesAndNothingTwice) {
    draw_sets();
    write("list.txt", "# two more\n" + in("b") + "\n\n" + in("c") + "/\n");
    for (const char* const name : {"a", "b", "c"}) {
        ASSERT_EQ(tool("rs-encode",
                       std::vector<std::string>{"build", in(name), "-q", "-o", in(std::string(name) + ".rso")} + small_)
                      .exit_code,
                  0);
    }
    for (const int ranks : {0, 1, 3}) {
        const std::string to = in("objects" + std::to_string(ranks));
        const std::vector<std::string> command =
            std::vector<std::string>{"encode", in("a"), "--list", in("list.txt"), "-o", to, "--json", "--"} + small_;
        const test::ToolRun first = farm(ranks, command);
        ASSERT_EQ(first.exit_code, 0) << first.err;
        EXPECT_EQ(nlohmann::json::parse(first.out).at("made"), 3);
        for (const char* const name : {"a", "b", "c"}) {
            const std::string file = std::string(name) + ".rso";
            EXPECT_EQ(bytes_of("objects" + std::to_string(ranks) + "/" + file), bytes_of(file)) << ranks << name;
        }
        const test::ToolRun again = farm(ranks, command);
        EXPECT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(nlohmann::json::parse(again.out).at("kept"), 3);
    }
}

TEST_F(FarmTool, WhatChangedIsDoneAnewAndOnlyThat) {
    draw_sets();
    const std::vector<std::string> command =
        std::vector<std::string>{"encode", in("a"), in("b"), in("c"), "-o", in("objects"), "--json", "--"} + small_;
    ASSERT_EQ(farm(2, command).exit_code, 0);
    ASSERT_TRUE(fs::copy_file(work_ / "b/3.png", work_ / "b/4.png", fs::copy_options::overwrite_existing));
    const auto changed = nlohmann::json::parse(farm(2, command).out);
    EXPECT_EQ(changed.at("made"), 1);
    EXPECT_EQ(changed.at("kept"), 2);
    ASSERT_EQ(tool("rs-encode", std::vector<std::string>{"build", in("b"), "-q", "-o", in("b.rso")} + small_).exit_code,
              0);
    EXPECT_EQ(bytes_of("objects/b.rso"), bytes_of("b.rso"));
    auto other = command;
    other.back() = "8x8";
    EXPECT_EQ(nlohmann::json::parse(farm(2, other).out).at("made"), 3);
}

TEST_F(FarmTool, BadItemsDoNotStopOthersAndAreTriedAgain) {
    draw_sets();
    const std::string whole = bytes_of("b/3.png");
    write("b/3.png", whole.substr(0, whole.size() / 2));
    const std::vector<std::string> command =
        std::vector<std::string>{"encode", in("a"), in("b"), in("nothing"), "-o", in("objects"), "--"} + small_;
    const test::ToolRun run = farm(2, command);
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("rs-farm: error: 2 of 3 items failed"));
    EXPECT_THAT(run.out, HasSubstr("failed  b: rs-encode: error: " + in("b/3.png")));
    EXPECT_THAT(run.out, HasSubstr("failed  nothing: rs-encode: error: " + in("nothing")));
    EXPECT_THAT(run.out, HasSubstr("3 items: 1 made, 0 kept, 2 failed"));
    EXPECT_FALSE(fs::exists(work_ / "objects/b.rso"));
    write("b/3.png", whole);
    EXPECT_THAT(farm(2, command).out, HasSubstr("3 items: 1 made, 1 kept, 1 failed"));
    EXPECT_TRUE(fs::exists(work_ / "objects/b.rso"));
}

TEST_F(FarmTool, WrongUsageIsSaidOnce) {
    draw_sets();
    const test::ToolRun tools = farm(2, {"encode", in("a"), in("b"), "-o", in("objects"), "--", "--planets", "3"});
    EXPECT_EQ(tools.exit_code, 1);
    EXPECT_THAT(tools.err, AllOf(HasSubstr("rs-farm: error: rs-encode: "), HasSubstr("--planets")));
    const auto times = [](const std::string& text, const std::string& what) {
        int count = 0;
        for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
        return count;
    };
    const test::ToolRun own = farm(2, {"encode", "-o", in("objects")});
    EXPECT_EQ(own.exit_code, 2);
    EXPECT_EQ(times(own.err, "no inputs; give capture sets"), 1) << own.err;
    const test::ToolRun report = farm(2, {"encode", in("a"), "-o", in("objects"), "--", "--report", "x.html"});
    EXPECT_EQ(report.exit_code, 1);
    EXPECT_THAT(report.err, HasSubstr("--report: is not for a farm"));
    fs::create_directories(work_ / "more");
    fs::copy(work_ / "a", work_ / "more/a", fs::copy_options::recursive);
    const test::ToolRun twins = farm(2, {"encode", in("a"), in("more/a"), "-o", in("objects")});
    EXPECT_EQ(twins.exit_code, 1);
    EXPECT_THAT(twins.err, HasSubstr("would be written as a.rso"));
    EXPECT_EQ(times(farm(3, {"--help"}).out, "Examples:"), 1);
}

TEST_F(FarmTool, SynthesisesAndImportsAsRsCaptureDoes) {
    for (const char* const name : {"vase", "lamp"}) {
        write(std::string(name) + ".json", std::string(R"({"name": ")") + name + R"(", "object": {"generator": ")" +
                                               name + R"("}, "environment": {"studio": {}}})");
    }
    const std::vector<std::string> photos = {"--as-photos", "--views", "12", "--size", "96x80", "--spp", "1"};
    for (const char* const name : {"vase", "lamp"}) {
        ASSERT_EQ(tool("rs-capture", std::vector<std::string>{"synth", in(std::string(name) + ".json"), "-q", "-o",
                                                              in(std::string("alone-") + name)} +
                                         photos)
                      .exit_code,
                  0);
    }
    const test::ToolRun synth =
        farm(2, std::vector<std::string>{"synth", in("vase.json"), in("lamp.json"), "-o", in("turns"), "--"} + photos);
    ASSERT_EQ(synth.exit_code, 0) << synth.err << synth.out;
    EXPECT_EQ(tree_of("turns/vase"), tree_of("alone-vase"));
    EXPECT_EQ(tree_of("turns/lamp"), tree_of("alone-lamp"));

    const std::vector<std::string> nominal = {"--calibration", "nominal"};
    ASSERT_EQ(tool("rs-capture",
                   std::vector<std::string>{"import", in("turns/vase/photos"), "-q", "-o", in("alone")} + nominal)
                  .exit_code,
              0);
    const test::ToolRun import =
        farm(2, std::vector<std::string>{"import", in("turns/vase/photos"), "-o", in("sets"), "--"} + nominal);
    ASSERT_EQ(import.exit_code, 0) << import.err << import.out;
    EXPECT_EQ(tree_of("sets/photos"), tree_of("alone"));
}

constexpr const char* kHall =
    "#VRML V2.0 utf8\n"
    "Viewpoint { position 0 1 7 }\n"
    "PointLight { location 1 3 2 }\n"
    "Shape { appearance Appearance { material Material { diffuseColor .8 .2 .1 } } geometry Sphere { radius 1.3 } }\n"
    "Transform { translation 0 -1.5 0 children Shape { appearance Appearance { material Material { diffuseColor .6 .7 "
    ".8 "
    "} } geometry Box { size 9 .2 9 } } }\n";

TEST_F(FarmTool, RendersTilesThatAreTheFrame) {
    write("hall.wrl", kHall);
    ASSERT_TRUE(write_object(work_ / "small.rso", test::small_object()).ok());
    for (const char* const method : {"path", "whitted", "radiosity"}) {
        const std::vector<std::string> options = {"--renderer", method,    "--passes", "2",
                                                  "--size",     "264x260", "--object", in("small.rso") + "@1,0,2"};
        const std::string name = std::string(method) + ".png";
        const test::ToolRun alone =
            tool("rs-view", std::vector<std::string>{in("hall.wrl"), "-q", "-o", in(name)} + options);
        if (alone.exit_code != 0 && alone.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << alone.err;
        ASSERT_EQ(alone.exit_code, 0) << alone.err;
        const std::vector<std::string> command =
            std::vector<std::string>{"render", in("hall.wrl"), "-o", in("farm-" + name), "--json", "--"} + options;
        const test::ToolRun run = farm(2, command);
        ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
        EXPECT_EQ(nlohmann::json::parse(run.out).at("made"), 5) << "four tiles and the frame";
        EXPECT_EQ(bytes_of("farm-" + name), bytes_of(name)) << method;
        EXPECT_EQ(nlohmann::json::parse(farm(1, command).out).at("kept"), 5);
    }
}

TEST_F(FarmTool, RendersAnOrbit) {
    write("hall.wrl", kHall);
    const std::vector<std::string> options = {"--renderer", "whitted", "--passes", "2",
                                              "--size",     "64x48",   "--orbit",  "3"};
    const test::ToolRun alone =
        tool("rs-view", std::vector<std::string>{in("hall.wrl"), "-q", "-o", in("orbit")} + options);
    if (alone.exit_code != 0 && alone.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << alone.err;
    ASSERT_EQ(alone.exit_code, 0) << alone.err;
    const test::ToolRun run =
        farm(2, std::vector<std::string>{"render", in("hall.wrl"), "-o", in("farm-orbit"), "--"} + options);
    ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
    EXPECT_EQ(tree_of("farm-orbit"), tree_of("orbit"));
}

}  // namespace
}  // namespace rs
