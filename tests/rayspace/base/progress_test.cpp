#include "rayspace/base/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace {

using namespace rs;
using testing::HasSubstr;

// stderr is captured into a file, as for logs and pipes: one line per tenth.
std::string capture_output(bool quiet, std::chrono::milliseconds silence) {
    testing::internal::CaptureStderr();
    {
        ProgressBar bar(quiet, silence);
        bar.start("working", 200);
        for (int i = 0; i < 200; ++i) bar.advance();
        bar.finish();
        bar.advance();  // no effect after the end
    }
    return testing::internal::GetCapturedStderr();
}

TEST(ProgressBar, ShortWorkShowsNothing) {
    EXPECT_EQ(capture_output(false, std::chrono::hours(1)), "");
}

TEST(ProgressBar, QuietShowsNothing) {
    EXPECT_EQ(capture_output(true, std::chrono::milliseconds(0)), "");
}

TEST(ProgressBar, LongWorkShowsEveryTenthOnce) {
    const std::string text = capture_output(false, std::chrono::milliseconds(0));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
    EXPECT_THAT(text, HasSubstr("working: 10 %"));
    EXPECT_THAT(text, HasSubstr("working: 100 %"));
    EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressBar, ManyThreadsMayAdvance) {
    testing::internal::CaptureStderr();
    {
        ProgressBar bar(false, std::chrono::milliseconds(0));
        bar.start("working", 4000);
        std::vector<std::jthread> threads;
        for (int t = 0; t < 4; ++t) {
            threads.emplace_back([&] {
                for (int i = 0; i < 1000; ++i) bar.advance();
            });
        }
    }
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
}

TEST(ProgressBar, WorkOfUnknownLengthIsSilent) {
    testing::internal::CaptureStderr();
    ProgressBar bar;
    bar.start("nothing to do", 0);
    bar.advance();
    bar.finish();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
