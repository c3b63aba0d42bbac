#include "rayspace/file/input_list.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace rs {
namespace {

namespace fs = std::filesystem;

TEST(InputList, ComesBackWhateverThePathsAre) {
    const std::vector<InputStamp> stamps = {{"/a b/c.png", 0xFFFFFFFFFFFFFFFF, 0, -1},
                                            {"/100%/\x01\n\xff\x7f", 3, 1ULL << 40, 1'700'000'000'123'456'789}};
    const std::string text = input_list_text(stamps);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
    const auto read = parse_input_list(text, "list");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(*read, stamps);
}

TEST(InputList, WhatIsCutOrFaultyIsRefused) {
    const std::string text = input_list_text({{"/a%", 1, 2, 3}});
    for (std::size_t length = 1; length < text.size(); ++length) {
        if (text[length - 1] == '\n') continue;  // a list of fewer files
        const auto read = parse_input_list(text.substr(0, length), "list");
        ASSERT_FALSE(read.ok()) << length;
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
    }
    using namespace std::string_literals;
    for (const std::string& line : {"1 2 3 "s, "1 2 3"s, "x 2 3 /a"s, "1 -2 3 /a"s, "1 2 3 /a%0"s, "1 2 3 /a%00"s,
                                    "1 2 3 /%zz"s, "1 2 3 /a\0b"s, "1 2 3 /a\x1b"s, "1 2 3 /a\x7f"s}) {
        EXPECT_FALSE(parse_input_list("rayspace inputs 1\n" + line + "\n", "list").ok()) << line;
    }
}

TEST(InputList, ToldApartByBytesNotByTime) {
    const test::TemporaryFolder folder;
    const fs::path path = folder / "file";
    std::ofstream(path) << "abc";
    const auto sum = sum_of_file(path);
    ASSERT_TRUE(sum.ok());
    const std::vector<InputStamp> stamps = {{path, *sum, 3, 12345}};
    EXPECT_TRUE(are_unchanged(stamps)) << "of another time, but the same bytes";
    std::ofstream(path) << "abd";
    EXPECT_FALSE(are_unchanged(stamps));
    fs::remove(path);
    EXPECT_FALSE(are_unchanged(stamps));
    EXPECT_FALSE(sum_of_file(path).ok());
}

TEST(InputList, SumsAreOfTheWholeFile) {
    const test::TemporaryFolder folder;
    std::string bytes(3 << 20, 'x');
    std::ofstream(folder / "a") << bytes;
    bytes.back() = 'y';
    std::ofstream(folder / "b") << bytes;
    EXPECT_NE(*sum_of_file(folder / "a"), *sum_of_file(folder / "b"));
}

}  // namespace
}  // namespace rs
