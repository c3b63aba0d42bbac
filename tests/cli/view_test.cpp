// rs-view render, open, probe, lights and tile: scenes of all kinds, without a display.

#include "rayspace/file/file_output.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

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
    test::ToolRun view(const std::vector<std::string>& arguments) const {
        return test::run_tool(scratch_.path(), "rs-view", arguments);
    }
    test::ToolRun render(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "render");
        arguments.insert(arguments.end(), {"-q", "--size", "64x48"});
        return view(arguments);
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
    test::ToolRun run_;
};

constexpr const char* kWorld =
    "#VRML V2.0 utf8\nViewpoint { description \"far\" position 0 0 9 }\nViewpoint { description \"near\" position 0 0 "
    "3 }\n"
    "Shape { appearance Appearance { material Material { emissiveColor 1 0 0 gloss 3 } } geometry Box { } }\n";

int red_pixels(const std::string& file) {
    const auto image = read_image(file);
    if (!image) return -1;
    return static_cast<int>(std::count_if(image->pixels().begin(), image->pixels().end(),
                                          [](const Rgba8& pixel) { return pixel.r > 200; }));
}

TEST_F(View, AWorldIsShownFromItsViewpoints) {
    write("hall.wrl", kWorld);
    const test::ToolRun run = render({in("hall.wrl"), "-o", in("far.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "rs-view: warning: " + in("hall.wrl") + ": line 4: Material has no field 'gloss'; left out\n");
    ASSERT_EQ(render({in("hall.wrl"), "-o", in("near.png"), "--viewpoint", "near"}).exit_code, 0);
    const int far = red_pixels(in("far.png"));
    EXPECT_GT(far, 20);
    EXPECT_GT(red_pixels(in("near.png")), 4 * far);
    const test::ToolRun unknown = render({in("hall.wrl"), "-o", in("x.png"), "--viewpoint", "roof"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.err, HasSubstr("it has 'far', 'near'"));
}

TEST_F(View, AModelIsShownWhole) {
    write("hall.obj", "v -50 0 0\nv 50 0 0\nv 0 80 0\nf 1 2 3\n");
    const test::ToolRun run = render({in("hall.obj"), "-o", in("shot.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, IsEmpty());
    EXPECT_GT(red_pixels(in("shot.png")), 300);
}

// White floor under a lamp, with a board between the two whose shadow only tracing renderers draw.
constexpr const char* kShadedFloor =
    "#VRML V2.0 utf8\nViewpoint { position 0 6 0 orientation 1 0 0 -1.5708 }\n"
    "Shape { appearance DEF white Appearance { material Material { diffuseColor 1 1 1 } } geometry Box { size 20 .1 20 "
    "} }\n"
    "Transform { translation 2 3 0 children Shape { appearance USE white geometry Box { size 1 .1 1 } } }\n";
constexpr const char* kLamp =
    R"({"replace": true, "lights": [{"kind": "luminaire", "file": "lamp.ies", "location": [4, 6, 0]}]})";

TEST_F(View, LightIsTracedOnRequest) {
    write("hall.wrl", kShadedFloor);
    write("lamp.ies", "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 9\n0 180\n0\n9000 9000\n");
    write("evening.json", kLamp);
    const std::vector<std::string> base = {in("hall.wrl"), "--lights", in("evening.json")};
    const auto brightness = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments = base;
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.insert(arguments.end(), {"-o", in(name)});
        run_ = render(arguments);
        const auto image = run_.exit_code == 0 ? read_image(in(name)) : Result<Image<Rgba8>>(Error{run_.err});
        return image ? static_cast<int>((*image)(32, 24).g) : -1;
    };
    const int raster = brightness("raster.png", {"--shadows", "off"});
    if (raster < 0 && run_.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run_.err;
    ASSERT_GT(raster, 60) << run_.err;  // the middle lies in the board's shadow
    const int traced = brightness("traced.png", {"--renderer", "path", "--passes", "8"});
    EXPECT_GE(traced, 0) << run_.err;
    EXPECT_LT(traced, raster / 2);
    EXPECT_GE(brightness("brief.png", {"--renderer", "path", "--seconds", "0.1"}), 0) << run_.err;

    std::vector<std::string> probe = base;
    probe.insert(probe.begin(), "probe");
    probe.insert(probe.end(), {"--position", "0,1,0", "--passes", "2", "-q", "-o", in("probe.exr")});
    run_ = view(probe);
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    const auto info = read_image_info(in("probe.exr"));
    ASSERT_TRUE(info);
    EXPECT_EQ(info->width, 512);
}

TEST_F(View, StatsCountTheTracing) {
    write("hall.wrl", kShadedFloor);
    const auto stats = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {in("hall.wrl"), "--orbit", "2", "--stats", in("s.json")};
        arguments.insert(arguments.end(), {"-o", in("frames"), "--force"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        run_ = render(arguments);
        std::ifstream file(in("s.json"));
        return run_.exit_code == 0 ? nlohmann::json::parse(file) : nlohmann::json();
    };
    const nlohmann::json traced = stats({"--renderer", "whitted", "--passes", "3"});
    if (run_.exit_code != 0 && run_.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run_.err;
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_EQ(traced["passes"], 6);
    EXPECT_GT(traced["median_parts_ms"]["tracing"], 0.0);
    EXPECT_GE(traced["longest_ms"], traced["median_parts_ms"]["tracing"]);
    const nlohmann::json raster = stats({});
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_EQ(raster["passes"], 0);
    EXPECT_EQ(raster["median_parts_ms"]["tracing"], 0.0);
}

TEST_F(View, ToonShadingIgnoresTheExposure) {
    write("hall.wrl", kShadedFloor);
    write("evening.json", R"({"replace": true, "lights": [{"kind": "directional", "aim": [0, -1, 0], "lux": 2000}]})");
    const std::vector<std::string> base = {
        in("hall.wrl"), "--lights", in("evening.json"), "--renderer", "toon", "--passes", "1", "-o", in("x.png")};
    const auto tone = [&](std::vector<std::string> more) {
        more.insert(more.begin(), base.begin(), base.end());
        run_ = render(more);
        const auto image = run_.exit_code == 0 ? read_image(in("x.png")) : Result<Image<Rgba8>>(Error{run_.err});
        return image ? static_cast<int>((*image)(8, 24).g) : -1;
    };
    const int lit = tone({});
    if (lit < 0 && run_.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run_.err;
    EXPECT_EQ(lit, 255) << run_.err;
    EXPECT_EQ(tone({"--exposure", "-2"}), 255);
    EXPECT_EQ(tone({"--soft-shadows", "--toon-lines", "0", "--lens", "f/2", "--focus", "6"}), 255) << run_.err;
    EXPECT_EQ(tone({"--lens", "25"}), -1);
    EXPECT_EQ(run_.err, "rs-view: error: --lens 25: has no distance of focus; add --focus DISTANCE\n");
    EXPECT_EQ(tone({"--lens", "f/wide", "--focus", "2"}), -1);
    EXPECT_THAT(run_.err, HasSubstr("--lens f/wide: must be the diameter in mm, as 25, or an f-number, as f/2.8"));
    EXPECT_EQ(render({in("hall.wrl"), "--lens", "25", "--focus", "2", "-o", in("y.png")}).exit_code, 2);
}

TEST_F(View, ToonStylesAreReadFromFiles) {
    write("hall.wrl", kShadedFloor);
    write("style.json", R"({"thresholds": [], "values": [0.5]})");
    write("wrong.json", R"({"tones": 3})");
    const std::vector<std::string> base = {in("hall.wrl"), "--passes", "1", "-o", in("x.png")};
    const auto run = [&](std::vector<std::string> more) {
        more.insert(more.begin(), base.begin(), base.end());
        return run_ = render(more);
    };
    for (const char* const renderer : {"whitted", "raster"}) {
        EXPECT_EQ(run({"--renderer", renderer, "--toon-style", in("style.json")}).exit_code, 2);
        EXPECT_THAT(run_.err, HasSubstr("--toon-style needs --renderer toon"));
        EXPECT_EQ(run({"--renderer", renderer, "--toon-lines", "0.1"}).exit_code, 2);
        EXPECT_THAT(run_.err, HasSubstr("--toon-lines needs --renderer toon"));
    }
    EXPECT_EQ(run({"--renderer", "toon", "--toon-style", in("wrong.json")}).exit_code, 1);
    EXPECT_THAT(run_.err, HasSubstr(in("wrong.json") + ": has a key 'tones' that means nothing here"));
    run({"--renderer", "toon", "--toon-style", in("style.json")});
    if (run_.exit_code != 0 && run_.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run_.err;
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_NEAR(read_image(in("x.png")).value()(8, 24).g, 188, 1);  // the only tone, as sRGB
    EXPECT_EQ(view({"tile", "plan", in("hall.wrl"), "--toon-style", in("style.json"), "-o", in("p.json")}).exit_code,
              2);
}

TEST_F(View, InvalidLightListsAreRefused) {
    write("hall.wrl", kShadedFloor);
    write("evening.json", R"({"lights": [{"kind": "luminaire", "file": "none.ies", "location": [0, 1, 0]}]})");
    const test::ToolRun run = render({in("hall.wrl"), "--lights", in("evening.json"), "-o", in("x.png")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.err, "rs-view: error: " + in("evening.json") + ": lights[0].file: " + in("none.ies") +
                           ": cannot be opened: No such file or directory\n");
    EXPECT_FALSE(std::filesystem::exists(in("x.png")));
    EXPECT_EQ(view({"probe", in("hall.wrl"), "--position", "0,1,0", "-o", in("x.png")}).exit_code, 2);
    EXPECT_EQ(
        render({in("hall.wrl"), "--renderer", "path", "--passes", "2", "--seconds", "1", "-o", in("x.png")}).exit_code,
        2);
    EXPECT_EQ(render({in("hall.wrl"), "--passes", "2", "-o", in("x.png")}).exit_code, 2);
}

// rs-view lights merges a scene's lights with those of a list into one list that replaces them all.
TEST_F(View, SavedLightsGiveTheSameImage) {
    write("hall.wrl", std::string(kShadedFloor) +
                          "PointLight { location 0.3 0.8 0.2 intensity 0.4 color 1 0.9 0.7 attenuation 1 0.3 0.1 }\n"
                          "Transform { translation 0 0.5 0 children Shape { geometry Box { size 0.2 0.2 0.2 } } }\n");
    write("lamp.ies", "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 9\n0 180\n0\n9000 9000\n");
    write("lamp.json",
          R"({"lights": [{"kind": "luminaire", "file": "lamp.ies", "location": [0.4, 1.7, 0.1], "turn_deg": 12.34},
                         {"kind": "point", "name": "buried", "location": [0, 0.5, 0], "candela": 1},
                         {"kind": "disc", "name": "off", "location": [0, 1, 0], "aim": [0, -1, 0], "size": 0.1, "lumens": 0}]})");
    const test::ToolRun saved = view({"lights", in("hall.wrl"), "--lights", in("lamp.json"), "-o", in("all.json")});
    ASSERT_EQ(saved.exit_code, 0) << saved.err;
    EXPECT_THAT(saved.err, HasSubstr("'buried' is inside a solid"));
    EXPECT_THAT(saved.err, HasSubstr("'off' has no power"));
    const test::ToolRun run = render({in("hall.wrl"), "--lights", in("lamp.json"), "-o", in("a.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(render({in("hall.wrl"), "--lights", in("all.json"), "-o", in("b.png")}).exit_code, 0);
    EXPECT_EQ(read_image(in("a.png")).value(), read_image(in("b.png")).value());
    ASSERT_EQ(view({"lights", in("hall.wrl"), "--lights", in("all.json"), "-o", in("again.json")}).exit_code, 0);
    EXPECT_EQ(read_file(in("all.json"), 1 << 20).value(), read_file(in("again.json"), 1 << 20).value());
}

TEST_F(View, MissingObjectsAreSkipped) {
    write("hall.wrl", std::string(kWorld) + "RaySpace { url \"gone.rso\" }\nRaySpace { url \"gone.rso\" }\n");
    const test::ToolRun run = render({in("hall.wrl"), "-o", in("shot.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("gone.rso"));
    EXPECT_THAT(run.err, HasSubstr("shown without this object"));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 2)
        << run.err;  // one warning for the object, one for the scene
    EXPECT_GT(red_pixels(in("shot.png")), 20);
    const test::ToolRun required = render({in("hall.wrl"), "--object", in("gone.rso"), "-o", in("other.png")});
    EXPECT_EQ(required.exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(in("other.png")));
}

TEST_F(View, ObjectFilesAreScenes) {
    test::SmallObjectOptions options;
    options.width = options.height = 64;
    for (const char* name : {"a.rso", "b.rso"}) ASSERT_TRUE(write_object(work_ / name, test::small_object(options)));
    const test::ToolRun one = render({in("a.rso"), "-o", in("one.png")});
    if (one.exit_code != 0 && one.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << one.err;
    ASSERT_EQ(one.exit_code, 0) << one.err;
    ASSERT_EQ(render({in("a.rso"), in("b.rso"), "-o", in("two.png")}).exit_code, 0);
    EXPECT_NE(read_image(in("one.png")).value(), read_image(in("two.png")).value());
    write("hall.wrl", kWorld);
    const test::ToolRun mixed = render({in("hall.wrl"), in("b.rso"), "-o", in("x.png")});
    EXPECT_EQ(mixed.exit_code, 2);
    EXPECT_THAT(mixed.err, HasSubstr("give one scene"));
    const test::ToolRun over = render({in("a.rso"), in("b.rso"), "--force", "-o", in("b.rso")});
    EXPECT_NE(over.exit_code, 0);
}

TEST_F(View, CameraPathsAreReadFromAFile) {
    write("hall.wrl", kWorld);
    write("walk.json",
          R"({"camera": {"path": [{"eye": [0, 0, 9], "at": [0, 0, 0]}, {"eye": [0, 0, 4], "at": [0, 0, 0]}],
                                      "frames": 3, "fov_degrees": 40}})");
    const test::ToolRun run =
        render({in("hall.wrl"), "--path", in("walk.json"), "-o", in("frames"), "--stats", in("s.json")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(in("frames/0002.png")));
    std::ifstream stats(in("s.json"));
    const std::string text((std::istreambuf_iterator<char>(stats)), {});
    EXPECT_THAT(text, HasSubstr("\"frames\": 3"));
    write("empty.json", "{}");
    const test::ToolRun none = render({in("hall.wrl"), "--path", in("empty.json"), "-o", in("x.png")});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.err, HasSubstr("has no camera path"));
}

// Two rooms with one object each.
TEST_F(View, RoomsAreWalkedThroughWithinABudget) {
    test::SmallObjectOptions options;
    options.width = 256;
    options.height = 256;
    for (const char* name : {"a.rso", "b.rso"}) ASSERT_TRUE(write_object(work_ / name, test::small_object(options)));
    write("rooms.json",
          R"({"nodes": [{"room": [{"object": "a.rso"}], "bounds": {"centre": [0, 1, 0], "size": [8, 4, 8]}},
                        {"room": [{"object": "b.rso"}], "bounds": {"centre": [0, 1, 0], "size": [8, 4, 8]},
                         "translate": [0, 0, -40]}],
              "camera": {"path": [{"eye": [0, 1, 3.9], "at": [0, 1, 0]}, {"eye": [0, 1, -36.1], "at": [0, 1, -40]}],
                         "frames": 6}})");
    const auto stats_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {in("rooms.json"), "-o",        in("frames"), "--stats",
                                              in("s.json"),     "--samples", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::filesystem::remove_all(in("frames"));
        run_ = render(arguments);
        std::ifstream file(in("s.json"));
        return run_.exit_code == 0 ? nlohmann::json::parse(file) : nlohmann::json();
    };
    const nlohmann::json all = stats_of({});
    if (run_.exit_code != 0 && run_.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run_.err;
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_EQ(all["memory"]["loads"], 2);
    EXPECT_EQ(all["memory"]["evictions"], 0);
    EXPECT_EQ(all["missing"]["times"], 0);
    EXPECT_GT(all["views_by_core"], 5);
    const auto last = read_image(in("frames/0005.png"));
    ASSERT_TRUE(last);
    // An object takes 2 MiB, and about 5 MiB while it is read: 6 MiB do not suffice for one in memory and one being
    // read.
    const nlohmann::json one = stats_of({"--memory", "6"});
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_EQ(one["memory"]["evictions"], 1) << one;
    EXPECT_LE(one["memory"]["peak_bytes"], 6 << 20);
    EXPECT_EQ(*read_image(in("frames/0005.png")), *last) << "each room is complete when it is visible";
    const nlohmann::json streamed = stats_of({"--streaming", "--fps", "10"});
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_GE(streamed["memory"]["loads"], 1);
    EXPECT_EQ(streamed["frames"], 6);
    const nlohmann::json board = stats_of({"--executor", "board:prototype-2000"});
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_GT(board["views_by_board"], 0) << board;
    const nlohmann::json gpu = stats_of({"--executor", "gpu"});
    ASSERT_EQ(run_.exit_code, 0) << run_.err;
    EXPECT_GT(gpu["views_by_board"], 0) << gpu;
    EXPECT_EQ(*read_image(in("frames/0005.png")), *last);
    stats_of({"--executor", "board:none"});
    EXPECT_EQ(run_.exit_code, 1);
    stats_of({"--executor", "fpga"});
    EXPECT_THAT(run_.err, HasSubstr("use one of scalar, core, board:CONFIG, gpu"));
    stats_of({"--memory", "1"});
    EXPECT_EQ(run_.exit_code, 0);
    EXPECT_THAT(run_.err, HasSubstr("more than the budget of 1 MiB"));
}

TEST_F(View, AnObjectThatTheBoardCannotDrawIsNamedOnce) {
    ASSERT_TRUE(write_object(work_ / "shaped.rso", test::small_object_with_shape()));
    write("one.json",
          R"({"nodes": [{"object": "shaped.rso"}],
              "camera": {"path": [{"eye": [0, 1, 6], "at": [0, 1, 0]}, {"eye": [0, 1, 5], "at": [0, 1, 0]}],
                         "frames": 3}})");
    const test::ToolRun run =
        render({in("one.json"), "-o", in("frames"), "--samples", "1", "--executor", "board:prototype-2000"});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("small: has a shape map"));
    const std::string sentence = "drawn by the core, not by board:prototype-2000";
    const std::size_t first = run.err.find(sentence);
    ASSERT_NE(first, std::string::npos) << run.err;
    EXPECT_EQ(run.err.find(sentence, first + 1), std::string::npos) << run.err;
}

TEST_F(View, OtherFilesAreRefusedInOneLine) {
    write("broken.wrl", "#VRML V2.0 utf8\n\nGroup {\n children [\n");
    write("hall.txt", "hello");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"broken.wrl", "broken.wrl: line 4: the list of children"},
        {"hall.txt", "hall.txt: has no extension of a scene"},
        {"gone.wrl", "gone.wrl"}};
    for (const auto& [name, expected] : cases) {
        const test::ToolRun run = render({in(name), "-o", in("shot.png")});
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_THAT(run.err, HasSubstr(expected));
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(in("shot.png")));
    }
}

TEST_F(View, WithoutAWindowTheFirstViewIsWritten) {
    write("hall.wrl", kWorld);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(work_.path());
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const test::ToolRun run = view({in("hall.wrl"), "--size", "64x48"});
    setenv("LIBGL_DRIVERS_PATH", work_.path().c_str(), 1);
    const test::ToolRun without_drivers = view({"open", in("hall.wrl"), "--size", "64x48"});
    unsetenv("LIBGL_DRIVERS_PATH");
    std::filesystem::current_path(before);
    EXPECT_EQ(without_drivers.exit_code, 1);
    EXPECT_THAT(without_drivers.err, HasSubstr("install Mesa's EGL"));
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("window: "));
    EXPECT_THAT(run.err, HasSubstr("the first view goes to ./screenshot-1.png"));
    EXPECT_GT(red_pixels(in("screenshot-1.png")), 20);
}

// The help of every subcommand fits on a screen and has an example; its options are not accepted elsewhere.
TEST_F(View, HelpOfEachSubcommandFitsOnAScreen) {
    const std::vector<std::vector<std::string>> commands = {
        {"open"},   {"render"}, {"quilt"}, {"walls"},        {"sequence"},      {"probe"},           {"lights"},
        {"export"}, {"page"},   {"tile"},  {"tile", "plan"}, {"tile", "trace"}, {"tile", "assemble"}};
    for (std::vector<std::string> command : commands) {
        command.emplace_back("--help");
        const test::ToolRun help = view(command);
        SCOPED_TRACE(help.out);
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_LE(std::count(help.out.begin(), help.out.end(), '\n'), 40);
        EXPECT_THAT(help.out, HasSubstr("Example"));
    }
}

// Four walls lit by a headlight. A direction ahead of 20 degrees from a wall's normal puts the borders of the
// panorama's faces within walls.
TEST_F(View, PanoramasShowAllDirections) {
    std::string walls = "#VRML V2.0 utf8\n";
    for (const char* const wall : {"3 0 0", "-3 0 0", "0 0 3", "0 0 -3"})
        walls += std::string("Transform { translation ") + wall +
                 " children Shape { appearance Appearance { material Material { } } geometry Box { size " +
                 (wall[0] == '0' ? "6 6 0.2" : "0.2 6 6") + " } } }\n";
    write("walls.wrl", walls);
    const std::vector<std::string> common = {"render", in("walls.wrl"), "--eye", "0,0,0", "--at=0.364,0,-1", "-q"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), common.begin(), common.end());
        return view(more);
    };
    const test::ToolRun run = with({"--panorama", "--size", "256x128", "-o", in("all.png")});
    if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto image = read_image(in("all.png"));
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width(), 256);
    ASSERT_EQ(image->height(), 128);
    // The wall at +X spans 90 degrees about column 178; the border of the faces ahead and at the right is at 160.
    for (int x = 150; x < 205; ++x) {
        EXPECT_NEAR((*image)(x, 64).g, (*image)(x + 1, 64).g, 4) << x;
        EXPECT_GT((*image)(x, 64).g, 100) << x;
    }
    EXPECT_EQ(with({"--panorama", "--orbit", "2", "--size", "64x32", "-o", in("turn")}).exit_code, 1)
        << "the headlight cannot follow";
    write("lamp.json", R"({"lights": [{"kind": "point", "location": [0, 0, 0], "candela": 400}], "replace": true})");
    const test::ToolRun turn =
        with({"--panorama", "--orbit", "2", "--size", "64x32", "--lights", in("lamp.json"), "-o", in("turn")});
    ASSERT_EQ(turn.exit_code, 0) << turn.err;
    EXPECT_TRUE(std::filesystem::exists(work_ / "turn" / "0001.png"));
    EXPECT_FALSE(std::filesystem::exists(work_ / "turn" / "transforms.json")) << "no pinhole camera has these images";
    const test::ToolRun traced = with({"--panorama", "--size", "64x32", "--renderer", "radiosity", "--passes", "1",
                                       "--lights", in("lamp.json"), "-o", in("traced.png")});
    ASSERT_EQ(traced.exit_code, 0) << traced.err;
    EXPECT_EQ(read_image(in("traced.png")).value().width(), 64);
    // Lines of cartoons have a default width.
    const auto toon = [&](const std::string& length) {
        std::vector<std::string> arguments = {"--panorama", "--size",       "256x128",
                                              "--renderer", "toon",         "--passes",
                                              "1",          "-o",           in("toon" + length + ".png"),
                                              "--lights",   in("lamp.json")};
        if (!length.empty()) arguments.insert(arguments.end(), {"--toon-lines", length});
        const test::ToolRun drawn = with(arguments);
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return read_image(in("toon" + length + ".png")).value();
    };
    EXPECT_NE(toon(""), toon("0"));
}

TEST_F(View, PanoramasRefuseOptionsOfOneView) {
    write("hall.wrl", kWorld);
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"--fov", "60"}, "--fov cannot be used with --panorama"},
        {{"--renderer", "path", "--lens", "f/2", "--focus", "2"}, "--lens cannot be used with --panorama"},
        {{"--focus", "2"}, "--focus needs --lens"},
        {{"--streaming"}, "--streaming cannot be used with --panorama"},
        {{"--stats", "x.json"}, "--stats cannot be used with --panorama"}};
    for (const auto& [more, expected] : cases) {
        std::vector<std::string> arguments = {"render", in("hall.wrl"), "--panorama", "-o", in("x.png")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::ToolRun refused = view(arguments);
        EXPECT_EQ(refused.exit_code, 2) << expected;
        EXPECT_THAT(refused.err, HasSubstr(expected));
    }
    const test::ToolRun refused = render({in("hall.wrl"), "--panorama", "-o", in("x.png")});  // 64x48
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("--size 64x48: a panorama is twice as wide as high; give 64x32"));
}

TEST_F(View, OldFlagsNameTheirSubcommand) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"hall.wrl", "-o", "x.png"}, "use 'rs-view render SCENE -o FILE'"},
        {{"hall.wrl", "--quilt", "5x9", "-o", "x.png"}, "use 'rs-view quilt SCENE --layout COLSxROWS'"},
        {{"hall.wrl", "--walls=cave"}, "use 'rs-view walls SCENE --display"},
        {{"--sequence", "town"}, "use 'rs-view sequence FOLDER'"},
        {{"hall.wrl", "--probe=0,0,0", "-o", "x.exr"}, "use 'rs-view probe SCENE --position X,Y,Z'"},
        {{"hall.wrl", "--save-lights", "x.json"}, "use 'rs-view lights SCENE -o FILE.json'"},
        {{"hall.wrl", "--tile", "0:0,0,8x8", "-o", "x.png"}, "use 'rs-view tile trace SCENE"},
        {{"hall.wrl", "--first-grid", "0"}, "--first-grid"},
    };
    for (const auto& [arguments, advice] : cases) {
        const test::ToolRun refused = view(arguments);
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr(advice));
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
}

