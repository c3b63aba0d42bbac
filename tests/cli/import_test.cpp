// Command line of `rs-capture import`, from photos to a capture set.

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/calibration/board_photos.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;

std::string file_name(std::size_t view) {
    return (view < 10 ? "0" : "") + std::to_string(view) + ".png";
}

class ImportTool : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directory(folder_ / "photos");
        fs::create_directory(folder_ / "masks");
        fs::create_directory(folder_ / "rig");
    }
    [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] test::ToolRun import(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"import", in("photos"), "-o", in("set"), "-q", "--json"});
        return test::run_tool(folder_.path(), "rs-capture", arguments);
    }
    // Writes segmented images and the rig with which they were rendered.
    void write_drum(int views) const {
        const capture::TurntableModel model = test::drum_turn(views, 2 * kPi / views);
        Rig rig;
        rig.object_radius = 1;
        for (std::size_t i = 0; i < static_cast<std::size_t>(views); ++i) {
            ASSERT_TRUE(write_png(folder_ / "photos" / file_name(i), test::drawn_drum({}, model, i)).ok());
            RigView view;
            view.camera = capture::object_camera(model, i, 4);
            view.file_path = "../photos/" + file_name(i);
            rig.views.push_back(view);
        }
        ASSERT_TRUE(write_rig(folder_ / "rig" / kRigFileName, rig).ok());
    }
    [[nodiscard]] std::string text_of(const std::string& name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void expect_nothing_written(const test::ToolRun& run) const {
        EXPECT_EQ(run.exit_code, 1) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            EXPECT_TRUE(name == "photos" || name == "masks" || name == "rig" || name == "stdout.txt" ||
                        name == "stderr.txt" || name == "known.yml")
                << name;
        }
    }

    test::TemporaryFolder folder_;
};

