#include "rayspace/base/printable.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rs {
namespace {

TEST(Printable, ListsNameTheFirstAndCountTheRest) {
    const std::vector<std::string> names{"a", "b", "c", "d"};
    EXPECT_EQ(listed(names, 4), "a, b, c, d");
    EXPECT_EQ(listed(names, 3), "a, b, c and 1 more");
    EXPECT_EQ(listed(names, 1), "a and 3 more");
    EXPECT_EQ(listed({}, 3), "");
}

TEST(Printable, DigitsBehindThePoint) {
    EXPECT_EQ(format_fixed(1.25, 1), "1.2");
    EXPECT_EQ(format_fixed(-0.5, 3), "-0.500");
    EXPECT_EQ(format_fixed(2, 0), "2");
}

}  // namespace
}  // namespace rs