// Separately traced tiles assemble to a frame that is bit-identical to one traced as a whole.
TEST_F(View, AssembledTilesEqualTheFrame) {
    write("hall.wrl", kShadedFloor);
    ASSERT_TRUE(write_object(work_ / "small.rso", test::small_object()).ok());
    const std::vector<std::string> frames = {in("hall.wrl"),
                                             "--object",
                                             in("small.rso") + "@1,0,2",
                                             "--orbit",
                                             "2",
                                             "--size",
                                             "64x48",
                                             "--renderer",
                                             "whitted",
                                             "--passes",
                                             "2",
                                             "--exposure",
                                             "2",
                                             "-q"};
    const auto with = [&](std::vector<std::string> command, const std::vector<std::string>& more) {
        command.insert(command.end(), frames.begin(), frames.end());
        command.insert(command.end(), more.begin(), more.end());
        run_ = view(command);
        return run_.exit_code;
    };
    const int whole = with({"render"}, {"-o", in("whole")});
    if (whole != 0 && run_.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run_.err;
    ASSERT_EQ(whole, 0) << run_.err;
    ASSERT_EQ(with({"tile", "plan"}, {"-o", in("plan.json")}), 0) << run_.err;
    std::ifstream file(in("plan.json"));
    EXPECT_EQ(nlohmann::json::parse(file), nlohmann::json({{"frames", 2}, {"width", 64}, {"height", 48}}));
    std::filesystem::create_directory(work_ / "tiles");
    EXPECT_EQ(with({"tile", "assemble"}, {"--tiles", in("tiles"), "-o", in("assembled")}), 1);
    EXPECT_THAT(run_.err, HasSubstr("lacks tiles of frame 0"));
    for (const std::string frame : {"0", "1"}) {
        for (const auto& [name, tile] : {std::pair{"-0-0.png", ":0,0,40x48"}, std::pair{"-40-0.png", ":40,0,24x48"}}) {
            ASSERT_EQ(with({"tile", "trace"}, {"--tile", frame + tile, "-o", in("tiles/" + frame + name)}), 0)
                << run_.err;
        }
    }
    ASSERT_EQ(with({"tile", "assemble"}, {"--tiles", in("tiles"), "-o", in("assembled")}), 0) << run_.err;
    for (const char* const name : {"0000.png", "0001.png"}) {
        EXPECT_EQ(read_image(work_ / "assembled" / name).value(), read_image(work_ / "whole" / name).value());
    }
    EXPECT_EQ(with({"tile", "trace"}, {"--tile", "2:0,0,8x8", "-o", in("x.png")}), 1);
    EXPECT_THAT(run_.err, HasSubstr("there are 2 frames"));
}

}  // namespace
}  // namespace rs
