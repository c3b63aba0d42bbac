// SDRAM timing rules: every command is illegal one cycle early and legal on time.

#include "engine/model/signals/sdram.hpp"

#include <gtest/gtest.h>

namespace rs::engine::model {
namespace {

using enum SdramCommand;

// Distinct times, all different from 1, so that a mix-up is detected.
constexpr SdramTiming kTiming{.activate_to_column = 3,
                              .precharge_to_activate = 4,
                              .activate_to_precharge = 7,
                              .activate_to_activate = 13,
                              .write_to_precharge = 5,
                              .refresh_to_any = 9,
                              .read_latency = 2,
                              .interface_latency = 2};
constexpr WordAddress kRow = 1 << 10;
constexpr WordAddress kBank = 1 << 23;

void expect_from(const Sdram& sdram, SdramCommand command, WordAddress address, std::uint64_t cycle) {
    EXPECT_FALSE(sdram.allows(command, address, cycle - 1));
    EXPECT_TRUE(sdram.allows(command, address, cycle));
}

class SdramRules : public testing::Test {
protected:
    Sdram sdram_{SdramShape{}, kTiming};
};

TEST_F(SdramRules, ActivateToColumn) {
    EXPECT_FALSE(sdram_.allows(read, 0, 100));  // closed
    sdram_.issue(activate, 5, 100);
    expect_from(sdram_, read, 5, 103);
    expect_from(sdram_, write, 5, 103);
    EXPECT_FALSE(sdram_.allows(read, 5 + kRow, 103));   // another row
    EXPECT_FALSE(sdram_.allows(read, 5 + kBank, 103));  // another bank
    EXPECT_FALSE(sdram_.allows(activate, 5, 150));      // open
}

TEST_F(SdramRules, ActivateToPrecharge) {
    sdram_.issue(activate, 0, 100);
    expect_from(sdram_, precharge, 0, 107);
    expect_from(sdram_, precharge_all, 0, 107);
}

TEST_F(SdramRules, PrechargeToActivateAndActivateToActivate) {
    sdram_.issue(activate, 0, 100);
    sdram_.issue(precharge, 0, 107);
    expect_from(sdram_, activate, kRow, 113);  // 13 after the first
    sdram_.issue(activate, kRow, 120);
    sdram_.issue(precharge, kRow, 140);
    expect_from(sdram_, activate, 0, 144);  // 4 after the precharge
    expect_from(sdram_, refresh, 0, 144);
    EXPECT_TRUE(sdram_.allows(activate, kBank, 101));  // another bank does not wait
}

TEST_F(SdramRules, WriteToPrecharge) {
    sdram_.issue(activate, 0, 100);
    sdram_.issue(write, 0, 110);
    expect_from(sdram_, precharge, 0, 116);  // the write's own cycle and 5
    expect_from(sdram_, precharge_all, 0, 116);
}

TEST_F(SdramRules, ReadToWriteTurnsTheBusRound) {
    sdram_.issue(activate, 0, 100);
    sdram_.issue(read, 0, 110);
    EXPECT_TRUE(sdram_.allows(read, 1, 111));
    expect_from(sdram_, write, 1, 114);
    sdram_.issue(write, 1, 114);
    EXPECT_TRUE(sdram_.allows(read, 1, 115));
}

TEST_F(SdramRules, RefreshRequiresClosedBanksAndDelaysAllCommands) {
    sdram_.issue(activate, kBank, 100);
    EXPECT_FALSE(sdram_.allows(refresh, 0, 200));
    sdram_.issue(precharge_all, 0, 200);
    expect_from(sdram_, refresh, 0, 204);
    sdram_.issue(refresh, 0, 204);
    expect_from(sdram_, activate, 0, 213);
    expect_from(sdram_, refresh, 0, 213);
}

TEST(SdramDeathTest, AnIllegalCommandStopsTheProgram) {
    Sdram sdram(SdramShape{}, kTiming);
    sdram.issue(activate, 0, 100);
    EXPECT_DEATH(sdram.issue(read, 0, 102), "check failed");
}

TEST(Sdram, KeepsWordsOfItsWholeGigabyte) {
    Sdram sdram(SdramShape{}, SdramTiming{});
    EXPECT_EQ(SdramShape{}.words() * 8, std::uint64_t{1} << 30);
    const auto last = static_cast<WordAddress>(SdramShape{}.words() - 1);
    sdram.set_word(0, 1);
    sdram.set_word(last, ~std::uint64_t{0});
    EXPECT_EQ(sdram.word(0), 1U);
    EXPECT_EQ(sdram.word(1), 0U);
    EXPECT_EQ(sdram.word(last), ~std::uint64_t{0});
    EXPECT_EQ(sdram.bank_of(last), 15);
    EXPECT_EQ(sdram.row_of(last), 8191);
}

}  // namespace
}  // namespace rs::engine::model
