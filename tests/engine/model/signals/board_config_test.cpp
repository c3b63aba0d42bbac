// Board configurations: reading, and error messages of invalid ones.

#include "engine/model/signals/board_config.hpp"
#include "engine/model/board_top.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <utility>

namespace rs::engine::model {
namespace {

std::string refusal(const std::string& json) {
    const Result<BoardConfig> config = parse_board_config(json, "board.json");
    return config ? "" : config.error().message;
}

TEST(BoardConfig, TheBuiltInIsThePublishedBoard) {
    const Result<BoardConfig> config = read_board_config("prototype-2000");
    ASSERT_TRUE(config.ok());
    EXPECT_EQ(config->clock_mhz, 40);
    EXPECT_NEAR(config->pci.mhz(), 33.333, 0.001);
    EXPECT_EQ(config->limits.memory_bytes, std::uint64_t{1} << 30);
    EXPECT_EQ(config->limits.objects, 20);
    EXPECT_EQ(config->limits.views_per_cycle, 15);
}

TEST(BoardConfig, WrittenConfigurationsAreReadBack) {
    const Result<BoardConfig> config =
        parse_board_config(R"({"name": "slow", "clock_mhz": 20, "memory": {"read_latency": 3}})", "f");
    ASSERT_TRUE(config.ok());
    EXPECT_EQ(config->name, "slow");
    EXPECT_EQ(config->memory.timing.read_latency, 3);
    EXPECT_EQ(config->pci.burst_words, 4);
    const Result<BoardConfig> again = parse_board_config(board_config_json(*config), "f");
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(board_config_json(*again), board_config_json(*config));
}

TEST(BoardConfig, RefusalsNameFileKeyAndBound) {
    EXPECT_NE(refusal("[]").find("board.json: must be an object"), std::string::npos);
    EXPECT_NE(refusal("{").find("is not valid JSON at line 1"), std::string::npos);
    EXPECT_NE(refusal(R"({"base": "parallel-2000"})").find("base: \"parallel-2000\" is no built-in"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"memory": {"speed": 1}})").find("memory: has a key 'speed' that means nothing here"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"memory": 3})").find("memory: must be an object"), std::string::npos);
    EXPECT_NE(refusal(R"({"clock_mhz": "fast"})").find("clock_mhz: must be a whole number from 1 to 1000"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"clock_mhz": 1e300})").find("clock_mhz: must be a whole number from 1 to 1000"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"clock_mhz": 0})").find("clock_mhz: must be a whole number from 1 to 1000"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"limits": {"objects": 21}})").find("limits.objects: must be a whole number from 1 to 20"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"memory": {"alpha": {"first": 11}}})").find("share bank 11"), std::string::npos);
    EXPECT_NE(refusal(R"({"memory": {"bank_bits": 3}})").find("beyond the last of 8 banks"), std::string::npos);
    EXPECT_NE(refusal(R"({"memory": {"load_words_per_window": 300}})").find("more than half"), std::string::npos);
    EXPECT_NE(refusal(R"({"memory": {"activate_to_activate": 30, "load_words_per_window": 5}})").find("too small"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"memory": {"row_bits": 8}})").find("image buffers do not fit"), std::string::npos);
    EXPECT_NE(refusal(R"({"pci": {"period": 4}})").find("pci.period: is no longer a key; give the bus clock as"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"clock_period": 5})").find("clock_period: is no longer a key"), std::string::npos);
    EXPECT_NE(refusal(R"({"pci": {"clock_mhz": 40}})").find("pci/clock_mhz: must be 33 or 66 (PCI) or 133 (PCI-X)"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"pci": {"width_bits": 48}})").find("must be 32 or 64"), std::string::npos);
    EXPECT_NE(refusal(R"({"pci": {"width_bits": 64, "compression": 2}})").find("needs pci/width_bits 32"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"pci": {"burst_words": 9, "compression": 2}})").find("is above 16"), std::string::npos);
    const Result<BoardConfig> missing = read_board_config("prototype-2001");
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.error().message.find("neither a built-in"), std::string::npos);
}

