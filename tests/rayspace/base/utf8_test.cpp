#include "rayspace/base/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rs {
namespace {

using namespace std::string_literals;

TEST(Utf8, FirstAndLastCharactersOfEachLength) {
    const auto expect = [](const std::string& text, char32_t code) {
        const Utf8Character first = first_utf8_character(text + "x");
        EXPECT_EQ(first.bytes, text.size());
        EXPECT_EQ(first.code, code);
        EXPECT_TRUE(is_utf8(text));
    };
    expect("\0"s, 0);
    expect("\x7F", 0x7F);
    expect("\xC2\x80", 0x80);
    expect("\xDF\xBF", 0x7FF);
    expect("\xE0\xA0\x80", 0x800);
    expect("\xED\x9F\xBF", 0xD7FF);
    expect("\xEE\x80\x80", 0xE000);
    expect("\xF0\x90\x80\x80", 0x10000);
    expect("\xF4\x8F\xBF\xBF", 0x10FFFF);
}

TEST(Utf8, InvalidSequences) {
    for (const char* text : {"\x80", "\xC1\xBF", "\xC2", "\xC2x", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xE2\x82",
                             "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"}) {
        EXPECT_EQ(first_utf8_character(text).bytes, 0u) << text;
        EXPECT_FALSE(is_utf8("a"s + text)) << text;
    }
    EXPECT_EQ(first_utf8_character("").bytes, 0u);
    EXPECT_TRUE(is_utf8(""));
}

}  // namespace
}  // namespace rs
