#include "capture/photos/segmentation/segmentation_parameters.hpp"

#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>

namespace rs::capture {
namespace {

using testing::HasSubstr;

class SegmentationParametersFile : public testing::Test {
protected:
    Result<SegmentationParameters> read(const std::string& text) {
        EXPECT_TRUE(write_file(folder_ / "parameters.json", std::as_bytes(std::span(text))).ok());
        return read_segmentation_parameters(folder_ / "parameters.json");
    }
    std::string error(const std::string& text) {
        const Result<SegmentationParameters> found = read(text);
        EXPECT_FALSE(found.ok()) << text;
        return found.ok() ? std::string() : found.error().message;
    }

    test::TemporaryFolder folder_;
};

TEST_F(SegmentationParametersFile, ChangesWhatItStatesAndKeepsTheRest) {
    const Result<SegmentationParameters> found =
        read(R"({"foreground": {"score": {"background_delta_e": 3}}, "checks": {"max_coverage": 0.75}})");
    ASSERT_TRUE(found.ok()) << found.error().message;
    SegmentationParameters expected;
    expected.foreground.score.background_delta_e = 3;
    expected.checks.max_coverage = 0.75;
    EXPECT_EQ(to_json_text(*found), to_json_text(expected));
    EXPECT_NE(to_json_text(*found), to_json_text({}));
}

TEST_F(SegmentationParametersFile, HoldsEveryParameter) {
    const Result<SegmentationParameters> found = read(to_json_text({}));
    ASSERT_TRUE(found.ok()) << found.error().message;
    EXPECT_EQ(to_json_text(*found), to_json_text({}));
}

TEST_F(SegmentationParametersFile, ErrorsNameTheParameter) {
    EXPECT_THAT(error(R"({"foreground": {"score": {"min_shad": 1}}})"), HasSubstr("foreground.score.min_shad"));
    EXPECT_THAT(error(R"({"fusion": {"min_component": "large"}})"), HasSubstr("fusion.min_component"));
    EXPECT_THAT(error(R"({"background": {"disc": {"min_clear_octants": 3.5}}})"), HasSubstr("min_clear_octants"));
    EXPECT_THAT(error(R"({"checks": 3})"), HasSubstr("checks is no object"));
    EXPECT_THAT(error("[1, 2]"), HasSubstr("no object"));
    EXPECT_THAT(error("{"), HasSubstr("is not JSON"));
    EXPECT_FALSE(read_segmentation_parameters(folder_ / "gone.json").ok());
}

}  // namespace
}  // namespace rs::capture
