// Command line of rs-view sequence, on the street written by rs-street.

#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "tests/support/run_tool.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/videoio.hpp>

#include <cmath>
#include <fstream>

namespace rs {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SequenceTool : public testing::Test {
protected:
    std::string in(const std::string& name) const { return (work_ / name).string(); }
    test::ToolRun run(const std::string& tool, const std::vector<std::string>& arguments) const {
        return test::run_tool(scratch_.path(), tool, arguments);
    }
    test::ToolRun view(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "sequence");
        arguments.insert(arguments.end(), {"-q", "--size", "320x180"});
        return run("rs-view", arguments);
    }
    // Writes six frames of the street; false if there is no OpenGL.
    bool street(const std::string& name = "town") const {
        const test::ToolRun made = run("rs-street", {"-o", in(name), "--seconds", "0.24", "--small", "--name", name});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        EXPECT_THAT(made.out, HasSubstr("6 frames"));
        const test::ToolRun first = view({in(name), "-o", in("first.png")});
        if (first.exit_code != 0 && first.err.find("OpenGL: ") != std::string::npos) return false;
        EXPECT_EQ(first.exit_code, 0) << first.err;
        return true;
    }
    [[nodiscard]] std::string frame(const std::string& number) const {
        return in("town/maps/town/anim/out/frame-" + number + ".obj");
    }

    test::TemporaryFolder work_;
    test::TemporaryFolder scratch_;
};

double psnr_db(const cv::Mat& decoded, const Image<Rgba8>& still) {
    double sum = 0;
    for (int y = 0; y < still.height(); ++y) {
        for (int x = 0; x < still.width(); ++x) {
            const auto& bgr = decoded.at<cv::Vec3b>(y, x);
            const Rgba8& p = still(x, y);
            for (const int d : {bgr[2] - p.r, bgr[1] - p.g, bgr[0] - p.b}) sum += d * d;
        }
    }
    return 10 * std::log10(255.0 * 255.0 * 3 * still.width() * still.height() / std::max(sum, 1e-9));
}

TEST_F(SequenceTool, VideoFramesEqualTheStills) {
    if (!street()) GTEST_SKIP() << "no OpenGL";
    ASSERT_EQ(view({in("town"), "-o", in("stills")}).exit_code, 0);
    ASSERT_EQ(view({in("town"), "-o", in("street.mp4")}).exit_code, 0);
    cv::VideoCapture video(in("street.mp4"));
    ASSERT_TRUE(video.isOpened());
    EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 25, 1e-6);
    int frames = 0;
    for (cv::Mat decoded; video.read(decoded); ++frames) {
        const auto still = read_image(in("stills/000" + std::to_string(frames) + ".png"));
        ASSERT_TRUE(still) << frames;
        EXPECT_GE(psnr_db(decoded, *still), 30) << frames;  // neighbouring frames differ by less than 25 dB
    }
    EXPECT_EQ(frames, 6);
    EXPECT_EQ(view({in("town"), "--frame", "3", "-o", in("third.png")}).exit_code, 0);
    const auto third = read_image(in("third.png"));
    const auto still = read_image(in("stills/0003.png"));
    ASSERT_TRUE(third && still);
    EXPECT_TRUE(std::equal(third->pixels().begin(), third->pixels().end(), still->pixels().begin()));
    EXPECT_EQ(view({in("town"), "--frame", "5", "--weather", "snow", "-o", in("a.jpg")}).exit_code, 0);
    EXPECT_TRUE(read_image(in("a.jpg")));
    EXPECT_NE(view({in("town"), "--frame", "6", "-o", in("b.jpg")}).exit_code, 0);
    EXPECT_FALSE(fs::exists(in("b.jpg")));
}

TEST_F(SequenceTool, DamagedLinesAreRefusedAndNothingIsWritten) {
    if (!street()) GTEST_SKIP() << "no OpenGL";
    for (const char* line : {"instance", "instance nobody 0 0 0 0 0 0 1 1 1 -", "camera 1 2 3 4 5 6", "vv 1 2 3"}) {
        const auto before = read_file(frame("0002"), 1 << 20);
        ASSERT_TRUE(before);
        {
            std::ofstream file(frame("0002"), std::ios::trunc);
            file << "# damaged\n" << line << "\n";
        }
        for (const char* output : {"x.mp4", "x.jpg", "x"}) {
            const test::ToolRun refused = view({in("town"), "-o", in(output)});
            EXPECT_EQ(refused.exit_code, 1);
            EXPECT_THAT(refused.err, HasSubstr("frame-0002.obj:2: "));
            EXPECT_FALSE(fs::exists(in(output)));
        }
        EXPECT_TRUE(write_file(frame("0002"), *before));
    }
}

