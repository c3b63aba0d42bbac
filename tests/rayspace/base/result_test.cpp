#include "rayspace/base/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace {

using namespace rs;

TEST(Result, HoldsAValueOrAnError) {
    const Result<int> good = 7;
    ASSERT_TRUE(good.ok());
    EXPECT_EQ(*good, 7);
    const Result<int> bad = Error{"file: broken"};
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().message, "file: broken");
}

TEST(Result, GivesMoveOnlyValuesAway) {
    Result<std::unique_ptr<int>> made = std::make_unique<int>(3);
    const std::unique_ptr<int> taken = std::move(made).value();
    EXPECT_EQ(*taken, 3);
}

TEST(Result, StringsAreValuesAndNotErrors) {
    const Result<std::string> text = std::string("text");
    ASSERT_TRUE(text.ok());
    EXPECT_EQ(text->size(), 4U);
}

TEST(ResultDeathTest, TheWrongSideStopsTheProgram) {
    const Result<int> bad = Error{"no"};
    EXPECT_DEATH((void)bad.value(), "check failed");
    const Result<int> good = 1;
    EXPECT_DEATH((void)good.error(), "check failed");
    EXPECT_DEATH((void)Status{}.error(), "check failed");
}

TEST(Status, IsOkUnlessGivenAnError) {
    EXPECT_TRUE(Status{}.ok());
    EXPECT_FALSE(Status{Error{"x"}}.ok());
}

}  // namespace
