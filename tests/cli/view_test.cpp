// rs-view as a user runs it: scenes of all kinds, without a display.

#include "rayspace/picture_io.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace rs {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class View : public testing::Test {
protected:
    std::string in(const std::string& name) const { return (work_ / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(work_ / name) << text; }
    test::ToolRun view(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"-q", "--size", "64x48"});
        return test::run_tool(scratch_.path(), "rs-view", arguments);
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

constexpr const char* kWorld =
    "#VRML V2.0 utf8\nViewpoint { description \"far\" position 0 0 9 }\nViewpoint { description \"near\" position 0 0 "
    "3 }\n"
    "Shape { appearance Appearance { material Material { emissiveColor 1 0 0 gloss 3 } } geometry Box { } }\n";

int red_pixels(const std::string& file) {
    const auto picture = read_picture(file);
    if (!picture) return -1;
    return static_cast<int>(std::count_if(picture->pixels().begin(), picture->pixels().end(),
                                          [](const Rgba8& pixel) { return pixel.r > 200; }));
}

TEST_F(View, AWorldIsShownFromItsViewpoints) {
    write("hall.wrl", kWorld);
    const test::ToolRun run = view({in("hall.wrl"), "-o", in("far.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "rs-view: warning: " + in("hall.wrl") + ": line 4: Material has no field 'gloss'; left out\n");
    ASSERT_EQ(view({in("hall.wrl"), "-o", in("near.png"), "--viewpoint", "near"}).exit_code, 0);
    const int far = red_pixels(in("far.png"));
    EXPECT_GT(far, 20);
    EXPECT_GT(red_pixels(in("near.png")), 4 * far);
    const test::ToolRun unknown = view({in("hall.wrl"), "-o", in("x.png"), "--viewpoint", "roof"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.err, HasSubstr("it has 'far', 'near'"));
}

TEST_F(View, AModelIsShownWhole) {
    write("hall.obj", "v -50 0 0\nv 50 0 0\nv 0 80 0\nf 1 2 3\n");
    const test::ToolRun run = view({in("hall.obj"), "-o", in("shot.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, IsEmpty());
    EXPECT_GT(red_pixels(in("shot.png")), 300);
}

// Of a scene the rest is shown; what the command line asks for must be there.
TEST_F(View, AnObjectThatIsNotThereIsLeftOut) {
    write("hall.wrl", std::string(kWorld) + "RaySpace { url \"gone.rso\" }\nRaySpace { url \"gone.rso\" }\n");
    const test::ToolRun run = view({in("hall.wrl"), "-o", in("shot.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("gone.rso"));
    EXPECT_THAT(run.err, HasSubstr("shown without this object"));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2) << run.err;  // one for the file, one of the world
    EXPECT_GT(red_pixels(in("shot.png")), 20);
    const test::ToolRun asked = view({in("hall.wrl"), "--object", in("gone.rso"), "-o", in("other.png")});
    EXPECT_EQ(asked.exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(in("other.png")));
}

TEST_F(View, AWalkIsTakenFromItsFile) {
    write("hall.wrl", kWorld);
    write("walk.json",
          R"({"camera": {"path": [{"eye": [0, 0, 9], "at": [0, 0, 0]}, {"eye": [0, 0, 4], "at": [0, 0, 0]}],
                                      "frames": 3, "fov_degrees": 40}})");
    const test::ToolRun run =
        view({in("hall.wrl"), "--path", in("walk.json"), "-o", in("frames"), "--stats", in("s.json")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(in("frames/0002.png")));
    std::ifstream stats(in("s.json"));
    const std::string text((std::istreambuf_iterator<char>(stats)), {});
    EXPECT_THAT(text, HasSubstr("\"frames\": 3"));
    write("empty.json", "{}");
    const test::ToolRun none = view({in("hall.wrl"), "--path", in("empty.json"), "-o", in("x.png")});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.err, HasSubstr("has no camera path"));
}

TEST_F(View, WhatIsNoSceneIsRefusedOnOneLine) {
    write("broken.wrl", "#VRML V2.0 utf8\n\nGroup {\n children [\n");
    write("hall.txt", "hello");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"broken.wrl", "broken.wrl: line 4: the list of children"},
        {"hall.txt", "hall.txt: is no scene by its name"},
        {"gone.wrl", "gone.wrl"}};
    for (const auto& [name, expected] : cases) {
        const test::ToolRun run = view({in(name), "-o", in("shot.png")});
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_THAT(run.err, HasSubstr(expected));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(in("shot.png")));
    }
}

}  // namespace
}  // namespace rs
