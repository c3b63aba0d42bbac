#include "capture/turns/turn_registration.hpp"

#include "tests/capture/turns/turn_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rs::capture {
namespace {

using ::testing::HasSubstr;

// The first turn calibrated by its silhouettes, the second not at all: its tilt is assumed to be 0.
std::vector<TurnToRegister> turns_to_register() {
    std::vector<TurnToRegister> turns;
    for (const PlacedTurn& placed : test::two_turns()) {
        TurnToRegister turn{"turn" + std::to_string(turns.size()), test::turn_images(placed), std::nullopt,
                            placed.model};
        turn.nominal.pose.tilt_rad = 0;
        turns.push_back(std::move(turn));
    }
    Calibration calibration;
    calibration.method = CalibrationMethod::kSilhouettes;
    calibration.model = test::two_turns()[0].model;
    turns[0].calibration = calibration;
    return turns;
}

TEST(TurnRegistration, SilhouettesGiveHeightAndAzimuth) {
    const auto found = register_turns(turns_to_register(), nullptr);
    ASSERT_TRUE(found.ok()) << found.error().message;
    const PlacedTurn& second = (*found)[1].turn;
    EXPECT_EQ((*found)[1].method, RegistrationMethod::kSilhouettes);
    EXPECT_NEAR(degrees(azimuth_rad(second.placement)), 130, 1.5);
    EXPECT_NEAR(degrees(second.model.pose.tilt_rad), 35, 3);
    EXPECT_GT((*found)[1].overlap, 0.9);
}

TEST(TurnRegistration, NamesTheTurnOfAnotherObject) {
    std::vector<TurnToRegister> turns = turns_to_register();
    for (CalibrationImage& image : turns[1].images.images) {
        image.alpha = Image<std::uint8_t>(image.alpha.width(), image.alpha.height());
        for (int x = 30; x < 210; ++x) {
            for (int y = 95; y < 103; ++y) image.alpha(x, y) = 255;
        }
    }
    const auto found = register_turns(turns, nullptr);
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().message, HasSubstr("turn1: its silhouettes do not fit the other turns"));
}

TEST(TurnRegistration, NeedsACalibratedTurn) {
    std::vector<TurnToRegister> turns = turns_to_register();
    turns[0].calibration.reset();
    const auto found = register_turns(turns, nullptr);
    ASSERT_FALSE(found.ok());
    EXPECT_THAT(found.error().message, HasSubstr("no turn can be calibrated alone"));
}

}  // namespace
}  // namespace rs::capture
