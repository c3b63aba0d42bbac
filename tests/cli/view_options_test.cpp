// Options of rs-view that render: each changes the output of a small scene, or is refused by name. The tables must have
// a row for every option that --help lists.

#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace rs {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

enum class OptionEffect {
    kChanges,   // the written files
    kPermits,   // the command fails without the option
    kKeeps,     // the same files
    kIsRefused  // with an error that names the option
};

// Words are separated by spaces. IN/ is the folder of the inputs, OUT/ an empty one for each run, except for
// OUT/full/note.txt.
struct OptionCase {
    std::string option;
    std::string context;  // options that both runs have
    std::string given;    // the option with its value, and others that it needs
    OptionEffect effect = OptionEffect::kChanges;
};
using OptionCases = std::vector<OptionCase>;

constexpr const char* kWhittedPass = "--renderer whitted --passes 1";
constexpr const char* kToonPass = "--renderer toon --passes 1";

OptionCases joined_cases(std::initializer_list<OptionCases> lists) {
    OptionCases all;
    for (const OptionCases& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

OptionCases scene_cases() {
    return {{"--object", "", "--object IN/thing.rso@1,0,1"}, {"--lights", "", "--lights IN/lights.json"}};
}

OptionCases view_cases() {
    return {{"--viewpoint", "", "--viewpoint near"}, {"--eye", "", "--eye 1,2,5"}, {"--at", "", "--at 1,1,0"}};
}

OptionCases motion_cases() {
    return {{"--path", "", "--path IN/walk.json"}, {"--orbit", "-o OUT/x", "--orbit 2"}};
}

OptionCases renderer_cases() {
    return {{"--renderer", "", kWhittedPass},
            {"--exposure", "", "--exposure 1"},
            {"--relight", std::string(kWhittedPass) + " --lights IN/lights.json", "--relight off"},
            {"--soft-shadows", std::string(kWhittedPass) + " --lights IN/lights.json", "--soft-shadows"},
            {"--toon-style", kToonPass, "--toon-style IN/style.json"},
            {"--toon-lines", kToonPass, "--toon-lines 0.2"},
            {"--toon-objects", kToonPass, "--toon-objects"},
            {"--passes", "--renderer path --passes 1", "--passes 2"}};
}

OptionCases lens_cases() {
    return {{"--lens", kWhittedPass, "--lens 200 --focus 3"},
            {"--focus", std::string(kWhittedPass) + " --lens 200 --focus 3", "--focus 6"}};
}

// `tilted` selects a camera that is not level.
OptionCases drawing_cases(const std::string& tilted) {
    return {{"--samples", "", "--samples 1"},
            {"--shadows", "", "--shadows off"},
            {"--wire-frame", "", "--wire-frame"},
            {"--object-depth", "", "--object-depth pixel"},
            {"--object-samples", "", "--object-samples 1"},
            {"--upright", tilted, "--upright"},
            {"--executor", tilted, "--executor board:prototype-2000"},  // draws upright images
            {"--memory", "", "--memory 1"}};
}

OptionCases quiet_cases() {
    return {{"--quiet", "", "-q", OptionEffect::kKeeps}};
}

// Appends the words of `text`; an option that is already in `words` is replaced together with its values.
void set_options(std::vector<std::string>& words, const std::string& text) {
    const auto is_option = [](const std::string& word) { return word.starts_with("--") || word == "-o"; };
    std::istringstream stream(text);
    for (std::string word; stream >> word; words.push_back(word)) {
        if (!is_option(word)) continue;
        const auto found = std::find(words.begin(), words.end(), word);
        if (found != words.end()) words.erase(found, std::find_if(found + 1, words.end(), is_option));
    }
}

class ViewOptions : public testing::Test {
protected:
    ViewOptions() {
        test::SmallObjectOptions object;
        object.width = object.height = 256;  // more than 1 MiB in memory
        EXPECT_TRUE(write_object(work_ / "thing.rso", test::small_object_with_shape(object)));
        // The board shades the floor, and the box intersects the object.
        write(
            "hall.wrl",
            "#VRML V2.0 utf8\nNavigationInfo { headlight FALSE }\n"
            "Viewpoint { description \"front\" position 0 2 6 orientation 1 0 0 -0.25 }\n"
            "Viewpoint { description \"near\" position 0 1.5 3 }\n"
            "DirectionalLight { direction -0.3 -1 -0.2 }\n"
            "Shape { appearance DEF white Appearance { material Material { diffuseColor 1 1 1 } } "
            "geometry Box { size 20 .1 20 } }\n"
            "Transform { translation -1.2 2 1 children Shape { appearance USE white geometry Box { size 1 .1 1 } } }\n"
            "Transform { translation 0.8 1 0 children Shape { appearance Appearance { material Material { "
            "diffuseColor 1 0 0 } } geometry Box { size 1 1 1 } } }\n"
            "RaySpace { url \"thing.rso\" }\n");
        write("lights.json",
              R"({"replace": true, "lights": [{"kind": "rectangle", "location": [1, 4, 2], "aim": [0, -1, 0],
                  "size": [2, 2], "lumens": 3000}]})");
        write("style.json", R"({"thresholds": [], "values": [0.5]})");
        write("walk.json", R"({"camera": {"path": [{"eye": [1, 2, 5], "at": [0, 1, 0]},
                                                   {"eye": [2, 2, 5], "at": [0, 1, 0]}], "frames": 1}})");
        write("walls.json",
              R"({"walls": [{"name": "w", "lower_left": [-1, 0, -1], "lower_right": [1, 0, -1],
                             "upper_left": [-1, 1.5, -1], "pixels": [64, 48]}], "head": {"position": [0, 1, 0]}})");
        write("heads.json", R"({"heads": [{"position": [0.3, 1, 0.2]}]})");
        write("model.obj", "o Part\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write("frames.json", R"({"base": "hall.wrl", "models": ["model.obj"], "frames": ["f0.obj", "f1.obj"]})");
        write("f0.obj", "instance Part 0 1 2 0 0 0 1 1 1 -\ncamera 0 2 6 0 1 0 60\n");
        write("f1.obj", "instance Part 1 1 2 0 0 0 1 1 1 -\ncamera 0 2 5 0 1 0 60\n");
    }

    struct Outcome {
        test::ToolRun run;
        std::map<std::string, std::vector<std::byte>> files;
    };

    void write(const std::string& name, const std::string& text) const { std::ofstream(work_ / name) << text; }

    Outcome run(std::vector<std::string> words) const {
        const fs::path out = work_ / "out";
        fs::remove_all(out);
        fs::create_directories(out / "full");
        std::ofstream(out / "full" / "note.txt") << "kept";
        for (std::string& word : words) {
            word = std::regex_replace(word, std::regex("^IN/"), work_.path().string() + "/");
            word = std::regex_replace(word, std::regex("^OUT/"), out.string() + "/");
        }
        Outcome outcome{test::run_tool(scratch_.path(), "rs-view", words), {}};
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out)) {
            if (!entry.is_regular_file()) continue;
            outcome.files[fs::relative(entry.path(), out).string()] = read_file(entry.path(), 1 << 24).value();
        }
        return outcome;
    }

    void expect_all_options_in(const std::string& command, const OptionCases& cases) const {
        const test::ToolRun help = test::run_tool(scratch_.path(), "rs-view", {command, "--help"});
        ASSERT_EQ(help.exit_code, 0);
        std::set<std::string> listed;
        const std::regex option("--[a-z][a-z-]*");
        for (std::sregex_iterator i(help.out.begin(), help.out.end(), option), end; i != end; ++i)
            listed.insert(i->str());
        listed.erase("--help");
        EXPECT_GT(listed.size(), 20U) << help.out;
        for (const OptionCase& row : cases) listed.erase(row.option);
        EXPECT_THAT(listed, testing::IsEmpty()) << "each needs a row in the table of this test";
    }

    // `base`: the command with the options that every run has unless a row replaces them.
    void expect_effects(const std::string& base, const OptionCases& cases) const {
        expect_all_options_in(base.substr(0, base.find(' ')), cases);
        std::map<std::string, Outcome> without;  // [context]
        for (const OptionCase& row : cases) {
            SCOPED_TRACE(row.option);
            std::vector<std::string> words;
            set_options(words, base);
            set_options(words, row.context);
            std::vector<std::string> more = words;
            set_options(more, row.given);
            const Outcome with = run(more);
            if (with.run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << with.run.err;
            if (row.effect == OptionEffect::kIsRefused) {
                EXPECT_NE(with.run.exit_code, 0);
                EXPECT_THAT(with.run.err, HasSubstr(row.option));
                continue;
            }
            EXPECT_EQ(with.run.exit_code, 0) << with.run.err;
            if (!without.contains(row.context)) without[row.context] = run(words);
            const Outcome& before = without[row.context];
            EXPECT_EQ(before.run.exit_code == 0, row.effect != OptionEffect::kPermits) << before.run.err;
            EXPECT_EQ(before.files == with.files, row.effect == OptionEffect::kKeeps) << "effect on the written files";
        }
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

TEST_F(ViewOptions, OfRenderTakeEffect) {
    expect_effects("render IN/hall.wrl -o OUT/x.png --size 64x48",
                   joined_cases({scene_cases(),
                                 view_cases(),
                                 motion_cases(),
                                 renderer_cases(),
                                 lens_cases(),
                                 drawing_cases(""),
                                 quiet_cases(),
                                 {{"--output", "", "-o OUT/x"},
                                  {"--fov", "", "--fov 30"},
                                  {"--size", "", "--size 32x48"},
                                  {"--panorama", "--size 64x32", "--panorama"},
                                  {"--fps", "-o OUT/x.mp4 --orbit 2", "--fps 10"},
                                  {"--seconds", "--renderer path", "--seconds 0.02"},
                                  {"--streaming", "", "--streaming"},
                                  {"--stats", "", "--stats OUT/s.json"},
                                  {"--force", "-o OUT/full", "--force", OptionEffect::kPermits},
                                  {"--focus", "", "--focus 3", OptionEffect::kIsRefused}}}));
}

TEST_F(ViewOptions, OfWallsTakeEffect) {
    const std::string tabletop = "--display tabletop --size 64x48";
    expect_effects("walls IN/hall.wrl -o OUT/x --display IN/walls.json",
                   joined_cases({scene_cases(),
                                 view_cases(),
                                 motion_cases(),
                                 renderer_cases(),
                                 drawing_cases(tabletop),
                                 quiet_cases(),
                                 {{"--share", "", "--share 4250", OptionEffect::kIsRefused},
                                  {"--follow", "", "--follow 127.0.0.1:4250", OptionEffect::kIsRefused},
                                  {"--output", "", "-o OUT/y"},
                                  {"--display", "", "--display power-wall --size 64x48"},
                                  {"--wall", "--display cave --size 16x16", "--wall front"},
                                  {"--stereo", "", "--stereo anaglyph"},
                                  {"--eye-distance", "--stereo anaglyph", "--eye-distance 0.2"},
                                  {"--heads", "", "--heads IN/heads.json"},
                                  {"--size", "", "--size 32x48"},
                                  {"--seconds", "--renderer path", "--seconds 0.02"},
                                  {"--force", "-o OUT/full", "--force", OptionEffect::kPermits},
                                  {"--fov", "", "--fov 30", OptionEffect::kIsRefused}}}));
}

TEST_F(ViewOptions, OfQuiltTakeEffect) {
    expect_effects("quilt IN/hall.wrl -o OUT/x.png --layout 2x1 --tile-size 32x24",
                   joined_cases({scene_cases(),
                                 view_cases(),
                                 motion_cases(),
                                 renderer_cases(),
                                 drawing_cases(""),
                                 quiet_cases(),
                                 {{"--output", "", "-o OUT/y.png"},
                                  {"--layout", "", "--layout 1x2"},
                                  {"--tile-size", "", "--tile-size 24x24"},
                                  {"--cone", "", "--cone 20"},
                                  {"--fov", "", "--fov 30"},
                                  {"--lens", kWhittedPass, "--lens 200 --focus 3"},
                                  {"--focus", "", "--focus 3"},
                                  {"--seconds", "--renderer path", "--seconds 0.02"},
                                  {"--force", "-o OUT/full --orbit 2", "--force", OptionEffect::kPermits}}}));
}

TEST_F(ViewOptions, OfSequenceTakeEffect) {
    expect_effects("sequence IN/frames.json -o OUT/x.png --size 64x48",
                   joined_cases({view_cases(),
                                 renderer_cases(),
                                 lens_cases(),
                                 drawing_cases(""),
                                 quiet_cases(),
                                 {{"--share", "", "--share 4250", OptionEffect::kIsRefused},
                                  {"--follow", "", "--follow 127.0.0.1:4250", OptionEffect::kIsRefused},
                                  {"--lights", "", "--lights IN/lights.json"},
                                  {"--output", "", "-o OUT/x.jpg"},
                                  {"--frame", "", "--frame 1"},
                                  {"--fps", "-o OUT/x.mp4", "--fps 10"},
                                  {"--fov", "", "--fov 30"},
                                  {"--size", "", "--size 32x48"},
                                  {"--weather", "", "--weather rain"},
                                  {"--seed", "--weather rain", "--seed 2"},
                                  {"--visibility", "--weather fog", "--visibility 8"},
                                  {"--shutter", "--weather rain", "--shutter 0.5"},
                                  {"--shutter-samples", "--weather rain --shutter 1", "--shutter-samples 2"},
                                  {"--convert", "", "--convert true", OptionEffect::kIsRefused},
                                  {"--stats", "", "--stats OUT/s.json"},
                                  {"--force", "-o OUT/full", "--force", OptionEffect::kPermits}}}));
}

}  // namespace
}  // namespace rs
