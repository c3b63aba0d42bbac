#include "capture/photos/masks/segmentation_network.hpp"

#include "capture/photos/masks/network_settings.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// Written by make_tiny_models.py.
fs::path tiny_model(const std::string& name) {
    return fs::path(RAYSPACE_SOURCE_DIR) / "tests/capture/photos/masks/models" / (name + ".onnx");
}

std::string load_error(const fs::path& model) {
    testing::internal::CaptureStderr();
    const Result<SegmentationNetwork> network = SegmentationNetwork::load(model);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << model << ": OpenCV has logged";
    if (network.ok()) return "no error";
    EXPECT_THAT(network.error().message, testing::StartsWith(model.parent_path().string()));
    EXPECT_THAT(network.error().message, Not(HasSubstr("\n")));
    return network.error().message;
}

// The left half is red, the right half blue.
Image<Rgba8> red_and_blue(int width, int height) {
    Image<Rgba8> photo(width, height, Rgba8{20, 60, 200, 255});
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width / 2; ++x) photo(x, y) = {200, 60, 20, 255};
    }
    return photo;
}

// Output of the tiny models in uniform regions.
float tiny_probability(int red, int blue, float scale = 1.0F / 256) {
    return 1 / (1 + std::exp(-16 * scale * static_cast<float>(red - blue)));
}

// A model with settings beside it.
class SettingsBesideModel : public testing::Test {
protected:
    fs::path model(const std::string& name, const std::string& json) {
        const fs::path file = folder_ / (name + ".onnx");
        fs::copy_file(tiny_model(name), file, fs::copy_options::overwrite_existing);
        EXPECT_TRUE(write_file(folder_ / (name + ".json"), json).ok());
        return file;
    }
    Result<Image<float>> probability(const std::string& name, const std::string& json) {
        const Result<SegmentationNetwork> network = SegmentationNetwork::load(model(name, json));
        if (!network) return network.error();
        return network->foreground_probability(red_and_blue(64, 64));
    }
    test::TemporaryFolder folder_;
};

TEST(SegmentationNetwork, GivesTheProbabilityInThePhotosSize) {
    for (const char* name : {"plain", "weights_as_inputs", "half_output", "two_outputs"}) {
        SCOPED_TRACE(name);
        const Result<SegmentationNetwork> network = SegmentationNetwork::load(tiny_model(name));
        ASSERT_TRUE(network.ok()) << network.error().message;
        for (const auto& [width, height] : {std::pair{32, 32}, std::pair{200, 150}, std::pair{16, 9}}) {
            const Result<Image<float>> found = network->foreground_probability(red_and_blue(width, height));
            ASSERT_TRUE(found.ok()) << found.error().message;
            ASSERT_EQ(found->width(), width);
            ASSERT_EQ(found->height(), height);
            EXPECT_NEAR((*found)(1, height / 2), tiny_probability(200, 20), 1e-4);
            EXPECT_NEAR((*found)(width - 2, height / 2), tiny_probability(20, 200), 1e-4);
        }
    }
}

TEST(SegmentationNetwork, DescribesItself) {
    const Result<SegmentationNetwork> network = SegmentationNetwork::load(tiny_model("plain"));
    ASSERT_TRUE(network.ok()) << network.error().message;
    EXPECT_EQ(network->description(), "plain.onnx, 32x32 px, preprocessing of IS-Net (no settings file)");
}

