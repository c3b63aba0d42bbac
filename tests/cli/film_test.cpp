// `rs-capture import` of a film, from the command line.

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/capture/calibration/drawn_drum.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace rs {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImportFilm : public testing::Test {
protected:
    // Writes a turn of the drum in `frames` frames, and a tenth of a turn more.
    void write_drum(int frames) const {
        const capture::TurntableModel model = test::drum_turn(frames + frames / 10, 2 * kPi / frames);
        const auto view = [&](int i) { return test::drawn_drum({}, model, static_cast<std::size_t>(i)); };
        const Image<Rgba8> first = view(0);
        Result<VideoWriter> video =
            VideoWriter::open(folder_ / "turn.mp4", first.width(), first.height(), 30, {120, 160, 215, 255});
        ASSERT_TRUE(video.ok()) << video.error().message;
        for (int i = 0; i < frames + frames / 10; ++i) ASSERT_TRUE(video->add(view(i)).ok());
        ASSERT_TRUE(video->finish().ok());
    }
    [[nodiscard]] test::ToolRun import(std::vector<std::string> arguments) const {
        const std::vector<std::string> all = {"import", (folder_ / "turn.mp4").string(), "-o",
                                              (folder_ / "set").string()};
        arguments.insert(arguments.begin(), all.begin(), all.end());
        return test::run_tool(folder_.path(), "rs-capture", arguments);
    }
    void expect_refused(const test::ToolRun& run, const std::string& mention) const {
        EXPECT_EQ(run.exit_code, 1) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        EXPECT_THAT(run.err, HasSubstr(mention));
        EXPECT_FALSE(fs::exists(folder_ / "set"));
    }

    test::TemporaryFolder folder_;
};

TEST_F(ImportFilm, MakesASetOfAFilm) {
    write_drum(144);
    const test::ToolRun run = import({"--json", "--frames", "36", "--report", (folder_ / "page.html").string()});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("views"), 36);
    EXPECT_THAT(json.at("notes").front().get<std::string>(), HasSubstr("turn.mp4: 158 frames, one turn is frames"));
    EXPECT_EQ(json.at("turning"), "counter-clockwise");
    const Result<Rig> rig = read_rig(folder_ / "set" / kRigFileName);
    ASSERT_TRUE(rig.ok()) << rig.error().message;
    EXPECT_EQ(rig->views.size(), 36U);
    // No temporary files remain.
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.insert(entry.path().filename().string());
    EXPECT_EQ(names, (std::set<std::string>{"turn.mp4", "set", "page.html", "stdout.txt", "stderr.txt"}));
    for (const auto& entry : fs::directory_iterator(folder_ / "set")) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(name == "images" || name == kRigFileName || name == ".rayspace-folder") << name;
    }
}

TEST_F(ImportFilm, RefusesADamagedFile) {
    std::ofstream(folder_ / "turn.mp4") << "no film";
    expect_refused(import({"-q"}), "turn.mp4: cannot be read as a video");
}

TEST_F(ImportFilm, RefusesAFilmInWhichNothingTurns) {
    Result<VideoWriter> video = VideoWriter::open(folder_ / "turn.mp4", 64, 48, 30);
    ASSERT_TRUE(video.ok());
    for (int i = 0; i < 30; ++i) ASSERT_TRUE(video->add(Image<Rgba8>(64, 48, {90, 120, 60, 255})).ok());
    ASSERT_TRUE(video->finish().ok());
    expect_refused(import({"-q"}), "nothing moves in it");
}

TEST_F(ImportFilm, RefusesOptionsThatDescribePhotos) {
    std::ofstream(folder_ / "turn.mp4") << "not looked at";
    std::ofstream(folder_ / "known.json") << "{}";
    expect_refused(import({"-q", "--known", (folder_ / "known.json").string()}), "--known");
    expect_refused(import({"-q", "--masks", folder_.path().string()}), "--masks");
    expect_refused(import({"-q", "--equal-steps"}), "--equal-steps");
    expect_refused(import({"-q", "--degrees-per-view", "10"}), "--degrees-per-view");
    EXPECT_EQ(import({"-q", "--frames", "12"}).exit_code, 2);
    EXPECT_EQ(import({"-q", "--frames", "many"}).exit_code, 2);
}

TEST_F(ImportFilm, ChoosesAmongPhotosOnRequest) {
    fs::create_directory(folder_ / "photos");
    constexpr int kPhotos = 48;
    const capture::TurntableModel model = test::drum_turn(kPhotos, 2 * kPi / kPhotos);
    for (int i = 0; i < kPhotos; ++i) {
        const Image<Rgba8> photo = test::drawn_drum({}, model, static_cast<std::size_t>(i));
        ASSERT_TRUE(write_png(folder_ / "photos" / (std::to_string(i) + ".png"), photo).ok());
    }
    const auto import_with = [&](const std::string& frames) {
        return test::run_tool(folder_.path(), "rs-capture",
                              {"import", (folder_ / "photos").string(), "-o", (folder_ / "set").string(), "--json",
                               "-q", "--calibration", "nominal", "--frames", frames});
    };
    const test::ToolRun fewer = import_with("36");
    ASSERT_EQ(fewer.exit_code, 0) << fewer.err;
    EXPECT_EQ(nlohmann::json::parse(fewer.out).at("views"), 36);
    const test::ToolRun more = import_with("60");
    ASSERT_EQ(more.exit_code, 0) << more.err;
    EXPECT_EQ(nlohmann::json::parse(more.out).at("views"), kPhotos);
    EXPECT_THAT(nlohmann::json::parse(more.out).at("notes").front().get<std::string>(), HasSubstr("all are used"));
}

}  // namespace
}  // namespace rs
