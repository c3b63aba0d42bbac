#include "rayspace/base/json_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace rs {
namespace {

using testing::HasSubstr;

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
    EXPECT_EQ(refusal_of("{\"a\":\n\n NaN}"),
              "F: is not valid JSON at line 3, column 2; correct it there (NaN and Infinity are not JSON)");
    EXPECT_EQ(refusal_of("{\"a\": [1, 2,\n]}"),
              "F: is not valid JSON at line 2, column 1: a comma precedes a closing bracket; remove it");
    EXPECT_EQ(refusal_of("// by me\n{}"), "F: is not valid JSON at line 1, column 1: JSON has no comments; remove it");
    EXPECT_EQ(refusal_of(" \n"), "F: is not valid JSON but empty; write it again");
    EXPECT_EQ(refusal_of(std::string("\xff\xfe{\0", 4)), "F: is not valid JSON but UTF-16 text; save it as UTF-8");
    EXPECT_EQ(refusal_of("[1e999]"), "F: holds a number that is out of range; correct it");
    EXPECT_EQ(refusal_of(R"({"b": [{"a\n": 1, "c": 2, "a\n": 3}]})"),
              "F: the key \"a\\x0A\" is there twice in one object; keep one of them");
    EXPECT_EQ(refusal_of(nested(64)), "");
    EXPECT_EQ(refusal_of(nested(65)), "F: nests brackets more than 64 deep; flatten it");
    EXPECT_EQ(refusal_of(nested(1 << 20)), "F: nests brackets more than 64 deep; flatten it");
}

struct Read {
    double number = 5;
    glm::vec3 colour{1};
    std::size_t word = 0;
    int whole = 0;
    std::string text;
    nlohmann::json rest;
};

Result<Read> read(const std::string& text, bool take_rest = false) {
    return read_json(text, "f\n.json", [&](JsonObject& top) {
        Read made;
        top.read("number", made.number, 0, 10);
        top.read("colour", made.colour, 0, 1);
        if (const auto word = top.find("word")) made.word = word->one_of({"red", "green"});
        if (const auto whole = top.find("whole")) made.whole = static_cast<int>(whole->whole_number(0, 9));
        if (const auto list = top.find("list")) {
            for (std::size_t i = 0; i < list->list_size(0, 3); ++i) {
                JsonObject item(list->item(i));
                made.text = item.take("text").text();
                item.expect_no_unknown_keys();
            }
        }
        if (take_rest) made.rest = top.take_rest();
        return made;
    });
}

TEST(StrictJson, KeysThatAreMissingLeaveValuesAndOneNumberStandsForThree) {
    const Result<Read> nothing = read("{}");
    ASSERT_TRUE(nothing);
    EXPECT_EQ(nothing->number, 5);
    const Result<Read> all = read(R"({"number": 2, "colour": 0.5, "word": "green"})");
    ASSERT_TRUE(all);
    EXPECT_EQ(all->number, 2);
    EXPECT_EQ(all->colour, glm::vec3(0.5F));
    EXPECT_EQ(all->word, 1U);
    EXPECT_EQ(read(R"({"whole": 3.0})")->whole, 3);
    EXPECT_EQ(read(R"({"list": [{"text": "a"}, {"text": "b"}]})")->text, "b");
    EXPECT_EQ(read(R"({"colour": [0, 0.25, 1]})")->colour, glm::vec3(0, 0.25F, 1));
}

TEST(StrictJson, TheRestIsWhatWasNotTaken) {
    const Result<Read> made = read(R"({"number": 2, "other": [1], "more": null})", true);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->rest, nlohmann::json::parse(R"({"other": [1], "more": null})"));
}

TEST(StrictJson, ErrorsNameFilePlaceAndRemedyInOneLine) {
    const std::pair<const char*, const char*> faulty[] = {
        {R"({"number": 11})", "number: must be a number from 0 to 10"},
        {R"({"colour": [0, 0, 2]})", "colour[2]: must be a number from 0 to 1"},
        {R"({"word": "blue"})", R"(word: must be one of "red", "green")"},
        {R"({"numbr": 1})",
         "has a key 'numbr' that means nothing here; it may have: colour, list, number, whole, word"},
        {R"({"whole": 2.5})", "whole: must be a whole number from 0 to 9"},
        {R"({"list": [{"text": "a"}, {"text": 3}]})", "list[1].text: must be"},
        {R"({"list": [{"text": "a\u0000b"}]})", "list[0].text: "},
        {R"({"list": [{"txt": "a"}]})", "list[0]"},
        {R"({"list": [1, 2, 3, 4]})", "list: "},
        {R"({"number": 1, "number": 2})", "is there twice"},
        {"[]", "must be an object"},
    };
    for (const auto& [text, what] : faulty) {
        const Result<Read> made = read(text);
        ASSERT_FALSE(made) << text;
        EXPECT_THAT(made.error().message, HasSubstr(what));
        EXPECT_EQ(made.error().message.rfind(R"(f\x0A.json: )", 0), 0U) << made.error().message;
    }
}

TEST(CompactJson, IsShorter) {
    EXPECT_EQ(compact_json("{\n  \"w\": 684,\n  \"b\": [0.1, -0.0, 1e-20],\n  \"a\": {\"x\": 2871.5243293016447}\n}"),
              "{\"w\":684,\"b\":[0.1,0.0,1e-20],\"a\":{\"x\":2871.52433}}");
}

TEST(CompactJson, IsTheSameAgain) {
    const std::string once = compact_json("[0.12345678949999999, 123456789012.5, \"0.12345678949999999\", null, true]");
    EXPECT_EQ(once, "[0.123456789,123456789000.0,\"0.12345678949999999\",null,true]");
    EXPECT_EQ(compact_json(once), once);
}

}  // namespace
}  // namespace rs