TEST(BoardConfig, TheBusClockDoesNotFollowTheBoards) {
    const auto periods_of = [](const std::string& json) {
        const BoardConfig::Periods periods = parse_board_config(json, "f").value().clock_periods();
        return std::pair(periods.board, periods.bus);
    };
    EXPECT_EQ(periods_of("{}"), std::pair(5, 6));  // 25 ns and 30 ns
    EXPECT_EQ(periods_of(R"({"clock_mhz": 20})"), std::pair(5, 3));
    EXPECT_EQ(periods_of(R"({"clock_mhz": 100})"), std::pair(1, 3));
    EXPECT_EQ(periods_of(R"({"pci": {"clock_mhz": 66}})"), std::pair(5, 3));
    EXPECT_EQ(periods_of(R"({"pci": {"clock_mhz": 133}})"), std::pair(10, 3));
}

TEST(BoardConfig, RemediesOfTheBusAreBuiltIn) {
    const auto pci_x = read_board_config("prototype-2000-pci-x");
    ASSERT_TRUE(pci_x.ok());
    EXPECT_NEAR(pci_x->pci.mhz(), 133.333, 0.001);
    EXPECT_EQ(pci_x->pci.width_bits, 64);
    for (const std::string& name : bus_remedy_configs()) {
        const auto config = read_board_config(name);
        ASSERT_TRUE(config.ok()) << name;
        EXPECT_EQ(config->name, name);
        const auto again = parse_board_config(board_config_json(*config), "f");
        ASSERT_TRUE(again.ok()) << again.error().message;
        EXPECT_EQ(board_config_json(*again), board_config_json(*config));
    }
}

TEST(BoardConfig, CompressedHasItsOwnSlotsAndRegions) {
    const Result<BoardConfig> config =
        parse_board_config(R"({"base": "compressed-2000", "memory": {"flat_tiles": {"count": 1}}})", "f");
    ASSERT_TRUE(config.ok()) << config.error().message;
    EXPECT_EQ(config->limits.kind, BoardKind::coded_images);
    EXPECT_EQ(config->limits.objects, 160);
    EXPECT_EQ(config->memory.regions.objects.front().count, 1);
    const Result<BoardConfig> again = parse_board_config(board_config_json(*config), "f");
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(board_config_json(*again), board_config_json(*config));
    EXPECT_NE(refusal(R"({"base": "compressed-2000", "limits": {"objects": 161}})").find("from 1 to 160"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"base": "compressed-2000", "memory": {"luma": {"first": 1}}})").find("has a key 'luma'"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"base": "compressed-2000", "memory": {"tile_table": {"first": 5}}})").find("share bank 5"),
              std::string::npos);
}

TEST(BoardConfig, ParallelHasPipesAndBanksForEachImageBuffer) {
    const Result<BoardConfig> config =
        parse_board_config(R"({"base": "parallel", "pipes": 5, "limits": {"shape_bands": 100}})", "f");
    ASSERT_TRUE(config.ok()) << config.error().message;
    EXPECT_EQ(config->pipes, 5);
    EXPECT_EQ(config->limits.kind, BoardKind::any_object);
    const Result<BoardConfig> again = parse_board_config(board_config_json(*config), "f");
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(board_config_json(*again), board_config_json(*config));
    EXPECT_EQ(read_board_config("parallel")->pipes, 16);
    EXPECT_NE(refusal(R"({"base": "parallel", "pipes": 33})").find("pipes: must be a whole number from 1 to 32"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"pipes": 2})").find("has a key 'pipes'"), std::string::npos);
    EXPECT_NE(refusal(R"({"base": "parallel", "limits": {"shape_bands": 385}})").find("from 1 to 384"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"base": "parallel", "memory": {"images": {"count": 1}}})").find("is odd"), std::string::npos);
    const BoardTop board(*config);
    EXPECT_EQ(board.channels(), 5);
    EXPECT_NE(board.registers.image(0, 0) >> 23U, board.registers.image(1, 0) >> 23U);  // banks
}

TEST(BoardConfig, ASingleObjectSlotIsEnoughForABoard) {
    const BoardTop board(parse_board_config(R"({"limits": {"objects": 1}})", "f").value());
    EXPECT_EQ(board.registers.objects.size(), 1U);
    EXPECT_EQ(board.object_ready.width_bits(), 1);
}

TEST(BoardConfig, IsReadFromAFile) {
    const rs::test::TemporaryFolder scratch;
    const std::string path = (scratch / "slow.json").string();
    std::ofstream(path) << R"({"clock_mhz": 20})";
    const Result<BoardConfig> config = read_board_config(path);
    ASSERT_TRUE(config.ok());
    EXPECT_EQ(config->clock_mhz, 20);
    EXPECT_EQ(config->name, path);
}

}  // namespace
}  // namespace rs::engine::model