TEST(SegmentationNetwork, AnswersSeveralThreadsAlike) {
    const Result<SegmentationNetwork> network = SegmentationNetwork::load(tiny_model("plain"), 2);
    ASSERT_TRUE(network.ok()) << network.error().message;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&, i] {
            for (int turn = 0; turn < 20; ++turn) {
                const int red = 10 * i + turn;
                const Image<Rgba8> photo(40, 30, Rgba8{static_cast<std::uint8_t>(red), 0, 30, 255});
                const Result<Image<float>> found = network->foreground_probability(photo);
                ASSERT_TRUE(found.ok()) << found.error().message;
                ASSERT_NEAR((*found)(20, 15), tiny_probability(red, 30), 1e-4);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(SegmentationNetwork, RefusesWhatItCannotRunInOneLine) {
    EXPECT_THAT(load_error(tiny_model("missing")), HasSubstr("missing.onnx"));
    EXPECT_THAT(load_error(tiny_model("truncated")), HasSubstr("not a valid ONNX model (it ends early)"));
    EXPECT_THAT(load_error(tiny_model("short_weights")), HasSubstr("tensor weights does not have the length"));
    EXPECT_THAT(load_error(tiny_model("fp16")), HasSubstr("half precision (fp16)"));
    EXPECT_THAT(load_error(tiny_model("quantized")), HasSubstr("is quantized (operator DynamicQuantizeLinear)"));
    EXPECT_THAT(load_error(tiny_model("external")), HasSubstr("weights are in another file"));
    EXPECT_THAT(load_error(tiny_model("two_inputs")), HasSubstr("has 2 inputs"));
    EXPECT_THAT(load_error(tiny_model("grey")), HasSubstr("its input photo is 1x1x32x32; it must be 1x3xHxW"));
    EXPECT_THAT(load_error(tiny_model("large")), HasSubstr("takes photos of 4096x4096; sides must be 32..2048 px"));
    EXPECT_THAT(load_error(tiny_model("classes")), HasSubstr("its output mask is 1x2x32x32; it must be 1x1xHxW"));
    EXPECT_THAT(load_error(tiny_model("dynamic")), HasSubstr("write width and height (px) into"));
    EXPECT_THAT(load_error(tiny_model("unknown_operator")), HasSubstr("OpenCV cannot load the model"));
    EXPECT_THAT(load_error(tiny_model("make_tiny_models").parent_path().parent_path() / "make_tiny_models.py"),
                HasSubstr("not a valid ONNX model"));
}

TEST(SegmentationNetwork, RefusesOutputThatIsNoProbability) {
    const Result<SegmentationNetwork> logits = SegmentationNetwork::load(tiny_model("logits"));
    ASSERT_TRUE(logits.ok()) << logits.error().message;
    const Result<Image<float>> outside = logits->foreground_probability(red_and_blue(32, 32));
    ASSERT_FALSE(outside.ok());
    EXPECT_THAT(outside.error().message,
                HasSubstr("goes from -11.25 to 11.25, which is no probability; write \"output\": \"logits\""));

    const Result<SegmentationNetwork> nan = SegmentationNetwork::load(tiny_model("nan"));
    ASSERT_TRUE(nan.ok()) << nan.error().message;
    const Result<Image<float>> undefined = nan->foreground_probability(red_and_blue(32, 32));
    ASSERT_FALSE(undefined.ok());
    EXPECT_THAT(undefined.error().message, HasSubstr("not a number in places"));
}

TEST_F(SettingsBesideModel, SayWhatTheOutputIs) {
    const Result<Image<float>> logits = probability("logits", R"({"output": "logits"})");
    ASSERT_TRUE(logits.ok()) << logits.error().message;
    EXPECT_NEAR((*logits)(5, 5), tiny_probability(200, 20), 1e-4);
    const Result<Image<float>> stretched = probability("logits", R"({"output": "minmax"})");
    ASSERT_TRUE(stretched.ok()) << stretched.error().message;
    EXPECT_NEAR((*stretched)(5, 5), 1, 1e-4);
    EXPECT_NEAR((*stretched)(60, 5), 0, 1e-4);
    const Result<Image<float>> side = probability("two_outputs", R"({"output_name": "side"})");
    ASSERT_TRUE(side.ok()) << side.error().message;
    EXPECT_NEAR((*side)(5, 5), tiny_probability(20, 200), 1e-4);
    const Result<Image<float>> none = probability("two_outputs", R"({"output_name": "d0"})");
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().message, HasSubstr("has no output d0, which its settings file names; it has mask, side"));
}

TEST_F(SettingsBesideModel, SayHowTheInputIsMade) {
    const Result<Image<float>> scaled = probability("plain", R"({"mean": [10, 0, 30], "scale": 0.01})");
    ASSERT_TRUE(scaled.ok()) << scaled.error().message;
    // (red - 10) - (blue - 30)
    EXPECT_NEAR((*scaled)(60, 5), tiny_probability(20, 200 - 20, 0.01F), 1e-4);
    const Result<Image<float>> bgr = probability("plain", R"({"channels": "bgr"})");
    ASSERT_TRUE(bgr.ok()) << bgr.error().message;
    EXPECT_NEAR((*bgr)(5, 5), tiny_probability(20, 200), 1e-4);
}

TEST_F(SettingsBesideModel, GiveASizeThatTheModelDoesNotFix) {
    const Result<SegmentationNetwork> network =
        SegmentationNetwork::load(model("dynamic", R"({"width": 64, "height": 48})"));
    ASSERT_TRUE(network.ok()) << network.error().message;
    EXPECT_EQ(network->description(), "dynamic.onnx, 64x48 px, settings of dynamic.json");
    const Result<Image<float>> found = network->foreground_probability(red_and_blue(100, 80));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_NEAR((*found)(5, 5), tiny_probability(200, 20), 1e-4);

    const Result<SegmentationNetwork> contradicting =
        SegmentationNetwork::load(model("plain", R"({"width": 64, "height": 48})"));
    ASSERT_FALSE(contradicting.ok());
    EXPECT_THAT(contradicting.error().message, HasSubstr("takes photos of 32x32, its settings file states 64x48"));
}

TEST_F(SettingsBesideModel, AreRefusedInOneLine) {
    const auto refused = [&](const std::string& json) {
        const Result<Image<float>> found = probability("plain", json);
        if (found.ok()) return std::string("no error");
        EXPECT_THAT(found.error().message, HasSubstr("plain.json: "));
        EXPECT_THAT(found.error().message, Not(HasSubstr("\n")));
        return found.error().message;
    };
    EXPECT_THAT(refused("{"), HasSubstr("plain.json"));
    EXPECT_THAT(refused("[]"), HasSubstr("must be an object"));
    EXPECT_THAT(refused(R"({"width": 64})"), HasSubstr("give both width and height"));
    EXPECT_THAT(refused(R"({"width": 16, "height": 64})"), HasSubstr("width: must be a whole number from 32 to 2048"));
    EXPECT_THAT(refused(R"({"width": 64, "height": 4096})"), HasSubstr("height: must be a whole number"));
    EXPECT_THAT(refused(R"({"mean": [1, 2]})"), HasSubstr("mean: must be a list of three numbers"));
    EXPECT_THAT(refused(R"({"mean": 1e9})"), HasSubstr("mean: must be a number from"));
    EXPECT_THAT(refused(R"({"scale": [1, 0, 1]})"), HasSubstr("scale: must not be 0"));
    EXPECT_THAT(refused(R"({"channels": "yuv"})"), HasSubstr("channels: must be one of \"rgb\", \"bgr\""));
    EXPECT_THAT(refused(R"({"output": "mask"})"), HasSubstr("output: must be one of \"probability\""));
    EXPECT_THAT(refused(R"({"output_name": ""})"), HasSubstr("output_name: must not be empty"));
    EXPECT_THAT(refused(R"({"std": 1})"), HasSubstr("has a key 'std' that means nothing here; it may have: channels"));
}

TEST_F(SettingsBesideModel, WithTheLongerNameArePreferred) {
    const fs::path file = model("logits", R"({"output": "minmax"})");
    EXPECT_EQ(network_settings_file(file), folder_ / "logits.json");
    ASSERT_TRUE(write_file(folder_ / "logits.onnx.json", R"({"output": "logits"})").ok());
    EXPECT_EQ(network_settings_file(file), folder_ / "logits.onnx.json");
    const Result<NetworkSettings> settings = read_network_settings(file);
    ASSERT_TRUE(settings.ok()) << settings.error().message;
    EXPECT_EQ(settings->output, NetworkOutput::kLogits);
}

// A real model: $RAYSPACE_SEGMENTATION_MODEL.
TEST(SegmentationNetwork, ARealModelFindsABall) {
    const char* model = std::getenv("RAYSPACE_SEGMENTATION_MODEL");
    if (model == nullptr) GTEST_SKIP() << "set RAYSPACE_SEGMENTATION_MODEL to an ONNX file to have this test run";
    const Result<SegmentationNetwork> network = SegmentationNetwork::load(model);
    ASSERT_TRUE(network.ok()) << network.error().message;
    Image<Rgba8> photo(320, 240);
    const auto is_ball = [](int x, int y) { return std::hypot(x + 0.5 - 160, y + 0.5 - 120) < 70; };
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
            // Lit from the upper left, on a wall above a table.
            const double light = 1 - std::hypot(x - 135, y - 95) / 160;
            const auto shade = [&](double code) { return static_cast<std::uint8_t>(code * light); };
            const std::uint8_t wall = y < 150 ? 205 : 170;
            photo(x, y) = is_ball(x, y) ? Rgba8{shade(230), shade(90), shade(40), 255} : Rgba8{wall, wall, wall, 255};
        }
    }
    const Result<Image<float>> found = network->foreground_probability(photo);
    ASSERT_TRUE(found.ok()) << found.error().message;
    int both = 0, either = 0;
    for (int y = 0; y < 240; ++y) {
        for (int x = 0; x < 320; ++x) {
            const bool is_found = (*found)(x, y) >= 0.5F;
            both += is_found && is_ball(x, y) ? 1 : 0;
            either += is_found || is_ball(x, y) ? 1 : 0;
        }
    }
    EXPECT_GT(static_cast<double>(both) / either, 0.9) << "intersection over union";
}

}  // namespace
}  // namespace rs::capture
