// Command line of posed photos: `rs-capture import --known` with cameras anywhere, and `rs-capture export`.

#include "capture/posed/cameras/colmap_model.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/posed/posed_scene.hpp"
#include "tests/support/camera_jpeg.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class PosedTool : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "images");
        fs::create_directories(folder_ / "sparse" / "0");
        std::vector<capture::PosedCamera> cameras = test::posed_cameras(10, 120, 90);
        for (capture::PosedCamera& posed : cameras) {
            ASSERT_TRUE(write_png(folder_ / "images" / posed.photo, test::posed_photo(posed)).ok());
            posed.camera.world_from_camera = test::z_up_world().pose(posed.camera.world_from_camera);
        }
        const capture::ColmapText text = capture::colmap_text_of(cameras);
        ASSERT_TRUE(write_file(folder_ / "sparse/0/cameras.txt", text.cameras).ok());
        ASSERT_TRUE(write_file(folder_ / "sparse/0/images.txt", text.images).ok());
    }
    [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] test::ToolRun capture_tool(const std::vector<std::string>& arguments) const {
        return test::run_tool(folder_.path(), "rs-capture", arguments);
    }
    [[nodiscard]] test::ToolRun import(std::vector<std::string> more) const {
        more.insert(more.begin(), {"import", in("images"), "-o", in("set"), "-q"});
        return capture_tool(more);
    }
    void expect_refused(const std::vector<std::string>& more, const std::string& part) const {
        const test::ToolRun run = import(more);
        EXPECT_EQ(run.exit_code, 1) << run.err;
        EXPECT_THAT(run.err, HasSubstr(part));
        EXPECT_FALSE(fs::exists(folder_ / "set"));
    }
    test::TemporaryFolder folder_;
};

