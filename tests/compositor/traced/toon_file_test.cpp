// Files of toon styles.

#include "compositor/traced/toon_file.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ToonFile, SetsTonesAndEdges) {
    const auto style = toon_style_from_json(
        R"({"thresholds": [0.7, 0.2], "values": [0.9, 0.6, 0.2], "edge_depth": 300, "edge_angle_deg": 60,
            "edge_colour": [0.1, 0, 0.2], "steps": "colour"})",
        "style.json");
    ASSERT_TRUE(style) << style.error().message;
    EXPECT_EQ(style->tone(0.69F), 0.6F);
    EXPECT_EQ(style->edge_depth, 300.0F);
    EXPECT_NEAR(style->edge_angle_rad, kPi / 3, 1e-6);
    EXPECT_EQ(style->edge_colour, glm::vec3(0.1F, 0, 0.2F));
    EXPECT_EQ(style->steps, capture::ToonStyle::Steps::colour);
    const auto by_depth = toon_style_from_json(R"({"edge_test": "depth"})", "style.json");
    ASSERT_TRUE(by_depth) << by_depth.error().message;
    EXPECT_EQ(by_depth->edge_test, capture::ToonStyle::EdgeTest::depth);
    const auto plain = toon_style_from_json("{}", "style.json");
    ASSERT_TRUE(plain) << plain.error().message;
    EXPECT_EQ(plain->values, capture::ToonStyle{}.values);
    EXPECT_NEAR(plain->edge_angle_rad, capture::ToonStyle{}.edge_angle_rad, 1e-5);
    EXPECT_EQ(plain->steps, capture::ToonStyle::Steps::intensity);
    EXPECT_EQ(plain->edge_test, capture::ToonStyle::EdgeTest::slope);
}

TEST(ToonFile, WrongValuesAreErrorsThatNameTheKey) {
    const auto error = [](const std::string& text) {
        const auto style = toon_style_from_json(text, "style.json");
        return style ? std::string("accepted") : style.error().message;
    };
    EXPECT_THAT(error(R"({"thresholds": [0.5]})"), StartsWith("style.json: values must be one more than"));
    EXPECT_THAT(error(R"({"thresholds": [0.1, 0.2, 0.3, 0.4]})"), StartsWith("style.json: thresholds must fall"));
    EXPECT_THAT(error(R"({"values": [2, 1, 1, 1, 1]})"),
                StartsWith("style.json: values[0]: must be a number from 0 to 1"));
    EXPECT_THAT(error(R"({"edge_depth": -1})"), StartsWith("style.json: edge_depth: must be a number"));
    EXPECT_THAT(error(R"({"edge_angle_deg": 0})"),
                StartsWith("style.json: edge_angle_deg: must be a number from 1 to 180"));
    EXPECT_THAT(error(R"({"edge_colour": "red"})"), StartsWith("style.json: edge_colour: must be a list"));
    EXPECT_THAT(error(R"({"steps": "color"})"), HasSubstr(R"(steps: must be one of "intensity", "colour")"));
    EXPECT_THAT(error(R"({"edge_test": true})"), HasSubstr(R"(edge_test: must be one of "slope", "depth")"));
    EXPECT_THAT(error(R"({"edge_test": "depth", "edge_angle_deg": 20})"),
                StartsWith("style.json: edge_angle_deg has no effect with"));
    EXPECT_THAT(error(R"({"edge_radius": 0.1})"), HasSubstr("has a key 'edge_radius' that means nothing here"));
    EXPECT_THAT(error("[]"), HasSubstr("must be an object"));
    const test::TemporaryFolder folder;
    EXPECT_FALSE(read_toon_style(folder / "missing.json").ok());
}

}  // namespace
}  // namespace rs::compositor