TEST_F(SequenceTool, OptionsOfAnotherOutputAreRefused) {
    const auto fault = [&](const std::vector<std::string>& arguments) {
        std::vector<std::string> all = {"sequence"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const test::ToolRun run = this->run("rs-view", all);
        EXPECT_EQ(run.exit_code, 2) << run.err;
        return run.err;
    };
    const std::string stats = in("s.json");
    EXPECT_THAT(fault({"a", "--stats", stats}), HasSubstr("--stats needs -o"));
    EXPECT_THAT(fault({"a", "--force"}), HasSubstr("--force needs -o"));
    EXPECT_THAT(fault({"a", "b", "--stats", stats, "-o", in("x")}), HasSubstr("--stats needs a single sequence"));
    EXPECT_THAT(fault({"a", "--frame", "1", "-o", in("x.mp4")}), HasSubstr("--frame needs -o FILE.jpg or FILE.png"));
    EXPECT_THAT(fault({"a", "--fps", "9", "-o", in("x.png")}), HasSubstr("--fps needs -o FILE.mp4"));
}

TEST_F(SequenceTool, AnUnknownViewpointOrExecutorIsRefused) {
    if (!street()) GTEST_SKIP() << "no OpenGL";
    const test::ToolRun viewpoint = view({in("town"), "--viewpoint", "roof", "-o", in("x.png")});
    EXPECT_EQ(viewpoint.exit_code, 1);
    EXPECT_THAT(viewpoint.err, HasSubstr("--viewpoint roof: the scene has no viewpoint of this description"));
    const test::ToolRun executor = view({in("town"), "--executor", "fpga", "-o", in("x.png")});
    EXPECT_EQ(executor.exit_code, 1);
    EXPECT_THAT(executor.err, HasSubstr("use one of scalar, core, board:CONFIG"));
    EXPECT_FALSE(fs::exists(in("x.png")));
}

TEST_F(SequenceTool, AVideoNeedsTwoFrames) {
    std::ofstream(work_ / "one.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const test::ToolRun refused = view({in("one.obj"), "-o", in("one.mp4")});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("a video needs 2 or more"));
    EXPECT_FALSE(fs::exists(in("one.mp4")));
    const test::ToolRun image = view({in("one.obj"), "-o", in("one.jpg")});
    if (image.err.find("OpenGL: ") == std::string::npos) {
        EXPECT_EQ(image.exit_code, 0) << image.err;
    }
}

TEST_F(SequenceTool, ABatchContinuesAndReportsFailures) {
    if (!street() || !street("village")) GTEST_SKIP() << "no OpenGL";
    fs::create_directory(work_ / "empty");
    const test::ToolRun batch =
        view({in("town"), in("empty"), in("village"), "-o", in("renders"), "--weather", "rain"});
    EXPECT_EQ(batch.exit_code, 1);
    EXPECT_THAT(batch.out, HasSubstr(in("town") + ": 6 frames"));
    EXPECT_THAT(batch.out, HasSubstr(in("empty") + ": failed"));
    EXPECT_THAT(batch.err, HasSubstr("has no frames.json"));
    EXPECT_THAT(batch.err, HasSubstr("1 of 3 sequences failed"));
    for (const char* name : {"town", "village"}) {
        EXPECT_TRUE(fs::exists(work_ / "renders" / name / "sequence.mp4"));
        EXPECT_TRUE(fs::exists(work_ / "renders" / name / "snapshot.jpg"));
    }
}

TEST_F(SequenceTool, OtherFormatsAreConverted) {
    if (!street()) GTEST_SKIP() << "no OpenGL";
    const std::string convert = "cp -r {in} {out}";
    EXPECT_EQ(view({in("town"), "--convert", convert, "-o", in("c.jpg")}).exit_code, 0);
    const test::ToolRun nothing = view({in("town"), "--convert", "true {in} {out}", "-o", in("d.jpg")});
    EXPECT_EQ(nothing.exit_code, 1);
    EXPECT_THAT(nothing.err, HasSubstr("has written nothing"));
    EXPECT_FALSE(fs::exists(in("d.jpg")));
}

}  // namespace
}  // namespace rs
