#include "compositor/farm/schedule/manifest.hpp"

#include "tests/support/file_text.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace rs::farm {
namespace {

using rs::test::text_in;

TEST(FarmManifest, ComesBackAndTheLastLineOfAnItemCounts) {
    const rs::test::TemporaryFolder folder;
    {
        Result<Manifest> manifest = Manifest::open(folder / "manifest.jsonl", 0);
        ASSERT_TRUE(manifest.ok()) << manifest.error().message;
        EXPECT_EQ(manifest->find("vase"), nullptr);
        manifest->add("vase", {.state = State::kFailed, .why = "no\npictures"}, {{"rank", 3}});
        manifest->add("vase",
                      {.state = State::kMade,
                       .key = "k",
                       .inputs = "i",
                       .output = "o",
                       .sum = "s",
                       .staged = "t",
                       .seconds = 2.5,
                       .memory_bytes = 1 << 20},
                      {{"rank", 3}});
        manifest->add("lamp", {.state = State::kFailed, .why = "\xff is no UTF-8"}, nlohmann::json::object());
        EXPECT_EQ(text_in(folder / "manifest.jsonl"), "") << "not before commit()";
        ASSERT_TRUE(manifest->commit().ok());
    }
    EXPECT_EQ(text_in(folder / "manifest.jsonl").find("staged"), std::string::npos);
    const Result<Manifest> manifest = Manifest::open(folder / "manifest.jsonl", 0);
    ASSERT_TRUE(manifest.ok()) << manifest.error().message;
    const Outcome* vase = manifest->find("vase");
    ASSERT_NE(vase, nullptr);
    EXPECT_EQ(vase->state, State::kMade);
    EXPECT_EQ(vase->key + vase->inputs + vase->output + vase->sum + vase->staged, "kios");
    EXPECT_EQ(vase->seconds, 2.5);
    EXPECT_EQ(vase->memory_bytes, 1 << 20);
    ASSERT_NE(manifest->find("lamp"), nullptr);
    EXPECT_EQ(manifest->find("lamp")->state, State::kFailed);
}

TEST(FarmManifest, ALineThatWasCutShortIsCutOff) {
    const rs::test::TemporaryFolder folder;
    const std::string whole = R"({"item": "a", "state": "made"})"
                              "\n";
    for (std::size_t length = 0; length < whole.size(); ++length) {
        std::ofstream(folder / "m") << whole << whole.substr(0, length);
        Result<Manifest> manifest = Manifest::open(folder / "m", 0);
        ASSERT_TRUE(manifest.ok()) << manifest.error().message;
        manifest->add("b", {.state = State::kMade}, nlohmann::json::object());
        ASSERT_TRUE(manifest->commit().ok());
        const auto read = parse_manifest(text_in(folder / "m"), "m");
        ASSERT_TRUE(read.ok()) << read.error().message;
        EXPECT_EQ(read->size(), 2U);
    }
}

TEST(FarmManifest, FaultsAreNamedByTheirLine) {
    for (const char* const wrong :
         {"{", "[]", "{}", R"({"item": 3, "state": "made"})", R"({"item": "a"})", R"({"item": "a", "state": "eaten"})",
          R"({"item": "a", "state": "made", "sum": 3})", R"({"item": "a", "state": "made", "memory_bytes": 1e30})"}) {
        const auto read = parse_manifest(R"({"item": "a", "state": "made"})"
                                         "\n" +
                                             std::string(wrong) + "\n",
                                         "m.jsonl");
        ASSERT_FALSE(read.ok()) << wrong;
        EXPECT_EQ(read.error().message.rfind("m.jsonl: line 2", 0), 0U) << read.error().message;
    }
}

TEST(FarmManifest, OneRunAtATime) {
    const rs::test::TemporaryFolder folder;
    {
        const Result<Manifest> first = Manifest::open(folder / "m", 0);
        ASSERT_TRUE(first.ok());
        const Result<Manifest> second = Manifest::open(folder / "m", 0.05);
        ASSERT_FALSE(second.ok());
        EXPECT_NE(second.error().message.find("another rs-farm"), std::string::npos) << second.error().message;
    }
    EXPECT_TRUE(Manifest::open(folder / "m", 0).ok());
}

}  // namespace
}  // namespace rs::farm
