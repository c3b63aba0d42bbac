#include "capture/photos/masks/onnx_summary.hpp"

#include "rayspace/file/file_output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

std::vector<std::byte> tiny_file(const std::string& name) {
    const auto bytes = read_file(
        std::filesystem::path(RAYSPACE_SOURCE_DIR) / "tests/capture/photos/masks/models" / (name + ".onnx"), 1 << 16);
    EXPECT_TRUE(bytes.ok()) << bytes.error().message;
    return bytes ? *bytes : std::vector<std::byte>{};
}

TEST(OnnxSummary, NamesInputsAndOutputs) {
    const Result<OnnxSummary> fixed = read_onnx_summary(tiny_file("weights_as_inputs"), "x.onnx");
    ASSERT_TRUE(fixed.ok()) << fixed.error().message;
    ASSERT_EQ(fixed->inputs.size(), 1U) << "weights are no inputs";
    EXPECT_EQ(fixed->inputs[0].name, "photo");
    EXPECT_EQ(fixed->inputs[0].element_type, kOnnxFloat);
    EXPECT_THAT(fixed->inputs[0].shape, testing::ElementsAre(1, 3, 32, 32));
    const Result<OnnxSummary> dynamic = read_onnx_summary(tiny_file("dynamic"), "x.onnx");
    ASSERT_TRUE(dynamic.ok()) << dynamic.error().message;
    EXPECT_THAT(dynamic->inputs.at(0).shape, testing::ElementsAre(-1, 3, -1, -1));
    const Result<OnnxSummary> two = read_onnx_summary(tiny_file("two_outputs"), "x.onnx");
    ASSERT_TRUE(two.ok()) << two.error().message;
    ASSERT_EQ(two->outputs.size(), 2U);
    EXPECT_EQ(two->outputs[0].name, "mask");
    EXPECT_EQ(two->outputs[1].name, "side");
}

TEST(OnnxSummary, NotesWhatOpenCvDoesNotLoad) {
    const auto summary = [](const std::string& name) {
        const Result<OnnxSummary> read = read_onnx_summary(tiny_file(name), name);
        EXPECT_TRUE(read.ok()) << read.error().message;
        return read ? *read : OnnxSummary{};
    };
    EXPECT_TRUE(summary("fp16").has_half_weights);
    EXPECT_FALSE(summary("plain").has_half_weights);
    EXPECT_TRUE(summary("external").has_external_data);
    EXPECT_FALSE(summary("plain").has_external_data);
    EXPECT_EQ(summary("quantized").quantized_operator, "DynamicQuantizeLinear");
    EXPECT_EQ(summary("plain").quantized_operator, "");
}

TEST(OnnxSummary, RefusesEveryPrefix) {
    const std::vector<std::byte> whole = tiny_file("plain");
    // The opset follows the graph; it is not read.
    std::size_t refused = 0;
    for (std::size_t size = 0; size < whole.size(); ++size) {
        refused += read_onnx_summary(std::span(whole).first(size), "x.onnx").ok() ? 0 : 1;
    }
    EXPECT_GE(refused, whole.size() - 1);
    EXPECT_FALSE(read_onnx_summary({}, "x.onnx").ok());
}

}  // namespace
}  // namespace rs::capture