TEST_F(ImportTool, UsesTheRigOfATransformsJson) {
    write_drum(12);
    const test::ToolRun run = import({"--known", in("rig/transforms.json"), "--report", in("page.html")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("method"), "given");
    EXPECT_EQ(json.at("views"), 12);
    EXPECT_EQ(json.at("turning"), "counter-clockwise");
    EXPECT_NEAR(json.at("degrees_per_view"), 30, 1e-6);
    const auto& calibration = json.at("calibration");
    EXPECT_NEAR(calibration.at("f_px").at("value"), 620, 1e-6);
    EXPECT_EQ(calibration.at("f_px").at("deviation"), 0);
    EXPECT_NEAR(calibration.at("tilt_deg").at("value"), 20, 1e-4);
    EXPECT_NEAR(calibration.at("angles").at(5).at("value"), 150, 1e-4);
    const std::string page = text_of("page.html");
    for (const char* part : {"<html", "given values", "focal length, px", "620.0", "data:image/", "05.png"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    ASSERT_TRUE(read_rig(folder_ / "set").ok());
}

TEST_F(ImportTool, KnownIntrinsicsAreInPhotoPixels) {
    write_drum(12);
    const test::ToolRun run = import({"--known", in("rig/transforms.json"), "--max-side", "128"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    const capture::Lens whole = test::drum_turn(12, radians(30)).lens;
    const double scale = 128.0 / whole.width;
    EXPECT_EQ(json.at("photograph_width"), whole.width);
    EXPECT_EQ(json.at("width"), 128);
    EXPECT_NEAR(json.at("calibration").at("f_px").at("value"), 620 * scale, 1e-6);
    EXPECT_NEAR(json.at("calibration").at("cx").at("value"), 64 + (whole.cx - 0.5 * whole.width) * scale, 1e-6);
    EXPECT_NEAR(json.at("calibration").at("tilt_deg").at("value"), 20, 1e-4);

    const double off = 0.05 * whole.width;
    const test::ToolRun nominal =
        import({"--calibration", "nominal", "--max-side", "128", "--axis-x", std::to_string(0.5 * whole.width + off)});
    ASSERT_EQ(nominal.exit_code, 0) << nominal.err;
    EXPECT_NEAR(nlohmann::json::parse(nominal.out).at("axis_column_px"), 64 + off * scale, 1e-4);
    const test::ToolRun wide = import({"--max-side", "1000000"});
    EXPECT_EQ(wide.exit_code, 2) << "8192 is the maximum";
    EXPECT_NE(wide.err.find("--max-side"), std::string::npos) << wide.err;
}

TEST_F(ImportTool, KnownIntrinsicsMustMatchThePhotos) {
    write_drum(6);
    const std::string whole = text_of("rig/transforms.json");
    auto json = nlohmann::json::parse(whole);
    json["w"] = 640;
    json["h"] = 512;
    for (auto& frame : json["frames"]) {
        if (frame.contains("w")) frame["w"] = 640;
        if (frame.contains("h")) frame["h"] = 512;
    }
    std::ofstream(folder_ / "rig" / "transforms.json") << json;
    const test::ToolRun other_size = import({"--known", in("rig/transforms.json")});
    expect_nothing_written(other_size);
    EXPECT_NE(other_size.err.find("640"), std::string::npos) << other_size.err;
    EXPECT_NE(other_size.err.find("transforms.json"), std::string::npos) << other_size.err;

    std::ofstream(folder_ / "rig" / "transforms.json") << whole.substr(0, whole.size() / 2);
    const test::ToolRun cut_short = import({"--known", in("rig/transforms.json"), "--report", in("page.html")});
    expect_nothing_written(cut_short);
    EXPECT_NE(cut_short.err.find("transforms.json"), std::string::npos) << cut_short.err;

    std::ofstream(folder_ / "known.yml") << "%YAML:1.0\n---\nnothing: 3\n";
    const test::ToolRun no_lens = import({"--known", in("known.yml")});
    expect_nothing_written(no_lens);
    EXPECT_NE(no_lens.err.find("known.yml"), std::string::npos) << no_lens.err;
}

TEST_F(ImportTool, SilhouetteCalibrationNeedsTheSteps) {
    write_drum(12);
    const test::ToolRun run = import({"--calibration", "silhouettes", "--counter-clockwise", "--fov", "28.94"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("method"), "silhouettes");
    EXPECT_TRUE(json.at("calibration").at("angles").at(3).at("deviation").is_null()) << "their deviation is unknown";
    const capture::TurntableModel truth = test::drum_turn(12, radians(30));
    EXPECT_NEAR(json.at("calibration").at("axis_column_px"), *capture::axis_column(truth.lens, truth.pose, 128), 0.7);
}

TEST_F(ImportTool, UsesBoardAndMasksAndWritesAReport) {
    const test::BoardPhotos photos;
    for (std::size_t i = 0; i < photos.model.angles_rad.size(); ++i) {
        const test::BoardPhotos::Photo photo = photos.taken(i);
        ASSERT_TRUE(write_png(folder_ / "photos" / file_name(i), photo.image).ok());
        ASSERT_TRUE(write_png(folder_ / "masks" / file_name(i), photo.mask).ok());
    }
    const std::vector<std::string> arguments = {
        "--board",      "squares=7x7,square-mm=24", "--calibration", "board", "--masks", in("masks"), "--report",
        in("page.html")};
    const test::ToolRun run = import(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("method"), "board");
    EXPECT_EQ(json.at("backdrop"), "masks");
    EXPECT_NEAR(json.at("calibration").at("tilt_deg").at("value"), 38, 0.3);
    const std::string page = text_of("page.html");
    for (const char* part :
         {"the printed board on the turntable", "<table", "<svg", "Alpha mattes over magenta", "09.png"}) {
        EXPECT_NE(page.find(part), std::string::npos) << part;
    }
    const auto rig = read_rig(folder_ / "set");
    ASSERT_TRUE(rig.ok());
    EXPECT_EQ(rig->extras.at("photo_import").at("calibration"), "board");

    fs::remove_all(folder_ / "set");
    fs::remove(folder_ / "page.html");
    fs::remove(folder_ / "masks" / "04.png");
    const test::ToolRun no_mask = import(arguments);
    expect_nothing_written(no_mask);
    EXPECT_NE(no_mask.err.find("04.png"), std::string::npos) << no_mask.err;
}

TEST_F(ImportTool, BadImagesLeaveNoOutput) {
    write_drum(3);
    const test::ToolRun few = import({"--calibration", "tracks", "--report", in("page.html")});
    expect_nothing_written(few);
    EXPECT_NE(few.err.find("take at least 5"), std::string::npos) << few.err;
    std::filesystem::remove(folder_ / "photos" / file_name(1));
    const test::ToolRun two = import({});
    expect_nothing_written(two);
    EXPECT_NE(two.err.find("holds 2 images; a turn needs at least 5"), std::string::npos) << two.err;
    for (std::size_t i = 0; i < 6; ++i) {
        ASSERT_TRUE(write_png(folder_ / "photos" / file_name(i), Image<Rgba8>(64, 48, Rgba8{255, 255, 255, 255})).ok());
    }
    const test::ToolRun white = import({"--report", in("page.html")});
    expect_nothing_written(white);
    EXPECT_NE(white.err.find("object"), std::string::npos) << white.err;
    const test::ToolRun unknown_board = import({"--board", "squares=chess"});
    expect_nothing_written(unknown_board);
    EXPECT_NE(unknown_board.err.find("squares"), std::string::npos) << unknown_board.err;
}

TEST_F(ImportTool, SegmentersAreChosenReportedAndRefused) {
    const test::BoardPhotos photos;
    for (std::size_t i = 0; i < photos.model.angles_rad.size(); ++i) {
        const test::BoardPhotos::Photo photo = photos.taken(i);
        ASSERT_TRUE(write_png(folder_ / "photos" / file_name(i), photo.image).ok());
        ASSERT_TRUE(write_png(folder_ / "masks" / file_name(i), photo.mask).ok());
    }
    const std::vector<std::string> nominal = {"--calibration", "nominal", "--masks", in("masks")};
    const test::ToolRun masks = import(nominal);
    ASSERT_EQ(masks.exit_code, 0) << masks.err;
    const auto json = nlohmann::json::parse(masks.out);
    EXPECT_EQ(json.at("segmenter").at("name"), "masks");
    EXPECT_EQ(json.at("segmenter").at("reason"), "--masks");
    fs::remove_all(folder_ / "set");

    struct RefusedCase {
        std::vector<std::string> arguments;
        std::string named;
    };
    for (const RefusedCase& refused :
         {RefusedCase{{"--segmenter", "model"}, "--segmentation-model"},
          RefusedCase{{"--masks-alpha"}, "--masks-alpha"}, RefusedCase{{"--segmenter", "masks"}, "--masks"},
          RefusedCase{{"--segmenter", "alpha"}, "no transparent pixels"},
          RefusedCase{{"--masks", in("masks"), "--shadow", "keep"}, "--shadow keep"},
          RefusedCase{{"--masks", in("masks"), "--segmenter", "chroma"}, "--masks"},
          RefusedCase{{"--masks", in("masks"), "--backdrop", "white"}, "--backdrop"},
          RefusedCase{{"--segmentation-model", in("photos/") + file_name(0), "--segmenter", "background"},
                      "--segmentation-model: has no effect"}}) {
        const test::ToolRun run = import(refused.arguments);
        expect_nothing_written(run);
        EXPECT_NE(run.err.find(refused.named), std::string::npos) << run.err;
    }
    EXPECT_EQ(import({"--segmenter", "magic"}).exit_code, 2);
    EXPECT_EQ(import({"--segmentation-model", in("gone.onnx")}).exit_code, 2);
}

}  // namespace
}  // namespace rs
