// rs-view walls and rs-view quilt.

#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/udp_sender.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace rs {
namespace {

using ::testing::HasSubstr;

constexpr const char* kBoxWorld =
    "#VRML V2.0 utf8\nViewpoint { position 0 1.5 4 }\n"
    "Transform { translation 0 1.5 0 children Shape { appearance Appearance { material Material { emissiveColor 1 0 0 "
    "} } "
    "geometry Box { size 1 1 1 } } }\n";

class Displays : public testing::Test {
protected:
    void SetUp() override {
        write("hall.wrl", kBoxWorld);
        const test::ToolRun run = view({"render", in("hall.wrl"), "--size", "16x16", "-o", in("probe.png")});
        if (run.exit_code != 0 && run.err.find("OpenGL: ") != std::string::npos) GTEST_SKIP() << run.err;
        ASSERT_EQ(run.exit_code, 0) << run.err;
    }
    std::string in(const std::string& name) const { return (work_ / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(work_ / name) << text; }
    test::ToolRun view(std::vector<std::string> arguments) const {
        arguments.emplace_back("-q");
        return test::run_tool(scratch_.path(), "rs-view", arguments);
    }
    Image<Rgba8> image(const std::string& name) const {
        auto read = read_image(in(name));
        EXPECT_TRUE(read.ok()) << read.error().message;
        return read ? std::move(*read) : Image<Rgba8>();
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(work_ / name); }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

TEST_F(Displays, EachWallIsAImage) {
    test::ToolRun run = view({"walls", in("hall.wrl"), "--display", "cave", "--size", "40x40", "-o", in("cave")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* name : {"left", "front", "right", "floor"})
        EXPECT_TRUE(exists(std::string("cave/") + name + ".png"));
    // The box is straight ahead.
    const Image<Rgba8> front = image("cave/front.png");
    ASSERT_EQ(front.width(), 40);
    EXPECT_GT(front(20, 17).r, 200);
    EXPECT_LT(image("cave/left.png")(20, 17).r, 50);
    const auto rig = read_rig(in("cave"));
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->views.size(), 4U);
    EXPECT_NEAR(rig->views[1].camera.fl_x, 20, 1e-9);

    run = view({"walls", in("hall.wrl"), "--display", "cave", "--wall", "front", "--size", "40x40", "--stereo",
                "side-by-side", "-o", in("pair")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(image("pair/front.png").width(), 80);
    EXPECT_FALSE(exists("pair/left.png"));
}

TEST_F(Displays, StereoAloneMeansTwoFolders) {
    const test::ToolRun run =
        view({"walls", in("hall.wrl"), "--display", "power-wall", "--size", "32x18", "-o", in("two"), "--stereo"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(image("two/left/front.png"), image("two/right/front.png"));
    EXPECT_EQ(read_rig(in("two"))->views.size(), 2U);
}

TEST_F(Displays, HeadsMoveFrameByFrameAndNotThroughWalls) {
    write("walls.json",
          R"({"walls": [{"name": "w", "lower_left": [-1, 0, -1], "lower_right": [1, 0, -1], "upper_left": [-1, 2, -1],
              "pixels": [32, 32]}], "head": {"position": [0, 1, 0]}})");
    write("heads.json", R"({"heads": [{"position": [-0.5, 1, 0]}, {"position": [0.5, 1, 0]}]})");
    test::ToolRun run =
        view({"walls", in("hall.wrl"), "--display", in("walls.json"), "--heads", in("heads.json"), "-o", in("walk")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(image("walk/w/0000.png"), image("walk/w/0001.png"));

    write("heads.json", R"({"heads": [{"position": [0, 1, 0]}, {"position": [0, 1, -1.4]}]})");
    run = view({"walls", in("hall.wrl"), "--display", in("walls.json"), "--heads", in("heads.json"), "-o", in("no")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("heads.json: head 1: an eye is 0.4 m behind wall 'w'"));
    EXPECT_FALSE(exists("no"));
}

// Sends a head pose repeatedly, like a tracker.
class Tracker {
public:
    Tracker(std::uint16_t port, const std::array<double, 6>& head)
        : thread_([port, head](const std::stop_token& stop) {
              test::UdpSender sender(port);
              while (!stop.stop_requested()) {
                  sender.send(head);
                  std::this_thread::sleep_for(std::chrono::milliseconds(20));
              }
          }) {}

private:
    std::jthread thread_;
};

TEST_F(Displays, ImagesUseTheTrackedHead) {
    write("walls.json",
          R"({"walls": [{"name": "w", "lower_left": [-1, 0, -1], "lower_right": [1, 0, -1], "upper_left": [-1, 2, -1],
              "pixels": [32, 32]}], "head": {"position": [0, 1, 0]}})");
    write("heads.json", R"({"heads": [{"position": [0.4, 1.1, 0.5]}]})");
    test::ToolRun run = view(
        {"walls", in("hall.wrl"), "--display", in("walls.json"), "--heads", in("heads.json"), "-o", in("by-file")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::uint16_t port = test::OccupiedPort().number();
    const std::string udp = "udp:" + std::to_string(port);
    {
        const Tracker tracker(port, {40, 10, 50, 0, 0, 0});
        run = view({"walls", in("hall.wrl"), "--display", in("walls.json"), "--heads", udp, "-o", in("tracked")});
    }
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(image("tracked/w.png"), image("by-file/w.png"));
    {
        const Tracker tracker(port, {0, 0, -140, 0, 0, 0});
        run = view({"walls", in("hall.wrl"), "--display", in("walls.json"), "--heads", udp, "-o", in("behind")});
    }
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr(udp + ": an eye is 0.4 m behind wall 'w'"));
    EXPECT_FALSE(exists("behind"));
}

TEST_F(Displays, SilentTrackersAreReported) {
    const auto fault = [&](const std::string& heads) {
        const test::ToolRun run =
            view({"walls", in("hall.wrl"), "--display", "cave", "--heads", heads, "-o", in("none")});
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_FALSE(exists("none"));
        return run.err;
    };
    const test::OccupiedPort taken;
    const std::string udp = "udp:127.0.0.1:" + std::to_string(taken.number());
    EXPECT_THAT(fault(udp), HasSubstr("another program has the port: end it, or give another port"));
    const std::uint16_t free = test::OccupiedPort().number();
    EXPECT_THAT(fault("udp:" + std::to_string(free)), HasSubstr("no head has come in 10 s; start the tracker"));
    EXPECT_THAT(fault("udp:here:1"), HasSubstr("udp:here:1: must be udp:PORT"));
}

TEST_F(Displays, SharingIsForWindows) {
    const auto fault = [&](const std::vector<std::string>& words) {
        const test::ToolRun run = view(words);
        EXPECT_EQ(run.exit_code, 2);
        return run.err;
    };
    const std::string hall = in("hall.wrl");
    EXPECT_THAT(fault({"walls", hall, "--display", "cave", "-o", in("none"), "--share", "4250"}),
                HasSubstr("--share is for windows; leave it out, or -o"));
    EXPECT_THAT(fault({"walls", hall, "--display", "cave", "-o", in("none"), "--follow", "master:4250"}),
                HasSubstr("--follow is for windows"));
    EXPECT_THAT(fault({"render", hall, "-o", in("none.png"), "--share", "4250"}), HasSubstr("--share"));
    const test::ToolRun both =
        test::run_tool(scratch_.path(), "rs-view", {"open", hall, "--share", "4250", "--follow", "master:4250"});
    EXPECT_EQ(both.exit_code, 2);
    EXPECT_THAT(both.err, HasSubstr("--share and --follow exclude each other"));
}

TEST_F(Displays, TracedLightFallsOnWallsToo) {
    for (const char* renderer : {"whitted", "radiosity", "path"}) {
        const test::ToolRun run = view({"walls", in("hall.wrl"), "--display", "cave", "--wall", "front", "--size",
                                        "40x40", "--renderer", renderer, "--passes", "2", "-o", in(renderer)});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_GT(image(std::string(renderer) + "/front.png")(20, 17).r, 200) << renderer;
    }
}

TEST_F(Displays, AQuiltHasItsLayoutInItsName) {
    test::ToolRun run = view(
        {"quilt", in("hall.wrl"), "--layout", "3x2", "--tile-size", "30x40", "--cone", "30", "-o", in("hall.png")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Image<Rgba8> quilt = image("hall_qs3x2a0.75.png");
    ASSERT_EQ(quilt.width(), 90);
    ASSERT_EQ(quilt.height(), 80);
    EXPECT_FALSE(exists("hall.png"));
    // All views agree at the middle of the box.
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 2; ++row) EXPECT_GT(quilt(30 * column + 15, 40 * row + 20).r, 200);
    }
    run = view({"quilt", in("hall.wrl"), "--layout", "3x2", "--tile-size", "30x40", "--orbit", "2", "-o", in("turn")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(exists("turn/0001_qs3x2a0.75.png"));
}

TEST_F(Displays, InvalidOptionsAreRefusedInOneLine) {
    const auto fault = [&](const std::vector<std::string>& arguments) {
        const test::ToolRun run = view(arguments);
        EXPECT_NE(run.exit_code, 0);
        return run.err;
    };
    const std::string hall = in("hall.wrl");
    EXPECT_THAT(fault({"walls", hall, "--display", "dome", "-o", in("x")}), HasSubstr("dome: is neither a preset"));
    EXPECT_THAT(fault({"walls", hall, "--display", "cave", "-o", in("x.png")}), HasSubstr("walls go into a folder"));
    EXPECT_THAT(fault({"walls", hall, "--display", "cave", "--wall", "roof", "-o", in("x")}),
                HasSubstr("no wall 'roof'"));
    EXPECT_THAT(fault({"walls", hall, "--stereo", "anaglyph", "-o", in("x")}), HasSubstr("--display is required"));
    EXPECT_THAT(fault({"walls", hall, "--display", "cave", "--orbit", "3"}), HasSubstr("--orbit needs -o"));
    EXPECT_THAT(fault({"quilt", hall, "--layout", "5by9", "-o", in("x.png")}), HasSubstr("COLUMNSxROWS"));
    EXPECT_THAT(fault({"quilt", hall, "--layout", "5x9"}), HasSubstr("--output is required"));
    EXPECT_THAT(fault({"quilt", hall, "--layout", "5x9", "-o", in("x.mp4")}), HasSubstr(".png or a folder"));
    EXPECT_FALSE(exists("x"));
}

TEST_F(Displays, OlderAndNewerVrmlVersionsAreShown) {
    write("old.wrl", "#VRML V1.0 ascii\nMaterial { emissiveColor 1 0 0 } Cube { }\n");
    write("new.x3d",
          "<X3D><Scene><Shape><Appearance><Material emissiveColor='1 0 0'/></Appearance><Box/></Shape></Scene></X3D>");
    for (const char* name : {"old.wrl", "new.x3d"}) {
        const test::ToolRun run = view({"render", in(name), "--size", "40x40", "-o", in("shot.png")});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_GT(image("shot.png")(20, 20).r, 200) << name;
    }
    write("bad.x3d", "<X3D>\n<Scene>\n<Shape>\n</Scene></X3D>");
    const test::ToolRun run = view({"render", in("bad.x3d"), "-o", in("bad.png")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("bad.x3d: line 4: is not well-formed XML"));
}

}  // namespace
}  // namespace rs
