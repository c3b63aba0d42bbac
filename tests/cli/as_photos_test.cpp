// Command line of `rs-capture synth --as-photos`.

#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;

class AsPhotos : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(folder_ / "box.obj")
            << "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
               "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n";
    }
    [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] test::ToolRun synth(std::vector<std::string> arguments, const std::string& output = "set") const {
        arguments.insert(arguments.begin(), {"synth", in("box.obj"), "-o", in(output), "--spp", "2", "-q"});
        return test::run_tool(folder_.path(), "rs-capture", arguments);
    }

    test::TemporaryFolder folder_;
};

TEST_F(AsPhotos, WritesPhotosAndTheirTruth) {
    const std::vector<std::string> arguments = {"--as-photos", "--views", "3",        "--size", "64x48", "--k1",
                                                "-0.12",       "--disc",  "speckled", "--seed", "4",     "--json"};
    const test::ToolRun run = synth(arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto summary = nlohmann::json::parse(run.out);
    EXPECT_EQ(summary.at("views"), 3);
    EXPECT_EQ(summary.at("clipped_views"), 0);
    std::vector<std::string> photos;
    for (const auto& entry : fs::directory_iterator(folder_ / "set" / "photos")) {
        photos.push_back(entry.path().filename().string());
    }
    std::sort(photos.begin(), photos.end());
    EXPECT_EQ(photos, (std::vector<std::string>{"000.jpg", "001.jpg", "002.jpg"}));
    const Result<Rig> rig = read_rig(folder_ / "set" / "truth");
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    ASSERT_EQ(rig->views.size(), 3U);
    EXPECT_EQ(rig->extras.at("turntable").at("k1"), -0.12);
    for (const RigView& view : rig->views) {
        const auto info = read_image_info(folder_ / "set" / "truth" / view.file_path);
        ASSERT_TRUE(info.ok()) << info.error().message;
        EXPECT_EQ(info->width, 64);
        EXPECT_FALSE(info->has_alpha);
    }
    const auto alpha = read_image(folder_ / "set" / "truth" / "alpha" / "002.png");
    ASSERT_TRUE(alpha.ok());
    EXPECT_EQ((*alpha)(0, 0).g, 0);
    EXPECT_EQ((*alpha)(32, 24).g, 255);
    EXPECT_EQ(synth(arguments).exit_code, 0) << "an existing set may be replaced";
}

TEST_F(AsPhotos, RecentredPhotosFillTheFrameAndStateTheirOffsets) {
    ASSERT_EQ(synth({"--as-photos", "--recentred", "--views", "4", "--size", "64x48", "--disc", "none"}).exit_code, 0);
    const Result<Rig> rig = read_rig(folder_ / "set" / "truth");
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    const auto& places = rig->extras.at("turntable").at("places");
    ASSERT_EQ(places.size(), 4U);
    EXPECT_GT(places[0].at("scale"), 0.5);
    EXPECT_EQ(places[0].at("shift_px").size(), 2U);
    const auto alpha = read_image(folder_ / "set" / "truth" / "alpha" / "001.png");
    ASSERT_TRUE(alpha.ok());
    int top = 48, bottom = 0, left = 64, right = 0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if ((*alpha)(x, y).g == 0) continue;
            top = std::min(top, y);
            bottom = std::max(bottom, y + 1);
            left = std::min(left, x);
            right = std::max(right, x + 1);
        }
    }
    EXPECT_NEAR(std::max((bottom - top) / 48.0, (right - left) / 64.0), 0.88, 0.05);
    EXPECT_NEAR(top + bottom, 48, 2);
    EXPECT_NEAR(left + right, 64, 2);
}

TEST_F(AsPhotos, FileSizeDependsOnTheQuality) {
    const auto size_at = [&](const std::string& quality, const std::string& file) {
        const test::ToolRun run =
            synth({"--as-photos", "--views", "1", "--size", "160x120", "--jpeg", quality}, "set" + quality);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return fs::file_size(folder_ / ("set" + quality) / "photos" / file);
    };
    const auto low = size_at("30", "000.jpg");
    const auto high = size_at("95", "000.jpg");
    const auto lossless = size_at("0", "000.png");
    EXPECT_LT(2 * low, high);
    EXPECT_LT(high, lossless);
}

TEST_F(AsPhotos, AFolderMayHaveABackdropsName) {
    EXPECT_EQ(synth({"--as-photos", "--views", "1", "--size", "16x12"}, "wall").exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_ / "wall" / "truth"));
    std::filesystem::copy_file(folder_ / "box.obj", folder_ / "wall" / "board.png");
    const test::ToolRun run = synth({"--as-photos", "--board", in("wall/board.png")}, "wall");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find("would overwrite"), std::string::npos) << run.err;
}

TEST_F(AsPhotos, InvalidValuesAreUsageErrorsInOneLine) {
    const std::vector<std::vector<std::string>> wrong = {
        {"--as-photos", "--k1", "nan"},
        {"--recentred"},
        {"--as-photos", "--k2", "2"},
        {"--as-photos", "--noise", "-1"},
        {"--as-photos", "--jpeg", "101"},
        {"--as-photos", "--step-error", "inf"},
        {"--as-photos", "--exposure-drift", "1"},
        {"--as-photos", "--disc", "square"},
        {"--as-photos", "--board-width", "2"},  // without a board
        {"--as-photos", "--elevation", "-5"},
        {"--as-photos", "--first-angle", "5"},
        {"--as-photos", "--depth"},
        {"--as-photos", "--format", "exr"},
        {"--as-photos", "--poses", "x.json"},
        {"--k1", "0.1"},  // without --as-photos
        {"--counter-clockwise"},
        {"--disc", "plain"},
    };
    for (const std::vector<std::string>& arguments : wrong) {
        const test::ToolRun run = synth(arguments);
        EXPECT_EQ(run.exit_code, 2) << arguments.back() << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_FALSE(fs::exists(folder_ / "set"));
    }
}

TEST_F(AsPhotos, NamesTheFileThatCannotBeRead) {
    for (const char* option : {"--board", "--photo-backdrop"}) {
        const test::ToolRun run = synth({"--as-photos", "--views", "1", "--size", "16x12", option, in("gone.png")});
        EXPECT_EQ(run.exit_code, 1);
        EXPECT_NE(run.err.find("gone.png"), std::string::npos) << run.err;
        EXPECT_FALSE(fs::exists(folder_ / "set"));
    }
    fs::create_directories(folder_ / "mine");
    std::ofstream(folder_ / "mine" / "note.txt") << "keep me";
    EXPECT_EQ(synth({"--as-photos", "--views", "1", "--size", "16x12"}, "mine").exit_code, 1);
    EXPECT_TRUE(fs::exists(folder_ / "mine" / "note.txt"));
}

}  // namespace
}  // namespace rs
