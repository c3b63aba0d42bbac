#include "rayspace/base/json_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rs {
namespace {

std::string refusal_of(const std::string& text) {
    const auto json = parse_json(text, "F");
    return json ? "" : json.error().message;
}

std::string nested(int depth) {
    const auto times = static_cast<std::size_t>(depth);
    return std::string(times, '[') + std::string(times, ']');
}

TEST(JsonText, RefusesInOneLineWithThePlace) {
    EXPECT_EQ(refusal_of(R"({"a": [1, {"a": 2}, {"a": 3}], "b": {"a": 4}})"), "");
    EXPECT_EQ(refusal_of("{\"a\": 1,\n\n]"),
              "F: is not valid JSON at line 3; correct it there (NaN and Infinity are not JSON)");
    EXPECT_EQ(refusal_of("[1e999]"), "F: holds a number that is out of range; correct it");
    EXPECT_EQ(refusal_of(R"({"b": [{"a\n": 1, "c": 2, "a\n": 3}]})"),
              "F: the key \"a\\x0A\" is there twice in one object; keep one of them");
    EXPECT_EQ(refusal_of(nested(64)), "");
    EXPECT_EQ(refusal_of(nested(65)), "F: nests brackets more than 64 deep; flatten it");
    EXPECT_EQ(refusal_of(nested(1 << 20)), "F: nests brackets more than 64 deep; flatten it");
}

}  // namespace
}  // namespace rs
