#include "rayspace/base/nearest_name.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rs {
namespace {

TEST(NearestName, IsTheLeastChangedOne) {
    const std::vector<std::string> known = {"--output", "--outline", "--fov", "--fps"};
    EXPECT_EQ(nearest_name("--ouptut", known), "--output");
    EXPECT_EQ(nearest_name("--outlin", known), "--outline");
    EXPECT_EQ(nearest_name("--fvo", known), "--fov");
    EXPECT_EQ(nearest_name("--quality", known), "");
    EXPECT_EQ(nearest_name("", known), "");
    EXPECT_EQ(nearest_name(std::string(1000, 'a'), known), "");
    EXPECT_EQ(suggestion("--outpu", known), "; did you mean '--output'?");
    EXPECT_EQ(suggestion("x", {}), "");
}

}  // namespace
}  // namespace rs
