#include "datasets-synthetic/shapes/parameters.hpp"

#include "capture/tracer/scene/scene.hpp"
#include "datasets-synthetic/objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace rs::synthetic {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string parameter_error(const std::string& object, const nlohmann::json& parameters) {
    const Result<capture::Scene> result = generate(object, parameters, 1);
    return result.ok() ? std::string("no error") : result.error().message;
}

TEST(Parameters, UnknownNameIsAnErrorThatListsTheRanges) {
    for (const std::string& object : object_names()) {
        const std::string message = parameter_error(object, {{"wobble", 1}});
        EXPECT_THAT(message, HasSubstr(object));
        EXPECT_THAT(message, HasSubstr("wobble"));
        EXPECT_THAT(message, HasSubstr(" to ")) << "the known ones with their ranges";
        EXPECT_THAT(message, Not(HasSubstr("\n")));
    }
}

TEST(Parameters, OutOfRangeNamesParameterValueAndRange) {
    EXPECT_EQ(parameter_error("vase", {{"belly", 3}}), "vase: parameter belly is 3; give a number, 0.5 to 0.8");
    EXPECT_EQ(parameter_error("doll", {{"strands", 999}}),
              "doll: parameter strands is 999; give a whole number, 1000 to 140000");
    EXPECT_EQ(parameter_error("blocks", {{"text", "Hi"}}),
              "blocks: parameter text is \"Hi\"; give 1 to 12 letters A to Z");
}

TEST(Parameters, WrongTypesAreErrors) {
    EXPECT_THAT(parameter_error("vase", {{"belly", "wide"}}), HasSubstr("belly"));
    EXPECT_THAT(parameter_error("vase", {{"flowers", 4.5}}), HasSubstr("flowers"));
    EXPECT_THAT(parameter_error("vase", {{"flowers", 18446744073709551615ULL}}), HasSubstr("flowers"));
    EXPECT_THAT(parameter_error("blocks", {{"text", ""}}), HasSubstr("text"));
    EXPECT_THAT(parameter_error("blocks", {{"text", "ABCDEFGHIJKLM"}}), HasSubstr("text"));
    EXPECT_THAT(parameter_error("lamp", nlohmann::json::array({1, 2})), HasSubstr("not a JSON object"));
}

TEST(Parameters, EndsOfTheRangesAreAllowed) {
    const nlohmann::json values{{"low", 1.5}, {"high", 2.5}, {"count", 9}, {"word", "ABC"}};
    Parameters in("thing", values);
    EXPECT_EQ(in.number("low", 2.0F, 1.5F, 2.5F), 1.5F);
    EXPECT_EQ(in.number("high", 2.0F, 1.5F, 2.5F), 2.5F);
    EXPECT_EQ(in.whole_number("count", 1, 0, 9), 9);
    EXPECT_EQ(in.letters("word", "Z", 3), "ABC");
    EXPECT_EQ(in.number("absent", 0.25F, 0.0F, 1.0F), 0.25F);
    EXPECT_TRUE(in.finish().ok());
}

TEST(Parameters, TheFirstErrorIsKept) {
    const nlohmann::json values{{"a", 5}, {"b", 5}};
    Parameters in("thing", values);
    in.number("a", 0.0F, 0.0F, 1.0F);
    in.number("b", 0.0F, 0.0F, 1.0F);
    ASSERT_FALSE(in.finish().ok());
    EXPECT_THAT(in.finish().error().message, HasSubstr("parameter a"));
}

TEST(Parameters, ObjectsAreSoundAtTheEndsOfTheirRanges) {
    const std::vector<std::pair<std::string, nlohmann::json>> extremes{
        {"vase", {{"height", 1.8}, {"belly", 0.8}, {"neck", 0.15}, {"flowers", 8}}},
        {"vase", {{"height", 2.8}, {"belly", 0.5}, {"neck", 0.32}, {"flowers", 3}}},
        {"flower", {{"blooms", 1}, {"petals", 6}, {"leaves", 0}, {"spread", 0.2}}},
        {"flower", {{"blooms", 12}, {"petals", 24}, {"leaves", 60}, {"spread", 0.9}}},
        {"doll", {{"strands", 1000}, {"hair_length", 0.03}, {"curl", 0}}},
        {"doll", {{"strands", 140000}, {"hair_length", 0.16}, {"curl", 1.5}}},
        {"lamp", {{"fill", 0.1}, {"flame", 0}, {"polish", 0}}},
        {"lamp", {{"fill", 0.9}, {"flame", 20}, {"polish", 1}}},
        {"lattice", {{"strut", 0.015}, {"core", 0.15}, {"windings", 2}}},
        {"lattice", {{"strut", 0.06}, {"core", 0.4}, {"windings", 5}}},
        {"blocks", {{"text", "A"}, {"bevel", 0.03}, {"untidiness", 0}}},
        {"blocks", {{"text", "ABCDEFGHIJKL"}, {"bevel", 0.25}, {"untidiness", 1}}},
        {"phone", {{"text", "A"}, {"lean", 0}, {"gloss", 0.05}}},
        {"phone", {{"text", "ABCDEFGH"}, {"lean", 0.35}, {"gloss", 0.6}}},
    };
    for (const auto& [object, parameters] : extremes) {
        const Result<capture::Scene> scene = generate(object, parameters, 5);
        ASSERT_TRUE(scene.ok()) << scene.error().message;
        const Status check = capture::check_scene(*scene);
        EXPECT_TRUE(check.ok()) << object << " " << parameters << ": " << check.error().message;
    }
}

TEST(Parameters, ChangeTheObject) {
    const auto triangles = [](const nlohmann::json& parameters) {
        const Result<capture::Scene> doll = generate("doll", parameters, 1);
        std::size_t count = 0;
        for (const capture::Mesh& mesh : doll->meshes) count += mesh.triangles.size();
        return count;
    };
    EXPECT_EQ(triangles({{"strands", 2000}}) - triangles({{"strands", 1000}}), 7000U);
}

}  // namespace
}  // namespace rs::synthetic