TEST_F(PosedTool, ColmapModelToSetToColmapModel) {
    const test::ToolRun run = import({"--known", folder_.path().string(), "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("method"), "posed");
    EXPECT_EQ(json.at("views"), 10);
    EXPECT_EQ(json.at("up_from"), "horizons");
    EXPECT_NEAR(json.at("up").at(2), 1, 1e-6);
    EXPECT_EQ(json.at("undistorted"), 0);
    const auto set = read_rig(folder_ / "set");
    ASSERT_TRUE(set.ok());
    EXPECT_EQ(set->extras.at("posed"), true);

    const test::ToolRun exported =
        capture_tool({"export", in("set"), "--colmap", "-o", in("out"), "--background", "white", "-q"});
    ASSERT_EQ(exported.exit_code, 0) << exported.err;
    EXPECT_THAT(exported.out, HasSubstr("10 views for COLMAP"));
    const test::ToolRun again = capture_tool(
        {"import", in("out/images"), "--known", in("out"), "--masks", in("out/masks"), "-o", in("again"), "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    const auto copy = read_rig(folder_ / "again");
    ASSERT_TRUE(copy.ok());
    ASSERT_EQ(copy->views.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
        const Camera &a = set->views[i].camera, &b = copy->views[i].camera;
        EXPECT_EQ(a.fl_x, b.fl_x);
        EXPECT_LT(glm::length(a.right() - b.right()), 0.05);
        EXPECT_LT(glm::length(a.centre() - b.centre()), 0.1) << "masks are binary, so the object's size differs a bit";
    }
    EXPECT_EQ(capture_tool({"export", in("set"), "-o", in("none")}).exit_code, 1) << "no format";
    EXPECT_EQ(capture_tool({"export", in("set"), "--colmap", "--nerfstudio", "-o", in("none")}).exit_code, 2);
}

TEST_F(PosedTool, OptionsOfATurnAreRefused) {
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--fov", "30"},
                                                   {"--equal-steps"},
                                                   {"--clockwise"},
                                                   {"--board", "default"},
                                                   {"--calibration", "nominal"},
                                                   {"--axis-x", "60"},
                                                   {"--report", in("page.html")},
                                                   {"--shadow", "keep"},
                                                   {"--principal-point"},
                                                   {"--degrees-per-view", "10"},
                                                   {"--counter-clockwise"}}) {
        std::vector<std::string> arguments{"--known", in("sparse/0")};
        arguments.insert(arguments.end(), option.begin(), option.end());
        expect_refused(arguments, option.front() + ": only for photos of one turn");
    }
    expect_refused({"--posed"}, "give --known");
    expect_refused({"--up", "0,1,0"}, "give --known");
    expect_refused({"--known", in("sparse/0"), "--camera-axes", "opencv"}, "--camera-axes");
    const test::ToolRun run = import({"--known", in("sparse/0"), "--up", "sideways"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, HasSubstr("--up"));
}

// The same cameras as a transforms.json, with the photos' size as displayed.
TEST_F(PosedTool, TransformsOfPosedPhotosAreNoTurn) {
    const std::vector<capture::PosedCamera> cameras = test::posed_cameras(10, 120, 90);
    nlohmann::json content = {{"w", 120}, {"h", 90}, {"fl_x", cameras[0].camera.fl_x}};
    fs::create_directories(folder_ / "turned");
    for (const capture::PosedCamera& posed : cameras) {
        const glm::dmat4& m = posed.camera.world_from_camera;
        nlohmann::json rows;
        for (int row = 0; row < 4; ++row) rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
        content["frames"].push_back({{"file_path", posed.photo}, {"transform_matrix", rows}});
        const fs::path jpeg = folder_ / "turned" / fs::path(posed.photo).replace_extension(".jpg");
        const Image<Rgba8> photo = test::posed_photo(posed);
        Image<Rgba8> stored(90, 120);
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 90; ++x) stored(x, y) = over(photo(119 - y, x), {255, 255, 255, 255});
        }
        ASSERT_TRUE(write_jpeg(jpeg, stored, 95).ok());
        test::add_exif(jpeg, 6);
    }
    ASSERT_TRUE(write_file(folder_ / "transforms.json", content.dump()).ok());
    expect_refused({"--known", in("transforms.json"), "--fov", "30"}, "--fov: only for photos of one turn");
    const test::ToolRun run =
        capture_tool({"import", in("turned"), "-o", in("set"), "-q", "--known", in("transforms.json")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("10 posed views of 120x90")) << "EXIF orientation is applied";
    fs::remove_all(folder_ / "set");
    content["frames"].push_back(content["frames"][0]);
    content["frames"].back()["transform_matrix"][0][3] = 3;
    ASSERT_TRUE(write_file(folder_ / "transforms.json", content.dump()).ok());
    expect_refused({"--known", in("transforms.json")}, "frame 10 has the image of an earlier one");
}

TEST_F(PosedTool, ColmapRefusesWhatItCannotUse) {
    const auto refused = [&](std::vector<std::string> more, const std::string& part) {
        more.insert(more.begin(), {"--calibration", "colmap"});
        expect_refused(more, part);
    };
    refused({"--known", in("sparse/0")}, "leave out --known");
    refused({"--fov", "30"}, "--fov: only for photos of one turn, not for the posed photos of --calibration colmap");
    refused({"--camera-axes", "opencv"}, "--camera-axes");
    refused({in("images")}, "give one folder");
    fs::create_directories(folder_ / "opaque");
    ASSERT_TRUE(write_png(folder_ / "opaque" / "1.png", Image<Rgba8>(120, 90, {90, 90, 90, 255})));
    fs::create_directories(folder_ / "no-masks");
    const test::ToolRun run = capture_tool(
        {"import", in("opaque"), "-o", in("set"), "-q", "--calibration", "colmap", "--masks", in("no-masks")});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err, HasSubstr("no-masks")) << "before COLMAP runs";
    EXPECT_THAT(run.err, Not(HasSubstr("COLMAP")));
}

TEST_F(PosedTool, UpIsAsGiven) {
    const test::ToolRun run = import({"--known", in("sparse/0"), "--up", "0,0,-1", "--json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto set = read_rig(folder_ / "set");
    ASSERT_TRUE(set.ok());
    EXPECT_LT(set->views[0].camera.up().y, -0.5) << "upside down";
}

}  // namespace
}  // namespace rs
